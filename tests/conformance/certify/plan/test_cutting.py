"""Cutting to a section: all of it, no more than compare needs, and nothing that has no need."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref.measures import on_common_grid
from floatref.values.profile import Profile, ProfileTrack
from floatref_conformance.certify.plan.cutting import section_of, within


def profile(length_m, interval_m=0.05, start_m=0.0, missing=()):
    """A profile whose elevation is the place itself, in mm."""
    places = start_m + interval_m * np.arange(round(length_m / interval_m) + 1)
    elevation = 1e-3 * places
    elevation[list(missing)] = np.nan
    return Profile(interval_m, (ProfileTrack.of("left", elevation),), start_m)


@settings(deadline=None)
@given(
    st.floats(0.004, 0.3),
    st.floats(-60.0, -2.0),
    st.floats(0.0, 5.0),
    st.floats(20.0, 60.0),
)
def test_a_cut_run_covers_the_section_and_no_point_more(interval, start, first, last):
    run = profile(150.0, interval, start)
    cut = within(run, first, last)
    assert cut.start_m <= first + 1e-9 < cut.start_m + interval + 1e-9
    end = cut.start_m + cut.length_m
    assert end - interval - 1e-6 < last <= end + 1e-6
    assert np.allclose(cut.tracks[0].elevation, 1e-3 * cut.distance_m, rtol=0.0, atol=1e-9)


@settings(deadline=None)
@given(st.floats(0.004, 0.3), st.floats(-60.0, -2.0))
def test_cutting_leaves_every_point_of_the_reference_covered(interval, start):
    reference = profile(40.0)
    run = profile(150.0, interval, start)
    whole, _ = on_common_grid(reference, run)
    _, found = on_common_grid(reference, within(run, 0.0, 40.0))
    assert found.tracks[0].elevation.size == whole.tracks[0].elevation.size
    assert np.allclose(
        found.tracks[0].elevation, reference.tracks[0].elevation, rtol=0.0, atol=1e-6
    )


@pytest.mark.parametrize("start_m", [-0.9, 0.0, 0.9])
def test_a_run_no_longer_than_the_section_is_left_alone(start_m):
    run = profile(40.0, start_m=start_m)
    assert within(run, 0.0, 40.0) is run


@pytest.mark.parametrize("start_m", [-20.0, 20.0])
def test_a_short_run_far_beyond_an_end_is_cut(start_m):
    cut = within(profile(40.0, start_m=start_m), 0.0, 40.0)
    assert cut.length_m == pytest.approx(20.0)


def test_a_run_elsewhere_is_refused_with_both_places():
    with pytest.raises(InputError, match="covers 50 to 90 m, nothing of the section from 0 to 40"):
        within(profile(40.0, start_m=50.0), 0.0, 40.0)


def test_the_section_is_all_that_the_reference_measured():
    reference = profile(40.0)
    assert section_of(reference, None) is reference
    cut = section_of(profile(40.0, missing=(0, 1, 800)), None)
    assert (cut.start_m, cut.start_m + cut.length_m) == pytest.approx((0.1, 39.95))


def test_a_section_of_the_reference_holds_its_ends():
    cut = section_of(profile(40.0), (10.0, 30.0))
    assert (cut.start_m, cut.length_m) == pytest.approx((10.0, 20.0))


@pytest.mark.parametrize(
    ("stretch", "said"),
    [
        ((10.0, 50.0), "reaches beyond the reference, which covers 0 to 40 m"),
        ((-5.0, 30.0), "reaches beyond the reference"),
        ((30.0, 10.0), "give FROM:TO in m, the first below the second"),
        ((np.nan, 10.0), "give FROM:TO"),
        ((10.01, 10.02), "holds no two points"),
    ],
)
def test_a_section_that_the_reference_does_not_hold_is_refused(stretch, said):
    with pytest.raises(InputError, match=said):
        section_of(profile(40.0), stretch)


def test_a_reference_with_a_hole_in_the_section_is_no_truth():
    holed = profile(40.0, missing=range(400, 420))
    with pytest.raises(InputError, match=r"20 points without elevation .* from 20\.00 m on"):
        section_of(holed, None)
    assert section_of(holed, (0.0, 19.9)).length_m == pytest.approx(19.9)


def test_a_reference_without_elevations_is_refused():
    with pytest.raises(InputError, match="no two points"):
        section_of(profile(1.0, missing=range(21)), None)
