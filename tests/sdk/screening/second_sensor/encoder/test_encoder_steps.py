"""Steps of an encoder between which the places are not known, however long the recording is."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.screening.second_sensor.encoder.encoder_steps import LONGEST_M, step_doubts
from floatref.values import scanning
from floatref.values.clock import StampedClock, UniformClock
from floatref.values.recording import Channel, Recording

RATE, SPEED, COUNT = 1000.0, 20.0, 8000
TRAVEL = SPEED * np.arange(COUNT) / RATE


def doubts(values: np.ndarray, is_stamped: bool = False) -> list[str]:
    clock = StampedClock.of(np.arange(values.size) / RATE) if is_stamped else UniformClock.of(RATE)
    found = step_doubts(Recording((Channel.of("distance", values, clock),)))
    return [doubt.line for doubt in found]


@settings(deadline=None, max_examples=30)
@given(st.floats(0.001, 2.0), st.integers(200, 3000))
def test_the_usual_step_is_that_in_which_half_of_the_way_is_travelled(
    step_m: float, chunk: int
) -> None:
    coarse = step_m * np.floor(TRAVEL / step_m)
    steps = np.sort(np.diff(coarse)[np.diff(coarse) > 0])
    usual = float(steps[np.searchsorted(np.cumsum(steps), steps.sum() / 2)])
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(scanning, "CHUNK", chunk)
        lines = doubts(coarse)
    assert len(lines) == (usual > LONGEST_M)
    assert all(f"in steps of {usual:.3g} m;" in line for line in lines)


def test_leaps_in_less_than_half_of_the_way_are_another_fault() -> None:
    values = TRAVEL + 10.0 * (np.arange(COUNT) > 4000)
    assert doubts(values) == []
    values[1000:1400] = np.nan
    assert doubts(values) == []


def test_counts_with_their_own_times_may_be_any_distance_apart() -> None:
    assert doubts(TRAVEL[::100], is_stamped=True) == []
    assert len(doubts(np.repeat(TRAVEL[::100], 100))) == 1
