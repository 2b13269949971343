"""The settings of the IRI are checked, and their record says what was done."""

import math

import pytest

from floatref.errors import InputError
from floatref.measures import IriSettings


def test_record_holds_what_moves_the_value() -> None:
    record = IriSettings(segment_m=160.9).as_dict(0.00508)
    assert record["interval_m"] == 0.00508
    assert record["moving_average_m"] == 0.25
    assert record["moving_average_samples"] == 49
    assert record["start_length_m"] == 11.0
    assert record["speed_kmh"] == 80.0
    assert record["segment_m"] == 160.9


@pytest.mark.parametrize("interval", [0.25, 0.3, 1.0, 2.0])
def test_record_says_that_the_moving_average_is_off(interval: float) -> None:
    record = IriSettings().as_dict(interval)
    assert record["moving_average_m"] is None
    assert record["moving_average_samples"] == 1


@pytest.mark.parametrize("name", ["moving_average_m", "start_length_m", "speed_kmh", "segment_m"])
@pytest.mark.parametrize("value", [-1.0, math.nan, math.inf])
def test_impossible_value_is_refused_by_name(name: str, value: float) -> None:
    with pytest.raises(InputError, match=f"{name} is {value}"):
        IriSettings(**{name: value})


@pytest.mark.parametrize("name", ["start_length_m", "speed_kmh", "segment_m"])
def test_zero_is_refused_where_it_divides(name: str) -> None:
    with pytest.raises(InputError, match=name):
        IriSettings(**{name: 0.0})
