"""A stretch holds what is active with its sides, and of a standstill its ends."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from floatref.estimators.road_slope.constants import SlopeModel
from floatref.estimators.road_slope.readings import Drive
from floatref.estimators.road_slope.stretches import (
    AFTER_STOP_S,
    BEFORE_M,
    BEFORE_START_S,
    BEHIND_M,
    BRAKING_MPS2,
    LONGEST_S,
    LONGEST_SIDE_S,
    SHARED_S,
    _pieces,
    find_stretches,
)

STEP = 0.02
INTERVAL_S = SlopeModel().interval_s


def drive_at(speed: np.ndarray) -> Drive:
    zero = np.zeros(speed.size)
    distance = np.cumsum(speed) * STEP
    return Drive(zero, zero > 0, zero, distance, speed, np.gradient(speed, STEP), zero > 0, STEP)


def speeds(*corners: tuple[float, float]) -> np.ndarray:
    """Return speeds in m/s on the line through ``corners``, each a duration in s and a speed."""
    times = np.cumsum([0.0, *(duration for duration, _ in corners)])
    at = np.arange(0.0, times[-1], STEP)
    return np.interp(at, times, [corners[0][1], *(speed for _, speed in corners)])


def stop(fast: float, braking: float, standing_s: float) -> np.ndarray:
    time = fast / braking
    parts = (60, fast), (time, 0.0), (standing_s, 0.0), (time, fast), (60, fast)
    return speeds(*parts)


@given(fast=st.floats(5.0, 30.0), braking=st.floats(0.7, 6.0), standing_s=st.floats(0.5, 60.0))
def test_a_stop_is_one_stretch_without_the_middle_of_its_standstill(
    fast: float, braking: float, standing_s: float
) -> None:
    drive = drive_at(stop(fast, braking, standing_s))
    (pieces,) = find_stretches(drive)
    used = np.concatenate([np.arange(piece.start, piece.stop) for piece in pieces])
    active = np.flatnonzero(np.abs(drive.along) > 1.1 * BRAKING_MPS2)
    assert np.isin(active[25:-25], used).all()
    stood = STEP * np.count_nonzero(drive.speed[used] == 0.0)
    assert stood == pytest.approx(min(standing_s, AFTER_STOP_S + BEFORE_START_S), abs=0.5)
    for end, bound_m in ((used[0], BEFORE_M), (used[-1], BEHIND_M)):
        near = active[0] if end == used[0] else active[-1]
        side = abs(drive.distance[end] - drive.distance[near])
        assert side == pytest.approx(min(bound_m, LONGEST_SIDE_S * fast), abs=0.4 * fast)


@given(speed=st.floats(0.0, 40.0), change=st.floats(-0.8, 0.8))
def test_a_gentle_change_of_speed_is_none_of_its_business(speed: float, change: float) -> None:
    fast = max(speed + 20 * change * BRAKING_MPS2, 0.0)
    assert find_stretches(drive_at(speeds((10, speed), (20, fast), (10, fast)))) == []


def test_a_queue_is_fitted_in_windows_that_share_their_ends() -> None:
    queue = [
        corner for _ in range(30) for corner in ((2.0, 4.0), (4.0, 4.0), (2.0, 0.0), (3.0, 0.0))
    ]
    found = find_stretches(drive_at(speeds((5, 0.0), *queue)))
    assert len(found) > 1
    for before, after in pairwise(found):
        shared = before[-1].stop - after[0].start
        assert SHARED_S / 2 <= shared * STEP <= 1.5 * SHARED_S
    assert all(window[-1].stop - window[0].start <= 1.2 * LONGEST_S / STEP for window in found)


@given(sizes=st.lists(st.integers(1, 60), min_size=1, max_size=6), gap=st.integers(2, 500))
def test_a_window_has_no_piece_too_short_for_a_row(sizes: list[int], gap: int) -> None:
    """Where a window ends next to a cut, a piece of a few samples would be left."""
    ends = np.cumsum(np.array(sizes) + gap)
    used = np.concatenate([np.arange(e - n, e) for e, n in zip(ends, sizes, strict=True)])
    pieces = _pieces(used, STEP)
    assert all(piece.stop - piece.start >= 3 * INTERVAL_S / STEP for piece in pieces)
    long = [n for n in sizes if n * STEP > 1.0]
    assert [n for p in pieces if (n := p.stop - p.start) * STEP > 1.0] == long


def test_two_stops_close_together_are_one_stretch_and_far_apart_two() -> None:
    fast, near, far = 15.0, 2.0, 60.0
    for between_s, count in ((near, 1), (far, 2)):
        one = ((5.0, 0.0), (3.0, 0.0), (5.0, fast))
        drive = drive_at(speeds((20, fast), *one, (between_s, fast), *one, (20, fast)))
        assert len(find_stretches(drive)) == count


def test_nothing_is_found_of_nothing() -> None:
    assert find_stretches(drive_at(np.zeros(3))) == []
