import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref.values.channels import STANDARD_GRAVITY
from floatref_conformance.proving_ground.drives import manoeuvres, phases
from floatref_conformance.proving_ground.drives.drive import Drive

FEW = settings(deadline=None, max_examples=30)
SPEEDS = st.floats(8.0, 30.0)
MEANS = st.floats(0.1, 0.9).map(lambda g: g * STANDARD_GRAVITY)
LENGTH_M = 900.0


def jumps(drive: Drive) -> list[tuple[float, float]]:
    """Place in m and size in m/s² of every jump of the acceleration within the drive."""
    found = []
    for k, (before, after) in enumerate(
        zip(drive.segments, drive.segments[1:], strict=False), start=1
    ):
        end = before.acceleration + before.duration_s * before.jerk
        if abs(after.acceleration - end) > 1e-9:
            found.append((float(drive.knot_distances_m[k]), after.acceleration - end))
    return found


def fastest_jerk(drive: Drive) -> float:
    return max(abs(segment.jerk) for segment in drive.segments)


def brake_time(drive: Drive, until: float) -> float:
    """Time in s from the first deceleration to where the drive reaches ``until`` in m."""
    onset = next(k for k, s in enumerate(drive.segments) if s.jerk < 0)
    end = np.argmin(np.abs(drive.knot_distances_m - until))
    return float(drive.knot_times_s[end] - drive.knot_times_s[onset])


@given(SPEEDS, st.floats(0.1, 0.9), MEANS)
@FEW
def test_a_brake_ends_at_its_place_speed_and_mean(speed: float, share: float, mean: float) -> None:
    drive = manoeuvres.braking(speed, share * speed, mean, 600.0, LENGTH_M)
    assert drive.length_m == pytest.approx(LENGTH_M)
    ((place, size),) = jumps(drive)
    assert place == pytest.approx(600.0, abs=1e-6)
    assert size > mean
    at_release = int(np.argmin(np.abs(drive.knot_distances_m - 600.0)))
    assert drive.knot_speeds_mps[at_release] == pytest.approx(share * speed)
    elapsed = brake_time(drive, 600.0)
    assert (speed - share * speed) / elapsed == pytest.approx(mean, rel=1e-9)


@given(SPEEDS, MEANS, st.floats(0.0, 60.0))
@FEW
def test_a_stop_stands_at_its_place_for_its_dwell(speed: float, mean: float, dwell: float) -> None:
    drive = manoeuvres.stop(speed, mean, 600.0, dwell, 15.0, LENGTH_M)
    knot = int(np.flatnonzero(drive.knot_speeds_mps == 0.0)[0])
    start = drive.knot_times_s[knot]
    standing = drive.motion(start + dwell * np.array([0.0, 0.3, 1.0]))
    assert not standing.speed.any()
    np.testing.assert_allclose(standing.distance, 600.0, atol=1e-6)
    assert drive.motion(np.array([start + dwell + 0.1])).speed[0] > 0
    ((place, _),) = jumps(drive)
    assert place == pytest.approx(600.0, abs=1e-6)
    assert drive.final_speed == pytest.approx(15.0)


@given(SPEEDS, MEANS)
@FEW
def test_a_stop_keeps_its_mean_from_1_5_kmh_below_cruise_to_0_5_kmh(
    speed: float, mean: float
) -> None:
    drive = manoeuvres.stop(speed, mean, 600.0, 1.0, 15.0, LENGTH_M)
    start = brake_time(drive, 600.0)
    stands = drive.knot_times_s[int(np.flatnonzero(drive.knot_speeds_mps == 0.0)[0])]
    times = np.linspace(stands - start, stands, 200_001)
    falling = drive.motion(times).speed[::-1]
    upper, lower = speed - 1.5 / 3.6, 0.5 / 3.6
    passed = np.interp([lower, upper], falling, times[::-1])
    assert (upper - lower) / (passed[0] - passed[1]) == pytest.approx(mean, rel=1e-4)


@given(st.lists(st.floats(200.0, 300.0), min_size=2, max_size=3), st.floats(0.0, 5.0))
@FEW
def test_several_stops_come_one_behind_the_other(gaps: list[float], dwell: float) -> None:
    places = np.cumsum(gaps)
    drive = manoeuvres.stops(14.0, 2.0, places, dwell, 12.0, 1200.0)
    met = [place for place, _ in jumps(drive)]
    np.testing.assert_allclose(met, places, atol=1e-6)


