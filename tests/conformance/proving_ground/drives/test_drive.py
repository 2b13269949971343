import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref_conformance.proving_ground.drives.drive import Drive, Segment

SEGMENTS = st.lists(
    st.builds(Segment, st.floats(0.01, 10.0), st.floats(-1.0, 1.5), st.floats(-0.2, 0.2)),
    min_size=1,
    max_size=6,
)
GAUSS = np.polynomial.legendre.leggauss(3)


def drives(segments: list[Segment]) -> Drive:
    return Drive(150.0, tuple(segments))


@given(SEGMENTS)
@settings(deadline=None, max_examples=60)
def test_distance_is_the_integral_of_speed_and_speed_of_acceleration(
    segments: list[Segment],
) -> None:
    drive = drives(segments)
    nodes, weights = GAUSS
    starts = drive.knot_times_s[:-1]
    halves = np.diff(drive.knot_times_s) / 2
    motion = drive.motion((starts + halves)[:, None] + halves[:, None] * nodes)
    driven = motion.speed @ weights * halves
    gained = motion.acceleration @ weights * halves
    ends = drive.motion(drive.knot_times_s)
    np.testing.assert_allclose(np.diff(ends.distance), driven, rtol=1e-11, atol=1e-9)
    np.testing.assert_allclose(np.diff(ends.speed), gained, atol=1e-9)


@given(SEGMENTS, st.integers(0, 5), st.floats(0.1, 0.9))
@settings(deadline=None, max_examples=60)
def test_a_segment_cut_in_two_drives_the_same(
    segments: list[Segment], which: int, share: float
) -> None:
    which %= len(segments)
    whole = segments[which]
    first_s = share * whole.duration_s
    parts = [
        Segment(first_s, whole.acceleration, whole.jerk),
        Segment(whole.duration_s - first_s, whole.acceleration + first_s * whole.jerk, whole.jerk),
    ]
    cut = drives([*segments[:which], *parts, *segments[which + 1 :]])
    times = np.linspace(-1.0, cut.duration_s + 1.0, 500)
    expected = drives(segments).motion(times)
    np.testing.assert_allclose(cut.motion(times).distance, expected.distance, rtol=1e-11, atol=1e-9)
    np.testing.assert_allclose(cut.motion(times).speed, expected.speed, rtol=1e-11)


@given(SEGMENTS)
@settings(deadline=None, max_examples=30)
def test_times_come_in_any_order_and_shape(segments: list[Segment]) -> None:
    drive = drives(segments)
    times = np.linspace(-2.0, drive.duration_s + 2.0, 60)
    order = np.argsort(np.sin(97.0 * times))
    expected = drive.motion(times).distance[order].reshape(6, 10)
    assert np.array_equal(drive.motion(times[order].reshape(6, 10)).distance, expected)


def test_before_and_after_the_drive_the_speed_is_held() -> None:
    drive = Drive(10.0, (Segment(2.0, 1.0, 0.5),))
    motion = drive.motion(np.array([-3.0, 5.0]))
    np.testing.assert_allclose(motion.speed, [10.0, 13.0])
    np.testing.assert_allclose(motion.distance, [-30.0, drive.length_m + 39.0])
    assert not motion.acceleration.any()


@given(st.floats(0.5, 30.0), st.floats(0.3, 9.0), st.floats(0.05, 0.5))
@settings(deadline=None, max_examples=60)
def test_a_standstill_is_exact(speed: float, deceleration: float, onset_s: float) -> None:
    onset = Segment(onset_s, 0.0, -min(deceleration, speed) / onset_s)
    held_s = (speed - min(deceleration, speed) * onset_s / 2) / deceleration
    drive = Drive(speed, (onset, Segment(held_s, -deceleration), Segment(50.0)))
    standing = drive.motion(np.linspace(drive.knot_times_s[2], drive.duration_s, 100))
    assert not standing.speed.any()
    assert np.ptp(standing.distance) == 0.0


@pytest.mark.parametrize(
    ("speed", "segment", "message"),
    [
        (-1.0, Segment(1.0), "initial speed is -1.0"),
        (1.0, Segment(-1.0), "segment 1 of the drive"),
        (1.0, Segment(1.0, float("nan")), "segment 1 of the drive"),
        (1.0, Segment(2.0, -1.0), "goes backwards"),
    ],
)
def test_impossible_drives_are_refused(speed: float, segment: Segment, message: str) -> None:
    with pytest.raises(InputError, match=message):
        Drive(speed, (segment,))
