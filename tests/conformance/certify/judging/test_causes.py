"""A run that does not agree has its causes named, and what they explain comes back undone."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.measures import high_pass
from floatref.values.profile import Profile, ProfileTrack
from floatref_conformance.certify.fitting.fit import fit
from floatref_conformance.certify.judging.causes import causes
from floatref_conformance.certify.judging.limits import CertificationLimits
from floatref_conformance.proving_ground.roads.random_roads import sayers_road
from floatref_conformance.proving_ground.roads.strips import along_line
from floatref_conformance.proving_ground.roads.wander import Line

STRICT = CertificationLimits(repeatability=0.98, accuracy=0.98)


def causes_by_id(reference, run, limits=None):
    found = causes(reference, run, "left", fit(reference, run, "left"), limits)
    return {cause.id: cause for cause in found}


def test_a_good_run_has_no_cause(road) -> None:
    for seed in range(5):
        assert causes_by_id(road.reference(), road.run(noise=0.08, seed=seed)) == {}


@pytest.mark.slow
@settings(max_examples=10, deadline=None)
@given(percent=st.floats(0.5, 5.0), sign=st.sampled_from([-1, 1]))
def test_an_error_of_distance_is_named_and_explains_what_is_lost(road, percent, sign) -> None:
    run = road.run(scale=1.0 + sign * percent / 100.0, noise=0.05)
    found = causes_by_id(road.reference(), run)
    assert set(found) == {"distance"}
    assert found["distance"].text.endswith("too long" if sign > 0 else "too short")
    assert found["distance"].explains > 0.8


@pytest.mark.slow
@settings(max_examples=10, deadline=None)
@given(percent=st.floats(2.5, 10.0), sign=st.sampled_from([-1, 1]))
def test_a_scale_of_heights_is_named_and_explains_what_is_lost(road, percent, sign) -> None:
    run = road.run(gain=1.0 + sign * percent / 100.0, noise=0.05)
    found = causes_by_id(road.reference(), run)
    assert set(found) == {"height-scale"}
    assert found["height-scale"].text.endswith("too high" if sign > 0 else "too low")
    assert found["height-scale"].explains > 0.7


def test_a_limit_of_nothing_is_a_limit_and_no_limit_is_the_usual_one(road) -> None:
    run = road.run(scale=1.0005, gain=1.005, noise=0.02)
    nothing = CertificationLimits(distance_percent=0.0, height_percent=0.0)
    assert set(causes_by_id(road.reference(), run, nothing)) == {"distance", "height-scale"}
    none = CertificationLimits(distance_percent=None, height_percent=None)
    assert causes_by_id(road.reference(), run, none) == causes_by_id(road.reference(), run) == {}


def test_two_causes_are_told_apart(road) -> None:
    found = causes_by_id(road.reference(), road.run(scale=1.01, gain=1.03, noise=0.1))
    assert set(found) == {"distance", "height-scale"}
    assert found["distance"].text == "distance 1.00 % too long"
    assert found["distance"].explains > found["height-scale"].explains > 0.0
    assert sum(cause.explains for cause in found.values()) == pytest.approx(1.0, abs=0.05)


def test_noise_is_what_is_left(road) -> None:
    found = causes_by_id(road.reference(), road.run(noise=0.6))
    assert next(iter(found)) == "noise"
    assert found["noise"].explains > 0.9


def test_an_offset_beyond_the_search_is_named(road) -> None:
    found = causes_by_id(road.reference(), road.run(-2.5, 165.0))
    assert set(found) == {"offset"}
    assert found["offset"].text == "2.50 m farther along"
    assert found["offset"].explains > 0.95


def test_heights_upside_down_are_named(road, changed) -> None:
    found = causes_by_id(road.reference(), changed(road.run(), lambda name, z: (name, -z)))
    assert set(found) == {"inverted"}
    assert found["inverted"].explains == pytest.approx(1.0, abs=0.02)


def test_another_road_is_named(road, roads) -> None:
    assert list(causes_by_id(road.reference(), roads(41).run())) == ["not-this-road"]


@pytest.mark.parametrize("flagged", [True, False])
def test_a_stretch_that_is_missing_is_named_with_its_length(road, flagged) -> None:
    run = road.run()
    z = run.track("left").elevation.copy()
    valid = np.ones(z.size, bool)
    valid[1000:1500] = False
    z[1000:1500] = z[1000:1500] * -3.0 if flagged else np.nan
    spoilt = replace(run, tracks=(ProfileTrack.of("left", z, valid),))
    found = causes_by_id(road.reference(), spoilt)
    assert found["missing"].text == "20.0 m of 160.9 m missing or not valid"
    assert found["missing"].explains > 0.8
    assert "height-scale" not in found


def test_flags_that_explain_nothing_are_not_blamed(road) -> None:
    run = road.run(gain=1.05, noise=0.05)
    valid = np.arange(run.tracks[0].elevation.size) >= 1000
    flagged = replace(run, tracks=(ProfileTrack.of("left", run.track("left").elevation, valid),))
    assert set(causes_by_id(road.reference(), flagged)) == {"height-scale"}


def test_short_waves_that_a_footprint_takes_are_not_blamed_on_the_heights(road, changed) -> None:
    def averaged(name, z):
        padded = np.pad(z, 6, mode="reflect", reflect_type="odd")
        return name, np.convolve(padded, np.ones(13) / 13.0, "same")[6:-6]

    run = changed(road.run(), averaged)
    found = causes_by_id(road.reference(), run, STRICT)
    assert set(found) == {"short-waves"}
    assert found["short-waves"].explains > 0.5


@pytest.mark.slow
def test_another_line_on_the_road_is_told_from_noise() -> None:
    road = sayers_road("normal", 800.0, seed=4)
    beside = along_line(road, Line(4, 0.25, 0.03), 4)
    at = np.arange(60.0, 700.0, 0.025)
    reference, run = (
        Profile(0.025, (ProfileTrack.of("left", r.at("left", at)),), 60.0) for r in (road, beside)
    )
    assert next(iter(causes_by_id(reference, run, STRICT))) == "wander"


def test_a_run_whose_body_moves_has_a_skew(road, changed) -> None:
    def late(name, z):
        # The body of a car at 11 m/s that swings at 1.4 Hz, 10 ms later than the road.
        s = 2j * np.pi * 11.0 * np.fft.rfftfreq(z.size, 0.04) / 8.8
        body = (1.0 + 0.3 * s) / (1.0 + 0.3 * s + s**2)
        ramp = np.linspace(z[0], z[-1], z.size)
        waves = np.fft.rfft(z - ramp) * (1.0 + body * np.expm1(8.8 * 0.01 * s))
        return name, np.fft.irfft(waves, z.size) + ramp

    assert "skew" in causes_by_id(road.reference(), changed(road.run(), late))


def test_long_waves_that_a_filter_takes_are_named(road, changed) -> None:
    run = road.run()
    cut = changed(run, lambda name, z: (name, high_pass(z, run.interval_m, 12.0)))
    assert "long-waves" in causes_by_id(road.reference(), cut)
