"""Rows: their derivatives, where they are 0, and what each reading does to them."""

from dataclasses import replace
from typing import Any

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st
from tests.sdk.estimators.road_slope.short_runs import MODEL, RUNS, Case, Run, draw

from floatref.estimators.road_slope.constants import Places, SlopeModel
from floatref.estimators.road_slope.layout import GLOBALS
from floatref.estimators.road_slope.readings import Readings
from floatref.estimators.road_slope.rows import Stretch
from floatref.values.arrays import FloatArray
from floatref_reference.road_slope.unknowns import as_vector

SEEDS = st.integers(0, 2**32 - 1)
few = settings(deadline=None, max_examples=8)
K, STEP = 30, 0.06
SURE = replace(MODEL, force_share=0.0)
"""All of a force is sure, so that it changes no 1-σ."""


def held(case: Case) -> FloatArray:
    return np.full(case.ours.layout.points - 1, 1e-5)


def reread(stretch: Stretch, **changed: Any) -> Stretch:
    """Return the stretch with other readings."""
    return Stretch(replace(stretch.readings, **changed), stretch.places, stretch.model)


@few
@given(run=RUNS, seed=SEEDS)
def test_derivatives_are_central_differences_of_the_misfits(run: Run, seed: int) -> None:
    """In a direction in which every unknown changes; they are next to parabolas."""
    case, rng = draw(run), np.random.default_rng(seed)
    y, g = as_vector(case.truth), held(case)
    way = rng.normal(size=y.size)
    found = case.ours.rows(y, g).derivative @ way
    step = 1e-5
    above, below = (case.ours.rows(y + sign * step * way, g).misfit for sign in (1, -1))
    size = abs(case.ours.rows(y, g).derivative) @ np.abs(way)
    np.testing.assert_allclose(found / size, (below - above) / (2 * step) / size, atol=1e-6)


@few
@given(run=RUNS)
def test_the_sum_of_squares_is_that_of_the_rows(run: Run) -> None:
    case = draw(run)
    y, g = as_vector(case.truth), held(case)
    rows = case.ours.rows(y, g)
    assert rows.derivative.shape == (rows.misfit.size, y.size)
    np.testing.assert_allclose(case.ours.misfit(y, g), np.sum(rows.misfit**2))


@few
@given(run=RUNS)
def test_the_true_unknowns_leave_what_noise_leaves(run: Run) -> None:
    """Of the rows of readings: heights, and behind all that are fixed, accelerations on."""
    case = draw(run)
    misfit = case.ours.rows(as_vector(case.truth), held(case)).misfit
    fixed = case.ours.fixed_sigma.size
    heights = int(np.sum(~np.isnan(case.literal.readings.height)))
    assert np.abs(misfit[:heights]).max() < 6
    assert np.abs(misfit[fixed:]).max() < 6
    assert 0.4 < np.std(misfit[fixed:]) < 1.6


@few
@given(run=RUNS, factor=st.floats(0.1, 10.0))
def test_intensities_scale_the_steps_of_the_slope_alone(run: Run, factor: float) -> None:
    case = draw(run)
    y, g = as_vector(case.truth), held(case)
    first, second = (case.ours.rows(y, each).misfit for each in (g, factor**2 * g))
    steps = np.diff(y[case.ours.layout.slope])
    spacing = case.ours.model.spacing_m
    rise = np.sum(steps**2 / (g * spacing)) * (1 - factor**-2)
    np.testing.assert_allclose(np.sum(first**2) - np.sum(second**2), rise, atol=1e-6)
    changed = np.flatnonzero(first != second)
    assert changed.size <= g.size


@few
@given(run=RUNS, k=st.integers(0, 11))
def test_a_height_and_a_force_change_the_rows_that_they_are_in(run: Run, k: int) -> None:
    """By as many 1-σ; the force of a node that lacks a side is in no row."""
    case = draw(run._replace(unread=0.0, missing=0.0), SURE)
    y, g, seen, model = as_vector(case.truth), held(case), case.ours.readings, case.ours.model
    at_k, misfit = 1e-3 * (np.arange(run.nodes) == k), case.ours.rows(y, g).misfit
    higher = reread(case.ours, height=seen.height + at_k).rows(y, g).misfit - misfit
    between = model.road * min(seen.speed[k] * seen.interval_s, model.spacing_m) / 3
    expected = 1e-3 / np.sqrt(model.reading_m**2 + between)
    np.testing.assert_allclose(np.sort(higher)[[-1, 0, -2]], [expected, 0, 0], atol=1e-9)
    forced = reread(case.ours, force=seen.force + at_k).rows(y, g).misfit - misfit
    expected = 1e-3 / (model.acceleration / np.sqrt(seen.interval_s)) if k in seen.middles else 0.0
    np.testing.assert_allclose(np.sort(forced)[[-1, 0, -2]], [expected, 0, 0], atol=1e-7)


