"""The answer of a stretch: least squares, near the truth, and as sure as its covariance says."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from tests.sdk.estimators.road_slope.short_runs import (
    MODEL,
    RUNS,
    Case,
    Run,
    as_ours,
    draw,
    in_motion,
    read,
    true_unknowns,
    unread,
)

from floatref.estimators.road_slope.constants import SlopeModel
from floatref.estimators.road_slope.gauss_newton import RANGES, SETTLED_RAD, Fit, fit
from floatref.estimators.road_slope.rows import Stretch
from floatref.values.arrays import FloatArray
from floatref_reference.road_slope.wheels import road_points

few = settings(deadline=None, max_examples=6)
SEEDS = (0, *range(2, 9))
FIXED = [Run(k, 12 + k, k % 2 == 0, 0.1 * (k % 3), 0.1 * (k % 4), k > 2) for k in SEEDS]
"""Their answers have no constant at an end of its range, as that of seed 1 has; and of some hundred
runs so short one has a constant far from the drawn one."""
ONE_BEND = replace(MODEL, bends=6e-6, first_bend=1.0, most_bend=1.0)
"""The intensity is that with which roads are drawn, and is not sought."""


def plain(run: Run) -> Case:
    return draw(run._replace(bend=1.0), ONE_BEND)


def moved(stretch: Stretch, **changed: Any) -> Stretch:
    return Stretch(replace(stretch.readings, **changed), stretch.places, stretch.model)


def settled(stretch: Stretch) -> Fit:
    """Return the fit, of a stretch that settles."""
    found = fit(stretch)
    assume(found.changed_rad < SETTLED_RAD)
    return found


def deviations(found: Fit) -> FloatArray:
    covariance = found.covariance(np.eye(found.stretch.layout.size))
    return np.asarray(np.sqrt(np.diag(covariance)))


@few
@given(run=RUNS)
def test_twelve_passes_make_it_no_worse_than_they_may(run: Run) -> None:
    """Each by a thousandth and 1, of the sum of squares."""
    case = plain(run)
    found = fit(case.ours)
    least, first = (case.ours.misfit(y, found.bends) for y in (found.unknowns, case.ours.start()))
    assert least <= 1.001**12 * first + 12.1


@few
@given(run=RUNS)
def test_constants_stay_in_their_ranges(run: Run) -> None:
    found = fit(draw(run, replace(MODEL, gain=0.03, hz=4.0, damping=0.02, centre=1.5)).ours)
    for name, (low, high) in RANGES.items():
        assert low <= found.of(name) <= high
    assert 4 <= found.passes <= 12
    assert found.bends.min() >= MODEL.bends
    assert found.bends.max() <= MODEL.most_bend * MODEL.bends


@few
@given(run=RUNS, by_m=st.floats(-2000.0, 2000.0))
def test_where_distance_counts_from_changes_nothing(run: Run, by_m: float) -> None:
    """Points are laid from the first place that is needed."""
    case = plain(run)
    found = settled(case.ours)
    shifted = fit(moved(case.ours, place=case.ours.readings.place + by_m))
    assume(shifted.stretch.layout == found.stretch.layout)
    off = (shifted.unknowns - found.unknowns) / deviations(found)
    assert np.abs(off).max() < 1e-3


@few
@given(run=RUNS, by_m=st.floats(-0.02, 0.02))
def test_a_sensor_mounted_higher_is_a_body_higher_at_rest(run: Run, by_m: float) -> None:
    """The pitch stays, but for what the first knowledge of the height at rest has of it."""
    case = plain(run)
    case = case._replace(
        ours=Stretch(case.ours.readings, case.ours.places, replace(ONE_BEND, offset_m=1.0))
    )
    found = settled(case.ours)
    higher = fit(moved(case.ours, height=case.ours.readings.height + by_m))
    sigma = deviations(found)
    pitch, offset = case.ours.layout.pitch, case.ours.layout.place("offset")
    assert np.abs((higher.unknowns - found.unknowns)[pitch] / sigma[pitch]).max() < 0.02
    rise = higher.of("offset") - found.of("offset")
    assert abs(rise - by_m) < 0.05 * sigma[offset]


@few
@given(run=RUNS)
def test_the_covariance_is_the_inverse_of_the_normal_matrix(run: Run) -> None:
    """By the singular values of the derivatives, over their sizes."""
    found = fit(draw(run).ours)
    J = found.stretch.rows(found.unknowns, found.bends).derivative.toarray()
    size = np.linalg.norm(J, axis=0)
    root = np.linalg.pinv(J / size, rcond=1e-14) / size[:, np.newaxis]
    expected = root @ root.T
    sigma = np.sqrt(np.diag(expected))
    got = found.covariance(np.diag(1 / sigma))
    np.testing.assert_allclose(got, expected / np.outer(sigma, sigma), atol=2e-3)


@few
@given(run=RUNS, level_m=st.sampled_from([0.2, 1.0, 5.0]), share=st.floats(0.0, 1.0))
def test_how_well_the_level_is_known_changes_no_high_passed_sigma(
    run: Run, level_m: float, share: float
) -> None:
    """The weights of the high-pass have the sum 0, in the stretch and on the lines beyond."""
    found = fit(draw(run).ours)
    looser = Stretch(found.stretch.readings, found.stretch.places, replace(MODEL, start_m=level_m))
    length = MODEL.spacing_m * (found.stretch.layout.points - 1)
    marks = found.stretch.first_m + np.array([0.0, share * length, length])
    before = found.elevation_sigma(marks, 12.0)
    after = found._replace(stretch=looser).elevation_sigma(marks, 12.0)
    np.testing.assert_allclose(after, before, rtol=1e-2)


@few
@given(run=RUNS)
def test_a_short_wave_is_known_better_than_a_long_one(run: Run) -> None:
    found = fit(draw(run).ours)
    middle = found.stretch.first_m + MODEL.spacing_m * found.stretch.layout.points / 2
    marks = np.array([middle])
    short, long = (float(found.elevation_sigma(marks, each)[0]) for each in (3.0, 60.0))
    assert 0.0 < short < long


@few
@given(run=RUNS, factor=st.floats(1.5, 4.0))
def test_worse_readings_leave_all_less_sure(run: Run, factor: float) -> None:
    found = fit(draw(run).ours)
    model = replace(MODEL, reading_m=factor * MODEL.reading_m, swing=factor * MODEL.swing)
    worse = Stretch(found.stretch.readings, found.stretch.places, model)
    assert np.all(deviations(found._replace(stretch=worse)) > deviations(found) * (1 - 1e-3))


def over_hump(seed: int) -> Case:
    """Return a brake with a hump of 12 cm under the stop, all read by the reference's equations."""
    model, run = SlopeModel(spacing_m=0.5), Run(seed, nodes=60)
    rng = np.random.default_rng(seed)
    stretch = unread(run, rng, model)
    truth = true_unknowns(run, rng, stretch)
    x = road_points(stretch).first + 0.5 * np.arange(len(truth.slope))
    hump = 0.12 * np.exp(-(((x - stretch.readings.place.max() + 1.5) / 2.5) ** 2))
    truth = in_motion(truth._replace(elevation=hump, slope=np.gradient(hump, 0.5)), rng, stretch)
    return Case(as_ours(read(run, rng, truth, stretch), model), stretch, truth)


@pytest.mark.parametrize("seed", range(5))
def test_the_pitch_of_a_stop_on_a_hump_is_found_with_the_usual_constants(seed: int) -> None:
    """To a fifth of what it does, but for a constant, which is the lean's."""
    case = over_hump(seed)
    found = fit(case.ours)
    pitch = found.unknowns[case.ours.layout.pitch]
    sigma = deviations(found)[case.ours.layout.pitch]
    assert np.abs((pitch - case.truth.pitch) / sigma).max() < 6
    assert np.std(pitch - case.truth.pitch) < 0.2 * np.std(case.truth.pitch)
