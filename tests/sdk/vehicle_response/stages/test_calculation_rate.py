"""The calculation rate keeps the spacing over distance, whatever the speed."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref.vehicle_response.stages.calculation_rate import calculation_rate


@pytest.mark.cites("section 4.3 of Zhu")
@given(speed=st.floats(0.01, 100.0))
def test_the_spacing_is_a_twentieth_of_a_metre(speed):
    assert speed / calculation_rate(speed) == pytest.approx(0.05, rel=1e-12)


@pytest.mark.cites("section 4.3 of Zhu")
def test_the_two_speeds_of_print():
    assert (calculation_rate(10.0), calculation_rate(20.0)) == (200.0, 400.0)


@pytest.mark.parametrize("speed", [0.0, -1.0, math.nan, math.inf])
def test_no_speed_is_refused_in_one_line(speed):
    with pytest.raises(InputError, match=rf"which is {speed:g} m/s; give") as raised:
        calculation_rate(speed)
    assert "\n" not in str(raised.value)
