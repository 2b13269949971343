"""Recorded stationary tests: what counts, what is held against which limit, what is refused."""

from pathlib import Path

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref.measures import iri
from floatref.values.profile import Profile, ProfileTrack
from floatref_conformance.certify.judging.contents import Judged
from floatref_conformance.certify.judging.limits import CertificationLimits
from floatref_conformance.certify.judging.stationary import stationary_sheet
from floatref_conformance.certify.plan.plan_document import StationaryPlan
from floatref_conformance.checks.stretches import END_M

INTERVAL = 0.05
LIMITS = CertificationLimits()


def parked(length_m=400.0, left=1e-6, right=1e-6, start_m=0.0, missing=slice(0), doubted=slice(0)):
    """A profile of white noise, in m; nothing in ``missing``, flags in ``doubted``."""
    draw = np.random.default_rng(5)
    count = round(length_m / INTERVAL) + 1
    tracks = []
    for name, noise in (("left", left), ("right", right)):
        elevation = noise * draw.standard_normal(count)
        elevation[missing] = np.nan
        valid = np.isfinite(elevation)
        valid[doubted] = False
        tracks.append(ProfileTrack.of(name, elevation, valid))
    return Profile(INTERVAL, tuple(tracks), start_m)


def sheet(profile, id_="quiescent", stretch_m=None, limits=LIMITS, **more):
    return stationary_sheet(id_, StationaryPlan(Path("parked"), stretch_m), profile, limits, **more)


def missing(profile, **more):
    """Return why nothing was judged."""
    (criterion,) = sheet(profile, **more).criteria
    assert criterion.judged is Judged.MISSING
    assert np.isnan(criterion.value)
    return criterion.reason


def test_by_default_all_counts_but_the_run_in_of_the_filters_at_both_ends():
    profile = parked(start_m=30.0)
    found = sheet(profile)
    first = round(END_M / INTERVAL)
    assert (found.start_m, found.end_m) == pytest.approx((30.0 + END_M, 430.0 - END_M))
    for track in profile.tracks:
        part = track.elevation[first : track.elevation.size - first]
        assert found.iri_m_per_km[track.name] == iri(part, INTERVAL)


@pytest.mark.slow
@settings(deadline=None)
@given(st.floats(0.0, 300.0), st.floats(60.0, 100.0))
def test_a_stretch_counts_from_its_first_to_its_last_point(start, length):
    profile = parked()
    # Next to a point, rounding decides whether it is inside.
    for end in (start, start + length):
        assume(end == 0.0 or abs(end / INTERVAL - round(end / INTERVAL)) > 1e-6)
    found = sheet(profile, stretch_m=(start, start + length))
    places = profile.distance_m
    inside = (places >= start - 1e-9) & (places <= start + length + 1e-9)
    assert found.iri_m_per_km["left"] == iri(profile.tracks[0].elevation[inside], INTERVAL)


@pytest.mark.parametrize(("id_", "limit"), [("quiescent", 0.047), ("bounce", 0.126)])
def test_every_wheel_path_is_held_to_the_limit_of_its_test(id_, limit):
    unit = sheet(parked(left=1e-6), id_).iri_m_per_km["left"] / 1e-6
    good, bad = 0.99 * limit / unit, 1.01 * limit / unit
    found = {c.track: c for c in sheet(parked(left=bad, right=1e-7), id_).criteria}
    assert (found["left"].judged, found["right"].judged) == (Judged.FAIL, Judged.PASS)
    assert (found["left"].limit, found["left"].at_least) == (limit, False)
    passed = {c.track: c.judged for c in sheet(parked(left=good), id_).criteria}
    assert passed["left"] is Judged.PASS


def test_the_limits_are_those_that_are_given():
    strict = CertificationLimits(quiescent_m_per_km=1e-9)
    assert {c.judged for c in sheet(parked(), limits=strict).criteria} == {Judged.FAIL}
    assert {c.judged for c in sheet(parked(), "bounce", limits=strict).criteria} == {Judged.PASS}


def test_a_vehicle_whose_encoder_stands_still_is_told_what_it_needs():
    assert "a parked vehicle needs an encoder that gives travel" in missing(parked(0.3))


def test_a_run_that_is_too_short_is_told_what_would_do():
    reason = missing(parked(200.0))
    assert "0.0 m count, 50 m are needed" in reason
    assert "record longer, or give the stretch" in reason
    assert "give a longer stretch" in missing(parked(), stretch_m=(100.0, 120.0))


def test_a_stretch_beyond_the_profile_is_not_judged():
    assert "reaches beyond the profile, which covers 0 to 400 m" in missing(
        parked(), stretch_m=(300.0, 420.0)
    )


def test_a_point_without_elevation_is_not_bridged_where_it_counts():
    reason = missing(parked(missing=slice(4000, 4003)))
    assert "track left: 3 of 3761 points" in reason
    assert len(sheet(parked(missing=slice(0, 100))).criteria) == 2


def test_what_is_flagged_counts_and_is_told():
    found = sheet(parked(doubted=slice(4000, 4040)))
    assert found.notes == tuple(
        f"track {name} flags 2.0 m of what counts as not valid" for name in ("left", "right")
    )
    assert {c.judged for c in found.criteria} == {Judged.PASS}


def test_a_recording_that_made_no_profile_says_why():
    found = sheet(None, error="distance: does not advance", notes=("read as TDMS",))
    assert found.criteria[0].reason == "distance: does not advance"
    assert (found.notes, found.iri_m_per_km, found.profile) == (("read as TDMS",), {}, None)


@pytest.mark.parametrize("stretch", [(100.0, 50.0), (np.nan, 5.0), (0.0, np.inf)])
def test_a_stretch_that_is_none_is_refused(stretch):
    with pytest.raises(InputError, match="give FROM:TO in m"):
        sheet(parked(), stretch_m=stretch)
