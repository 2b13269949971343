"""Lost counts and leaps are no brake, and a vehicle that rolls back has lost no travel."""

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from tests.sdk.estimators.road_slope.test_stretches import STEP, drive_at, speeds, stop

from floatref.estimators.laser_place.travelled import MOMENT_S, Travelled, rolled_back
from floatref.estimators.road_slope.readings import Drive
from floatref.estimators.road_slope.stretches import find_stretches

SPEED, BEGIN, SIZE = st.floats(2.0, 30.0), st.integers(20, 2000), st.integers(1, 45)


def driven(drive: Drive, travelled: Travelled) -> Drive:
    """Return the drive that is known by ``travelled``."""
    speed = np.gradient(travelled.distance, STEP)
    lost = travelled.lost | travelled.guessed
    return drive._replace(distance=travelled.distance, speed=speed, lost=lost)


def without_counts(drive: Drive, begin: int, end: int) -> Travelled:
    """Return what is known if the encoder is silent from bin ``begin`` to ``end - 1``."""
    counted = drive.distance.copy()
    counted[end:] -= counted[end] - counted[begin]
    counted[begin:end] = np.nan
    return Travelled.of(counted, np.zeros(counted.size, np.bool_), STEP)


def leapt(drive: Drive, at: int, size_m: float, share: float) -> Travelled:
    """Return what is known if the encoder leaps in a bin, of which a ``share`` lies before it."""
    counted = drive.distance.copy()
    counted[at] += (1.0 - share) * size_m
    counted[at + 1 :] += size_m
    return Travelled.of(counted, np.arange(counted.size) == at, STEP)


@given(speed=SPEED, begin=BEGIN, size=SIZE)
def test_lost_counts_at_one_speed_are_no_brake(speed: float, begin: int, size: int) -> None:
    drive = drive_at(speeds((60, speed), (1, speed)))
    assert find_stretches(driven(drive, without_counts(drive, begin, begin + size))) == []


@given(speed=SPEED, at=BEGIN, size_m=st.floats(0.1, 30.0), share=st.floats(0.0, 1.0))
def test_a_leap_at_one_speed_is_no_brake(
    speed: float, at: int, size_m: float, share: float
) -> None:
    drive = drive_at(speeds((60, speed), (1, speed)))
    found = leapt(drive, at, size_m, share)
    assert found.guessed[at]
    assert find_stretches(driven(drive, found)) == []


@given(
    braking=st.floats(-3.0, 3.0),
    place=st.floats(0.1, 0.9),
    size=SIZE,
    size_m=st.floats(0.1, 30.0),
)
def test_through_a_loss_and_a_leap_the_vehicle_goes_on_at_its_acceleration(
    braking: float, place: float, size: int, size_m: float
) -> None:
    """A parabola of distance has a line of speeds: the travel is exact."""
    time = STEP * np.arange(250)
    drive = drive_at(17.0 + braking * time)
    at = round(place * 250)
    assume(2 < at < 247 - size)
    for found in (without_counts(drive, at, at + size), leapt(drive, at, size_m, 0.3)):
        np.testing.assert_allclose(found.distance, drive.distance, atol=1e-9)


@given(speed=SPEED, share=st.floats(0.1, 0.9), count=st.integers(1, 12), size_m=st.floats(0.1, 3.0))
def test_several_leaps_are_each_bridged(
    speed: float, share: float, count: int, size_m: float
) -> None:
    drive = drive_at(speeds((20, speed), (1, speed)))
    counted, places = drive.distance.copy(), 30 + 17 * np.arange(count)
    for at in places.tolist():
        counted[at] += share * size_m
        counted[at + 1 :] += size_m
    found = Travelled.of(counted, np.isin(np.arange(counted.size), places), STEP)
    np.testing.assert_allclose(found.distance, drive.distance, atol=1e-9)


@given(count=st.integers(1, 9), lost=st.integers(0, 9))
def test_the_shortest_runs_have_what_is_known_of_them(count: int, lost: int) -> None:
    counted = 0.2 * np.arange(count)
    counted[: min(lost, count)] = np.nan
    found = Travelled.of(counted, np.zeros(count, np.bool_), STEP)
    # Nothing is known before the first count.
    np.testing.assert_array_equal(found.lost | found.rolled, np.isnan(counted))
    known = ~np.isnan(counted)
    np.testing.assert_allclose(found.distance[known], counted[known])


