"""Scales of distance and of heights come from the section alone, and so does their scatter."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref.values.profile import ProfileTrack
from floatref_conformance.certify.fitting.fit import fit


@pytest.mark.slow
@settings(max_examples=15, deadline=None)
@given(
    percent=st.floats(-5.0, 5.0),
    gain=st.floats(0.9, 1.1),
    interval_m=st.sampled_from([0.005, 0.0254, 0.1]),
    start_m=st.floats(-0.9, 0.0),
)
def test_scales_of_a_run_without_noise_are_recovered(
    road, percent, gain, interval_m, start_m
) -> None:
    scale = 1.0 + percent / 100.0
    run = road.run(start_m, 163.0, interval_m, scale, gain)
    found = fit(road.reference(), run, "left")
    assert found.distance_percent == pytest.approx(percent, abs=0.002)
    assert found.height_percent == pytest.approx(100.0 * (gain - 1.0), abs=0.2)
    assert found.offset_m == pytest.approx(-start_m * scale, abs=0.005)
    assert not found.inverted


@pytest.mark.slow
def test_an_error_of_distance_of_a_twentieth_of_a_percent_is_resolved(road) -> None:
    for seed in range(10):
        run = road.run(scale=1.0005, noise=0.2, seed=seed)
        found = fit(road.reference(), run, "left")
        assert found.distance_percent == pytest.approx(0.05, abs=0.015)
        assert found.distance_sigma < 0.005


@pytest.mark.slow
def test_sigma_covers_the_truth_as_often_as_it_says(roads) -> None:
    distances, heights = [], []
    for seed in range(40):
        road = roads(200 + seed, 240.0)
        # How noise divides between the two is not known: any share is as likely as any other.
        mine = np.random.default_rng(seed).uniform()
        run = road.run(scale=1.002, gain=1.03, noise=0.25 * np.sqrt(mine), seed=seed)
        reference = road.run(0.0, noise=0.25 * np.sqrt(1.0 - mine), seed=1000 + seed)
        found = fit(reference, run, "right")
        distances.append((found.distance_percent - 0.2) / found.distance_sigma)
        heights.append((found.height_percent - 3.0) / found.height_sigma)
        assert found.height_sigma < 4.0
    for errors in (np.abs(distances), np.abs(heights)):
        # Of 40 at 68 and 95 percent; three standard deviations of such a count are left.
        assert 18 <= np.count_nonzero(errors < 1.0) <= 36
        assert np.count_nonzero(errors < 2.0) >= 32
        assert errors.max() < 5.0


@pytest.mark.parametrize("whose", ["run", "reference"])
@pytest.mark.parametrize("footprint_m", [0.1, 0.25])
def test_a_footprint_is_no_scale_of_heights(road, changed, whose, footprint_m) -> None:
    points = round(footprint_m / 0.01)
    window = np.hanning(points + 2) if footprint_m < 0.2 else np.ones(points)

    def averaged(name, z):
        padded = np.pad(z, (points, points), mode="reflect", reflect_type="odd")
        return name, np.convolve(padded, window / window.sum(), "same")[points:-points]

    pair = {"reference": road.reference(0.01), "run": road.run(interval_m=0.01, gain=1.03)}
    pair[whose] = changed(pair[whose], averaged)
    found = fit(pair["reference"], pair["run"], "left")
    assert found.height_percent == pytest.approx(3.0, abs=0.05)
    assert np.sign(found.smoothing_m2) == (-1.0 if whose == "run" else 1.0)


@pytest.mark.parametrize("wrong", ["artefact", "gaps and flags"])
def test_what_is_wrong_in_places_does_not_set_the_scales(road, wrong) -> None:
    run = road.run(scale=1.003, gain=1.03)
    z = run.track("left").elevation.copy()
    valid = np.ones(z.size, bool)
    if wrong == "artefact":
        z[1500:1700] += 0.05 * np.hanning(200)
    else:
        z[1000:1300] = np.nan
        z[2000:2500] *= -1.0
        valid[2000:2500] = False
    spoilt = replace(run, tracks=(ProfileTrack.of("left", z, valid),))
    found = fit(road.reference(), spoilt, "left")
    assert found.distance_percent == pytest.approx(0.3, abs=0.005)
    assert found.height_percent == pytest.approx(3.0, abs=0.5)


def test_scales_along_kilometres_are_followed(roads) -> None:
    road = roads(5, 2200.0)
    run = road.run(0.0, 2001.0, scale=0.98, gain=0.97, noise=0.2)
    found = fit(road.run(0.0, 2000.0, noise=0.2, seed=1), run, "left")
    assert found.distance_percent == pytest.approx(-2.0, abs=0.001)
    assert found.height_percent == pytest.approx(-3.0, abs=1.5)
    assert found.lag_m == pytest.approx(-0.02 * found.at_m, abs=0.1)


def test_heights_upside_down_are_told(road, changed) -> None:
    run = changed(road.run(gain=1.03), lambda name, z: (name, -z))
    found = fit(road.reference(), run, "left")
    assert found.inverted
    assert found.height_percent == pytest.approx(3.0, abs=0.2)


def test_another_road_has_no_scale(road, roads) -> None:
    found = fit(road.reference(), roads(31).run(), "left")
    assert not found.found
    assert np.isnan([found.distance_percent, found.height_percent, found.offset_m]).all()


def test_what_covers_too_little_has_no_scale(road) -> None:
    found = fit(road.reference(), road.run(0.0, 30.0), "left")
    assert np.isnan([found.distance_percent, found.height_percent]).all()


def test_a_wheel_path_that_is_not_there_is_refused(road) -> None:
    with pytest.raises(InputError, match="track middle"):
        fit(road.reference(), road.run(), "middle")


def test_a_run_that_was_not_put_on_the_section_is_not_laid_on_it(road) -> None:
    assert fit(road.reference(), road.run(-10.0, 250.0), "left").found
    assert not fit(road.reference(), road.run(-30.0, 250.0), "left").found
