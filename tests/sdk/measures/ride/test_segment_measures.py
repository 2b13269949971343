"""Measures of segments: together they are those of the whole profile, and marks stay with them."""

from math import isnan, nan

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref.measures import (
    bumps_and_dips,
    half_car_roughness_index,
    join_profile_indices,
    localized_roughness,
    mean_path,
    profile_indices,
    profilograph_trace,
    ride_number,
    ride_profile_index,
    rolling_straightedge,
    valid_frames,
)
from floatref.measures.ride.profile_index import TraceRules
from floatref.measures.ride.segment_measures import MEASURES, RideLimits, segment_measures
from floatref.measures.roughness.roughness_index import segment_edges
from floatref.values.profile import Profile, ProfileTrack

INTERVAL_M = 0.05


def road(seed, tracks=2, count=3000, size=4e-4):
    """Return a rough road of 150 m with a gap and a stretch that is not valid."""
    draw = np.random.default_rng(seed)
    found = []
    for name in ("left", "right", "middle")[:tracks]:
        elevation = np.cumsum(draw.normal(0.0, size, count))
        elevation[count // 3 : count // 3 + 20] = np.nan
        valid = np.ones(count, bool)
        first = int(draw.integers(0, max(count - 400, 1)))
        valid[first : first + 400] = False
        found.append(ProfileTrack.of(name, elevation, valid))
    return Profile(INTERVAL_M, tuple(found))


def edges_of(profile, segment_m):
    return segment_edges(profile.tracks[0].elevation.size - 1, profile.interval_m, segment_m)


def test_one_segment_has_the_measures_of_the_whole_profile():
    profile = road(1, size=1e-3)
    found = segment_measures(profile, edges_of(profile, None))
    left, right = (track.elevation for track in profile.tracks)
    indices = [ride_profile_index(z, INTERVAL_M) for z in (left, right)]
    mean, both = (
        mean_path(left, right, INTERVAL_M),
        profile.tracks[0].valid & profile.tracks[1].valid,
    )
    for track, index, (one,) in zip(profile.tracks, indices, found, strict=True):
        z, valid = track.elevation, track.valid
        areas = localized_roughness(z, INTERVAL_M, 2.5, valid=valid)
        length = sum(area.end_m - area.start_m for area in areas)
        edge = rolling_straightedge(z, INTERVAL_M, valid=valid)
        trace, sound = profilograph_trace(z, INTERVAL_M), valid_frames(z, INTERVAL_M, valid=valid)
        (read,) = profile_indices(trace, sound, INTERVAL_M, TraceRules(segment_m=1e6))
        places = bumps_and_dips(mean, INTERVAL_M, valid=both)
        assert areas
        assert places
        assert one.ride_number == pytest.approx(ride_number(index), rel=1e-12)
        assert one.localized_roughness_m == pytest.approx(length, rel=1e-12)
        peak = max(area.peak_m_per_km for area in areas)
        assert one.localized_roughness_peak_m_per_km == pytest.approx(peak, rel=1e-12)
        assert one.straightedge_largest_m == edge.largest_m
        assert one.straightedge_defective_share == edge.defective_share
        assert one.straightedge_valid_share == edge.valid_share < 1.0
        assert one.profile_index_m_per_km == pytest.approx(read.profile_index_m_per_km, rel=1e-12)
        assert one.profile_index_valid_share == read.valid_share < 1.0
        half_car = half_car_roughness_index(left, right, INTERVAL_M)
        assert one.half_car_roughness_index_m_per_km == pytest.approx(half_car, rel=1e-12)
        joined = ride_number(join_profile_indices(*indices))
        assert one.lane_ride_number == pytest.approx(joined, rel=1e-12)
        across = sum(place.end_m - place.start_m + INTERVAL_M for place in places)
        assert one.bumps_and_dips_m == pytest.approx(across, rel=1e-9)
        largest = max(abs(place.deviation_m) for place in places)
        assert one.bumps_and_dips_largest_m == largest
        assert one.lane_valid_share == np.mean(both)


@settings(max_examples=25)
@given(seed=st.integers(0, 1000), segment_m=st.floats(5.0, 80.0), tracks=st.integers(1, 2))
def test_lengths_add_up_and_largest_values_are_in_one_segment(seed, segment_m, tracks):
    profile = road(seed, tracks)
    edges = edges_of(profile, segment_m)
    whole = segment_measures(profile, edges_of(profile, None))
    for found, (one,) in zip(segment_measures(profile, edges), whole, strict=True):
        for name in ("localized_roughness_m", "bumps_and_dips_m"):
            total = np.nansum([getattr(part, name) for part in found])
            assert total == pytest.approx(getattr(one, name), abs=1e-9)
        for name in (
            "localized_roughness_peak_m_per_km",
            "straightedge_largest_m",
            "bumps_and_dips_largest_m",
        ):
            assert np.nanmax([getattr(part, name) for part in found]) == getattr(one, name)
        counts = np.diff(edges)
        cars = [part.half_car_roughness_index_m_per_km for part in found]
        if tracks == 2:
            mean = np.average(cars, weights=counts)
            assert mean == pytest.approx(one.half_car_roughness_index_m_per_km, rel=1e-9)
        else:
            assert all(map(isnan, cars))
            assert all(isnan(part.lane_ride_number) for part in found)


@settings(max_examples=25)
@given(seed=st.integers(0, 1000), segment_m=st.floats(5.0, 80.0))
def test_a_figure_over_points_that_are_not_valid_has_a_share_below_one(seed, segment_m):
    profile = road(seed, 1)
    edges = edges_of(profile, segment_m)
    (found,) = segment_measures(profile, edges)
    valid = profile.tracks[0].valid
    for part, first, end in zip(found, edges[:-1], edges[1:], strict=True):
        if not valid[first:end].all():
            assert part.lane_valid_share < 1.0
        if not valid[first:end].any():
            for name in MEASURES:
                if name.endswith("valid_share"):
                    assert not getattr(part, name) > 0.0


def test_limits_are_those_that_are_given():
    profile = road(1)
    edges = edges_of(profile, 50.0)
    strict = segment_measures(profile, edges, RideLimits(1e-6, 1e-9, 3.048, 1e-9))
    loose = segment_measures(profile, edges, RideLimits(1e6, 1e3, 3.048, 1e3))
    for hard, soft in zip(strict[0], loose[0], strict=True):
        assert hard.localized_roughness_m == pytest.approx(50.0, abs=1.1)
        assert hard.straightedge_defective_share > 0.99
        assert (soft.localized_roughness_m, soft.straightedge_defective_share) == (0.0, 0.0)
        assert soft.bumps_and_dips_m in (0.0, pytest.approx(nan, nan_ok=True))


def test_three_wheel_paths_have_no_lane():
    profile = road(1, 3)
    (one, *_) = segment_measures(profile, edges_of(profile, None))[0]
    assert isnan(one.lane_ride_number)
    assert isnan(one.bumps_and_dips_m)
    assert one.ride_number > 0.0


def test_a_profile_that_is_too_short_for_the_car_is_refused():
    profile = road(1, 1, count=150)
    with pytest.raises(InputError, match="the car needs 11 m"):
        segment_measures(profile, edges_of(profile, None))
