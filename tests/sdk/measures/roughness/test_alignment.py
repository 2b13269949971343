"""Two profiles on one grid: what both cover, interpolated linearly, flags kept."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref.measures import on_common_grid
from floatref.values.profile import Profile, ProfileTrack

FEW = settings(deadline=None, max_examples=30)


def plane(start: float, interval: float, count: int, grade: float = 0.01) -> Profile:
    x = start + interval * np.arange(count)
    return Profile(interval, (ProfileTrack.of("main", grade * x),), start_m=start)


@given(
    start=st.floats(-20.0, 20.0),
    interval=st.floats(0.01, 1.0),
    count=st.integers(100, 400),
    other_interval=st.floats(0.01, 1.0),
)
@FEW
def test_a_line_is_reproduced_on_the_points_of_the_reference(
    start: float, interval: float, count: int, other_interval: float
) -> None:
    reference = plane(0.0, interval, 200)
    other = plane(start, other_interval, count)
    low = max(0.0, start)
    high = min(reference.length_m, start + other.length_m)
    if high - low < 2 * interval:
        return
    expected, found = on_common_grid(reference, other)
    np.testing.assert_allclose(
        found.track("main").elevation, expected.track("main").elevation, atol=1e-8 * other_interval
    )
    np.testing.assert_array_equal(found.distance_m, expected.distance_m)
    assert expected.start_m >= low - 1e-5 * interval
    assert expected.start_m - low < interval
    assert high - (expected.start_m + expected.length_m) < interval


def test_profiles_on_one_grid_stay_as_they_are() -> None:
    rng = np.random.default_rng(1)
    z = rng.normal(size=50)
    first = Profile(0.00508, (ProfileTrack.of("left", z),), start_m=100.0)
    second = Profile(0.00508, (ProfileTrack.of("left", 2 * z),), start_m=100.0)
    p, q = on_common_grid(first, second)
    np.testing.assert_array_equal(p.track("left").elevation, z)
    np.testing.assert_array_equal(q.track("left").elevation, 2 * z)


def test_shifted_start_on_one_grid_moves_points_without_interpolation() -> None:
    z = np.random.default_rng(2).normal(size=50)
    first = Profile(0.1, (ProfileTrack.of("left", z),), start_m=1.0)
    second = Profile(0.1, (ProfileTrack.of("left", z[7:]),), start_m=1.7)
    p, q = on_common_grid(first, second)
    np.testing.assert_array_equal(p.track("left").elevation, q.track("left").elevation)
    assert p.start_m == pytest.approx(1.7)


def test_points_next_to_a_missing_or_untrusted_one_are_so_too() -> None:
    valid = np.ones(11, dtype=bool)
    valid[7] = False
    z = np.zeros(11)
    z[3] = np.nan
    coarse = Profile(1.0, (ProfileTrack.of("left", z, valid),))
    fine = Profile(0.5, (ProfileTrack.of("left", np.zeros(21)),))
    found = on_common_grid(fine, coarse)[1].track("left")
    np.testing.assert_array_equal(np.flatnonzero(np.isnan(found.elevation)), [5, 6, 7])
    np.testing.assert_array_equal(np.flatnonzero(~found.valid), [5, 6, 7, 13, 14, 15])


@pytest.mark.parametrize("start", [1000.0, -1000.0])
def test_profiles_apart_are_refused_with_both_spans(start: float) -> None:
    with pytest.raises(InputError, match=r"do not overlap: the reference covers 0 to 9.9 m"):
        on_common_grid(plane(0.0, 0.1, 100), plane(start, 0.1, 100))


@pytest.mark.parametrize("which", [0, 1])
def test_elevations_that_no_road_has_are_refused_by_track_and_point(which: int) -> None:
    z = np.zeros(100)
    z[40:42] = -1.7e308, 1.7e308
    pair = [plane(0.0, 0.1, 100), plane(0.0, 0.07, 100)]
    pair[which] = Profile(pair[which].interval_m, (ProfileTrack.of("main", z),))
    with pytest.raises(InputError, match=r"track main: elevation of point 40 is -1.7e\+308 m"):
        on_common_grid(*pair)