@given(SPEEDS, st.floats(0.3, 0.9), st.floats(10.0, 300.0))
@FEW
def test_coasting_and_throttle_are_gentle_and_start_at_their_place(
    speed: float, share: float, event: float
) -> None:
    slower = manoeuvres.coasting(speed, share * speed, event, 3000.0)
    faster = manoeuvres.throttle(share * speed, speed, event, 3000.0)
    for drive, final, limit in [(slower, share * speed, 0.03), (faster, speed, 0.15)]:
        assert not jumps(drive)
        assert drive.final_speed == pytest.approx(final)
        assert fastest_jerk(drive) <= 0.2 * STANDARD_GRAVITY
        assert drive.knot_distances_m[1] == pytest.approx(event)
        peak = max(abs(s.acceleration) for s in drive.segments)
        assert peak <= limit * STANDARD_GRAVITY * (1 + 1e-12)


def test_a_near_stop_never_stands() -> None:
    drive = manoeuvres.near_stop(20.0, 3.2, 2.0, 300.0, 2.2, 16.0, LENGTH_M)
    assert drive.knot_speeds_mps.min() > 1.0
    assert drive.final_speed == pytest.approx(16.0)
    (release, throttle) = jumps(drive)
    assert release[0] == pytest.approx(300.0)
    assert throttle[0] > release[0]


@given(st.floats(0.05, 0.99))
@FEW
def test_a_near_stop_can_go_on_slower_than_it_coasted(share: float) -> None:
    coasted = manoeuvres.near_stop(20.0, 3.2, 2.0, 300.0, 2.2, 3.2, LENGTH_M)
    slowest = float(coasted.knot_speeds_mps.min())
    drive = manoeuvres.near_stop(20.0, 3.2, 2.0, 300.0, 2.2, share * slowest, LENGTH_M)
    assert drive.final_speed == pytest.approx(share * slowest)
    assert drive.length_m == pytest.approx(LENGTH_M)
    after = int(np.argmin(np.abs(drive.knot_speeds_mps - slowest)))
    assert (np.diff(drive.knot_speeds_mps[after:]) <= 1e-12).all()


@given(st.floats(0.0, 20.0), st.floats(2.0, 25.0))
@FEW
def test_a_dead_start_stands_first_and_sets_off_without_a_jerk(dwell: float, final: float) -> None:
    drive = manoeuvres.dead_start(dwell, final, LENGTH_M)
    assert not jumps(drive)
    motion = drive.motion(np.array([0.0, dwell, dwell + 0.5]))
    np.testing.assert_allclose(motion.speed[:2], 0.0)
    assert motion.speed[2] > 0
    assert drive.final_speed == pytest.approx(final)


@given(st.floats(0.3, 2.0), st.floats(0.1, 1.0), st.floats(20.0, 200.0))
@FEW
def test_creeping_wanders_between_its_speeds(slowest: float, above: float, length: float) -> None:
    drive = manoeuvres.creeping(slowest, slowest + above, length)
    speed = drive.motion(np.linspace(0.0, drive.duration_s, 20_001)).speed
    assert speed.min() == pytest.approx(slowest, abs=1e-6)
    assert speed.max() == pytest.approx(slowest + above, rel=1e-3)
    assert drive.length_m >= length
    assert not jumps(drive)


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: manoeuvres.stop(20.0, 2.0, 50.0, 1.0, 15.0, 500.0), "stop at 50.0 m lies"),
        (lambda: manoeuvres.stops(10.0, 2.0, (100.0, 110.0), 1.0, 10.0, 500.0), "stop at 110.0 m"),
        (lambda: manoeuvres.stop(20.0, 2.0, 200.0, -1.0, 15.0, 500.0), "dwell is -1.0"),
        (lambda: manoeuvres.braking(20.0, 21.0, 2.0, 300.0, 500.0), "cannot brake from 72 km/h"),
        (lambda: manoeuvres.braking(20.0, 10.0, 0.0, 300.0, 500.0), "mean deceleration is 0 m/s²"),
        (lambda: manoeuvres.stop(5 / 9, 2.0, 200.0, 1.0, 15.0, 500.0), "^2 km/h is too slow for a"),
        (lambda: phases.set_off(1 / 3, 0.1, 2.0), "from 1.2 km/h to 0.36 km/h; raise the final"),
        (lambda: phases.set_off(0.0, 10.0, 0.0), "setting off at 0 m/s² gets nowhere"),
        (lambda: manoeuvres.constant(0.0, 500.0), "cannot be reached at 0 km/h"),
        (lambda: manoeuvres.creeping(2.0, 1.0, 500.0), "creeping from 2.0 to 1.0"),
        (lambda: manoeuvres.throttle(5.0, 20.0, 450.0, 500.0), "the end of the drive lies"),
    ],
)
def test_impossible_manoeuvres_are_refused(call: object, message: str) -> None:
    assert callable(call)
    with pytest.raises(InputError, match=message):
        call()
