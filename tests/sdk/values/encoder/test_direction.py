"""Where a distance goes back: found wherever it lies, refused where it is most of the run."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref.values import scanning
from floatref.values.clock import UniformClock
from floatref.values.encoder.direction import (
    ROLLS_BACK_M,
    check_direction,
    forward_chunks,
    stretches_behind,
)
from floatref.values.recording import Channel

RATE, COUNT, SPEED = 1000.0, 4000, 20.0
few = settings(deadline=None, max_examples=60)


def travel() -> np.ndarray:
    return SPEED * np.arange(COUNT) / RATE


def distance(values: np.ndarray) -> Channel:
    return Channel.of("distance", values, UniformClock.of(RATE))


@pytest.mark.slow
@few
@given(
    chunk=st.integers(50, 900),
    number=st.integers(1, 3),
    beyond=st.integers(-1, 1),
    gap=st.integers(0, 40),
    back_m=st.floats(1.05, 60.0),
)
def test_a_step_back_is_found_wherever_the_chunks_end(
    chunk: int, number: int, beyond: int, gap: int, back_m: float
) -> None:
    at = chunk * number + beyond
    values, farthest = travel(), travel()[at - gap - 1]
    values[at:] -= values[at] - farthest + back_m
    values[at - gap : at] = np.nan
    ahead = np.flatnonzero(values[at:] >= farthest)
    end = at + int(ahead[0]) if ahead.size else COUNT
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(scanning, "CHUNK", chunk)
        np.testing.assert_array_equal(stretches_behind(distance(values)), [[at - gap, end]])
        forward = np.concatenate([each for _, each in forward_chunks(distance(values))])
        if 2 * (end - at + gap) > COUNT:
            with pytest.raises(InputError, match=f"channel distance: sample {at} goes back by"):
                check_direction(distance(values))
        else:
            check_direction(distance(values))
    known = forward[~np.isnan(forward)]
    assert (np.diff(known) >= 0.0).all()
    assert known.size == COUNT - (end - at + gap)


@few
@given(at=st.integers(1, COUNT - 2), depth_m=st.floats(0.001, 5.0), length=st.integers(2, 30))
def test_only_what_lies_farther_back_than_a_vehicle_rolls_counts(
    at: int, depth_m: float, length: int
) -> None:
    values = travel()
    end = min(at + length, COUNT)
    values[at:end] = values[at - 1] - depth_m
    found = stretches_behind(distance(values))
    if depth_m <= ROLLS_BACK_M:
        assert found.size == 0
    elif end - at > 1:
        np.testing.assert_array_equal(found, [[at, end]])


def test_a_distance_that_never_goes_back_has_no_stretch_whatever_is_missing() -> None:
    values = travel()
    values[:10] = values[500:900] = values[-3:] = np.nan
    assert stretches_behind(distance(values)).shape == (0, 2)


def test_a_second_distance_may_not_go_back_at_all() -> None:
    values = travel()
    values[1000:1100] -= 5.0
    check_direction(distance(values))
    with pytest.raises(InputError, match=r"sample 1000 goes back by 4\.98 m"):
        check_direction(distance(values), most=0.0)