@given(speed=st.floats(5.0, 30.0), lost_s=st.floats(0.3, 3.0))
def test_a_loss_is_bridged_up_to_a_second(speed: float, lost_s: float) -> None:
    """A longer one may hide a stop, so nothing is made up."""
    assume(abs(lost_s - 1.0) > 0.03)
    drive = drive_at(speeds((20, speed), (1, speed)))
    size = round(lost_s / STEP)
    found = without_counts(drive, 300, 300 + size)
    travel = found.distance[300 + size] - found.distance[300]
    assert travel == pytest.approx(speed * lost_s if lost_s < 1.0 else 0.0, abs=2 * speed * STEP)
    assert (found.guessed if lost_s < 1.0 else found.lost)[300 : 300 + size].all()


@given(speed=SPEED, size=st.integers(1, 20))
def test_a_moment_without_counts_is_no_guess_and_a_leap_is_one(speed: float, size: int) -> None:
    drive = drive_at(speeds((20, speed), (1, speed)))
    counted = drive.distance.copy()
    counted[300 : 300 + size] = np.nan
    found = Travelled.of(counted, np.zeros(counted.size, np.bool_), STEP)
    assert found.guessed.any() == (size * STEP > MOMENT_S)
    assert leapt(drive, 300, 1.0, 0.5).guessed[300]


@given(speed=st.floats(5.0, 20.0), phase=st.floats(0.0, 1.0), size_m=st.floats(2.0, 10.0))
def test_the_speed_beside_a_leap_is_that_of_several_coarse_counts(
    speed: float, phase: float, size_m: float
) -> None:
    """An encoder of 0.25 m a count stands still for whole bins between its counts."""
    true_m = drive_at(speeds((20, speed), (1, speed))).distance
    counted = 0.25 * np.floor(true_m / 0.25 + phase)
    counted[400:] += size_m
    found = Travelled.of(counted, np.isin(np.arange(counted.size), [399, 400]), STEP)
    assert np.abs(found.distance - found.distance[0] - true_m + true_m[0]).max() < 1.0


@given(braking=st.floats(2.0, 8.0), standing_s=st.floats(0.0, 5.0), ends=st.booleans())
def test_a_stop_within_lost_counts_is_a_stretch(
    braking: float, standing_s: float, ends: bool
) -> None:
    """The speed on both sides is one, or the run ends with the counts."""
    drive = drive_at(stop(15.0, braking, standing_s))
    slow = np.flatnonzero(drive.speed < 14.9)
    begin, end = int(slow[0]) - 5, drive.speed.size - 1 if ends else int(slow[-1]) + 5
    assert find_stretches(driven(drive, without_counts(drive, begin, end))) != []


@given(size=st.integers(5, 150))
def test_a_brake_is_one_whose_counts_are_lost(size: int) -> None:
    """What is lost lies in a brake of 3 s, which the speed on both sides shows."""
    drive = drive_at(speeds((30, 20.0), (3, 14.0), (30, 14.0)))
    begin = round(30 / STEP)
    ((piece,),) = find_stretches(driven(drive, without_counts(drive, begin, begin + size)))
    assert piece.start < begin
    assert piece.stop > begin + size


def lost_at(drive: Drive, begin: int, end: int) -> tuple[np.ndarray, np.ndarray]:
    lost = np.zeros(drive.distance.size, np.bool_)
    lost[begin:end] = True
    return lost, rolled_back(lost, drive.distance, STEP)


@given(
    # Up to the bin before the standstill, 0.1 s of a brake take 6 mm for each m/s²: 30 mm at 5.
    braking=st.floats(0.7, 4.9),
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
    counted = np.where(lost, np.nan, drive.distance)
    whole = Travelled.of(counted, np.zeros(counted.size, np.bool_), STEP)
    assert not (whole.lost | whole.guessed).any()


@given(braking=st.floats(0.7, 8.0), early_s=st.floats(1.0, 3.0), standing_s=st.floats(1.0, 60.0))
def test_a_wheel_that_locks_has_lost_travel(
    braking: float, early_s: float, standing_s: float
) -> None:
    """It stands from some speed on, to the end of the standstill."""
    drive = drive_at(stop(20.0, braking, standing_s))
    stood = np.flatnonzero(drive.speed < 0.01)
    begin, end = int(stood[0]) - round(early_s / STEP), int(stood[-1]) + 1
    assert not without_counts(drive, begin, end).rolled.any()


@given(speed=st.floats(2.0, 30.0), begin=st.integers(0, 2900), size=st.integers(1, 400))
def test_counts_lost_in_motion_or_at_an_end_are_lost(speed: float, begin: int, size: int) -> None:
    drive = drive_at(speeds((60, speed), (1, speed)))
    _, found = lost_at(drive, begin, begin + size)
    assert not found.any()
