"""What is held: slopes under the wheels, intensities, and a factor that falls to 1."""

from typing import Any

import numpy as np
import pytest

from floatref_reference.road_slope.bends import intensity_by_slopes
from floatref_reference.road_slope.constants import Constants
from floatref_reference.road_slope.held import first_held, held_after, held_by, loosened
from floatref_reference.road_slope.unknowns import as_vector
from floatref_reference.road_slope.wheels import slopes_under_wheels

C = Constants(interval_s=0.1, spacing_m=1.0)


def test_springs_are_sure_from_the_sixth_pass_on() -> None:
    assert [loosened(i) for i in range(4)] == [30, 15, 7.5, 3.75]
    assert loosened(4) == pytest.approx(30 / 16)
    assert [loosened(i) for i in range(5, 40)] == [1] * 35


def test_the_first_pass_has_a_flat_road_that_may_bend(stopping: Any) -> None:
    held = first_held(stopping(C))
    assert not held.beta.any()
    assert np.all(held.intensity == 30 * 2e-7)
    assert np.all(held.stepped == 1e-3)
    assert held.loose == 30


def test_the_next_pass_holds_what_was_found(drawn: Any, stopping: Any) -> None:
    stretch, truth = drawn(stopping(C), 5)
    held = held_after(as_vector(truth), stretch, 3.75)
    assert held.beta == pytest.approx(slopes_under_wheels(truth.elevation, stretch))
    assert np.array_equal(held.intensity, intensity_by_slopes(truth.slope, C))
    assert np.array_equal(held.stepped, np.diff(truth.offset))
    assert held.loose == 3.75
    assert held_by(as_vector(truth), stretch, held.intensity).loose == 1