@few
@given(run=RUNS, lost=st.sets(st.integers(0, 11), min_size=1))
def test_a_height_that_is_not_read_has_no_row(run: Run, lost: set[int]) -> None:
    case = draw(run._replace(unread=0.0))
    y, g, height = as_vector(case.truth), held(case), case.ours.readings.height.copy()
    before = case.ours.rows(y, g).misfit
    height[list(lost)] = np.nan
    after = reread(case.ours, height=height).rows(y, g).misfit
    kept = np.setdiff1d(np.arange(before.size), list(lost))
    np.testing.assert_array_equal(after, before[kept])


@few
@given(run=RUNS, k=st.integers(1, 10), share=st.floats(0.1, 1.0))
def test_missing_samples_loosen_the_accelerations_that_have_them(
    run: Run, k: int, share: float
) -> None:
    case = draw(run._replace(missing=0.0), SURE)
    y, g, model = as_vector(case.truth), held(case), case.ours.model
    before = case.ours.rows(y, g).misfit
    after = reread(case.ours, missing=share * (np.arange(run.nodes) == k)).rows(y, g).misfit
    rows = case.ours.fixed_sigma.size + np.flatnonzero(np.abs(case.ours.middles - k) <= 1)
    variance = (1 - share) * model.acceleration**2 + share * model.missing_acceleration**2
    expected = before.copy()
    expected[rows] *= model.acceleration / np.sqrt(variance)
    np.testing.assert_allclose(after, expected, rtol=1e-12)


@few
@given(run=RUNS, share=st.floats(0.001, 0.1))
def test_a_part_of_the_force_is_not_sure(run: Run, share: float) -> None:
    case = draw(run._replace(missing=0.0), SURE)
    y, g, model, seen = as_vector(case.truth), held(case), case.ours.model, case.ours.readings
    unsure = Stretch(seen, case.ours.places, replace(model, force_share=share))
    expected = case.ours.rows(y, g).misfit
    sigma = model.acceleration / np.sqrt(seen.interval_s)
    at, middles = case.ours.fixed_sigma.size, case.ours.middles
    rows = slice(at, at + middles.size)
    expected[rows] *= sigma / np.hypot(sigma, share * seen.force[middles])
    np.testing.assert_allclose(unsure.rows(y, g).misfit, expected, rtol=1e-12)


@settings(deadline=None, max_examples=25)
@given(
    slope=st.floats(-0.1, 0.1),
    along=st.floats(-3.0, 3.0),
    gain=st.floats(0.001, 0.02),
    lean=st.floats(-0.03, 0.03),
    centre=st.floats(-0.1, 1.1),
    lever=st.floats(-1.5, 1.5),
)
def test_a_steady_brake_on_a_straight_slope_leaves_nothing(
    slope: float, along: float, gain: float, lean: float, centre: float, lever: float
) -> None:
    """θ is β, and κ of the specific force more; the body moves as the line through its axles."""
    t, places, g = STEP * np.arange(float(K)), Places(-0.8, -3.5, lever), 9.80665
    x = 7.0 * t + along / 2 * t**2
    pitch = slope + gain * (along + g * slope)
    ahead = -lever - (places.front_m - centre * places.wheelbase_m)
    r = slope * (x - lever) + ahead * (pitch - slope) + 0.2
    leaning = pitch + lean
    force = slope * along - along * leaning - g / 2 * leaning**2 + 0.01
    height = r + lever * pitch - slope * x
    full, zero = np.ones(K), np.zeros(K)
    seen = Readings(
        t, height, force * full, x, 7.0 + along * t, along * full, zero, STEP * full, STEP
    )
    stretch = Stretch(seen, places, SlopeModel(gravity=g))
    y, lay = stretch.start(), stretch.layout
    y[lay.elevation] = slope * (stretch.first_m + stretch.model.spacing_m * np.arange(lay.points))
    y[lay.slope], y[lay.height], y[lay.pitch], y[lay.bias] = slope, r, pitch, 0.01
    for name, value in zip(GLOBALS[:4], (gain, lean, centre, 0.2), strict=True):
        y[lay.place(name)] = value
    misfit = stretch.rows(y, np.full(lay.points - 1, 1e-7)).misfit
    np.testing.assert_allclose(misfit[stretch.fixed_sigma.size :], 0.0, atol=1e-6)
    expected_priors_and_mean_slopes = 6 + lay.points
    assert np.sum(np.abs(misfit) > 1e-6) <= expected_priors_and_mean_slopes
