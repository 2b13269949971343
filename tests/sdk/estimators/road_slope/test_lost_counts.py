"""Lost counts are no brake, and a vehicle that rolls back at a stop has lost no travel."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from tests.sdk.estimators.road_slope.test_stretches import STEP, drive_at, speeds, stop

from floatref.estimators.road_slope.readings import Drive
from floatref.estimators.road_slope.stretches import find_stretches, rolled_back


def without_counts(drive: Drive, begin: int, end: int) -> Drive:
    """Return a drive whose encoder is silent from bin ``begin`` to ``end - 1``, and goes on."""
    lost = np.zeros(drive.distance.size, np.bool_)
    lost[begin:end] = True
    distance = drive.distance.copy()
    distance[end:] -= distance[end] - distance[begin]
    distance[begin:end] = distance[begin]
    return drive._replace(distance=distance, speed=np.gradient(distance, STEP), lost=lost)


@given(speed=st.floats(2.0, 30.0), begin=st.integers(10, 2000), size=st.integers(1, 45))
def test_lost_counts_at_one_speed_are_no_brake(speed: float, begin: int, size: int) -> None:
    drive = drive_at(speeds((60, speed), (1, speed)))
    assert find_stretches(without_counts(drive, begin, begin + size)) == []


@given(count=st.integers(2, 9), lost=st.integers(0, 8))
def test_the_shortest_runs_are_no_stretch(count: int, lost: int) -> None:
    drive = drive_at(np.full(count, 10.0))
    gone = np.zeros(count, np.bool_)
    gone[: min(lost, count)] = True
    assert find_stretches(drive._replace(lost=gone)) == []


@given(braking=st.floats(2.0, 8.0), standing_s=st.floats(0.0, 5.0), ends=st.booleans())
def test_a_stop_within_lost_counts_is_a_stretch(
    braking: float, standing_s: float, ends: bool
) -> None:
    """The speed on both sides is one, or the run ends with the counts."""
    drive = drive_at(stop(15.0, braking, standing_s))
    slow = np.flatnonzero(drive.speed < 14.9)
    begin, end = int(slow[0]) - 5, drive.speed.size - 1 if ends else int(slow[-1]) + 5
    assert find_stretches(without_counts(drive, begin, end)) != []


@given(size=st.integers(5, 150))
def test_a_brake_is_one_whose_counts_are_lost(size: int) -> None:
    """What is lost lies in a brake of 3 s, which the speed on both sides shows."""
    drive = drive_at(speeds((30, 20.0), (3, 14.0), (30, 14.0)))
    begin = round(30 / STEP)
    ((piece,),) = find_stretches(without_counts(drive, begin, begin + size))
    assert piece.start < begin
    assert piece.stop > begin + size


def lost_at(drive: Drive, begin: int, end: int) -> tuple[np.ndarray, np.ndarray]:
    lost = np.zeros(drive.distance.size, np.bool_)
    lost[begin:end] = True
    return lost, rolled_back(lost, drive.distance, STEP)


@given(
    braking=st.floats(0.7, 5.0),
    standing_s=st.floats(3.0, 60.0),
    ends=st.tuples(st.floats(0.0, 1.0), st.floats(0.2, 2.0)),
)
def test_what_is_lost_within_a_standstill_is_no_travel(
    braking: float, standing_s: float, ends: tuple[float, float]
) -> None:
    drive = drive_at(stop(15.0, braking, standing_s))
    stood = np.flatnonzero(drive.speed < 0.01)
    begin = int(stood[0]) + round(ends[0] / STEP)
    lost, found = lost_at(drive, begin, begin + round(ends[1] / STEP))
    np.testing.assert_array_equal(found, lost)


@given(braking=st.floats(0.7, 8.0), early_s=st.floats(1.0, 3.0), standing_s=st.floats(1.0, 60.0))
def test_a_wheel_that_locks_has_lost_travel(
    braking: float, early_s: float, standing_s: float
) -> None:
    """It stands from some speed on, to the end of the standstill."""
    drive = drive_at(stop(20.0, braking, standing_s))
    stood = np.flatnonzero(drive.speed < 0.01)
    begin, end = int(stood[0]) - round(early_s / STEP), int(stood[-1]) + 1
    held = without_counts(drive, begin, end)
    assert not rolled_back(held.lost, held.distance, STEP).any()


@given(speed=st.floats(2.0, 30.0), begin=st.integers(0, 2900), size=st.integers(1, 400))
def test_counts_lost_in_motion_or_at_an_end_are_lost(speed: float, begin: int, size: int) -> None:
    drive = drive_at(speeds((60, speed), (1, speed)))
    _, found = lost_at(drive, begin, begin + size)
    assert not found.any()
