"""Rows: their derivatives, what a pass holds of them, and what is known before the readings."""

from dataclasses import replace

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st
from tests.sdk.estimators.road_slope.plain_equations import spring_sigmas
from tests.sdk.estimators.road_slope.short_runs import (
    RUNS,
    STEP,
    Run,
    at_speed,
    draw,
    groups,
    held,
)

from floatref.estimators.road_slope.rows import Stretch

SEEDS = st.integers(0, 2**32 - 1)
few = settings(deadline=None, max_examples=4)


@few
@given(run=RUNS, seed=SEEDS)
def test_derivatives_are_central_differences_of_the_misfits(run: Run, seed: int) -> None:
    """In a direction in which every unknown changes; they are next to parabolas."""
    case, rng = draw(run), np.random.default_rng(seed)
    y, g = case.truth, held(case)
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
    rows = case.ours.rows(case.truth, held(case))
    assert rows.derivative.shape == (rows.misfit.size, case.truth.size)
    np.testing.assert_allclose(case.ours.misfit(case.truth, held(case)), np.sum(rows.misfit**2))


@few
@given(run=RUNS)
def test_the_true_unknowns_leave_what_noise_leaves(run: Run) -> None:
    """Each group of rows alone has misfits of the 1-σ of 1."""
    case = draw(run)
    misfit = case.ours.rows(case.truth, held(case)).misfit
    where = groups(case.ours)
    assert where["pitch"].stop == misfit.size
    for name in ("height", "acceleration", "bounce", "pitch"):
        assert np.abs(misfit[where[name]]).max(initial=0.0) < 6
    assert 0.4 < np.std(misfit[where["height"].start :]) < 1.6


@few
@given(run=RUNS, factor=st.floats(0.1, 10.0))
def test_intensities_scale_the_steps_of_the_slope_alone(run: Run, factor: float) -> None:
    case, g = draw(run), 1e-5
    usual = held(case)
    first, second = (
        case.ours.rows(case.truth, usual._replace(bends=each * usual.bends)).misfit
        for each in (1.0, factor**2)
    )
    steps = np.diff(case.truth[case.ours.layout.slope])
    rise = np.sum(steps**2 / (g * case.ours.model.spacing_m)) * (1 - factor**-2)
    np.testing.assert_allclose(np.sum(first**2) - np.sum(second**2), rise, rtol=1e-6, atol=1e-6)
    assert np.flatnonzero(first != second).size <= usual.bends.size


@few
@given(run=RUNS, loose=st.floats(1.0, 30.0))
def test_looser_springs_are_looser_in_bounce_and_pitch_alone(run: Run, loose: float) -> None:
    case = draw(run)
    usual = held(case)
    sure, unsure = (
        case.ours.rows(case.truth, usual._replace(loose=each)).misfit for each in (1.0, loose)
    )
    springs = groups(case.ours)["bounce"].start
    np.testing.assert_array_equal(sure[:springs], unsure[:springs])
    np.testing.assert_allclose(sure[springs:], loose * unsure[springs:], rtol=1e-12)


@few
@given(run=RUNS, size=st.floats(0.001, 0.1))
def test_the_moment_may_step_where_the_slope_under_the_wheels_turns(run: Run, size: float) -> None:
    """By a third of gravity times that, and by its walk everywhere."""
    case = draw(run)
    usual, model, where = held(case), case.ours.model, groups(case.ours)["moment"]
    found = [
        case.ours.rows(case.truth, usual._replace(turned=np.full(case.ours.layout.nodes - 1, each)))
        for each in (0.0, size)
    ]
    walked, turned = (rows.misfit[where] for rows in found)
    steps = -np.diff(case.truth[case.ours.layout.in_time("moment")])
    root = np.sqrt(case.ours.readings.pause_s[1:])
    np.testing.assert_allclose(walked * model.moment_walk * root, steps, atol=1e-12)
    more = np.hypot(model.moment_walk * root, 0.3 * 9.80665 * size)
    np.testing.assert_allclose(turned * more, steps, atol=1e-12)


@few
@given(run=RUNS, size_m=st.floats(0.001, 0.05))
def test_a_body_that_stands_may_sag_at_the_cost_of_two_sigma(run: Run, size_m: float) -> None:
    """Where somebody boards; a body in motion may not."""
    case = draw(run._replace(cut=True))
    lay, model, where = case.ours.layout, case.ours.model, groups(case.ours)["offset"]
    y, rested = case.truth.copy(), case.ours.rested
    y[lay.in_time("offset")] = 0.0
    bends = held(case).bends
    for k in range(1, lay.nodes):
        y[lay.in_time("offset")] = size_m * (np.arange(lay.nodes) >= k)
        misfit = case.ours.rows(y, case.ours.weights(y, bends)).misfit[where]
        assert np.flatnonzero(misfit).tolist() == [k - 1]
        walked = size_m / (model.offset_walk * np.sqrt(case.ours.readings.pause_s[k]))
        expected = np.sqrt(2 / (1 + walked**-2)) if rested[k - 1] else walked
        np.testing.assert_allclose(abs(misfit[k - 1]), expected, rtol=1e-9)


@few
@given(run=RUNS, factor=st.floats(0.0, 5.0))
def test_a_jolt_loosens_the_springs(run: Run, factor: float) -> None:
    case = draw(run)
    model, seen, where = case.ours.model, case.ours.readings, groups(case.ours)
    other = replace(model, jolt_bounce=factor * 0.003, jolt_pitch=factor * 0.015)
    before = case.ours.rows(case.truth, held(case)).misfit
    after = Stretch(seen, case.ours.places, other).rows(case.truth, held(case)).misfit
    both = [spring_sigmas(seen, each, seen.middles) for each in (model, other)]
    for sigmas, name in zip(np.transpose(both, (1, 0, 2)), ("bounce", "pitch"), strict=True):
        ratio = sigmas[0] / sigmas[1]
        np.testing.assert_allclose(after[where[name]], before[where[name]] * ratio, rtol=1e-9)
    assert np.array_equal(before[: where["bounce"].start], after[: where["bounce"].start])


def test_what_is_fixed_has_the_sigmas_of_the_table() -> None:
    """One unknown off by its 1-σ costs 1, in a row of its own; and steps of bias by their walk."""
    stretch = at_speed(np.full(8, 5.0))
    model, lay, start = stretch.model, stretch.layout, stretch.start()
    usual = stretch.weights(start, np.full(lay.points - 1, 1e-7))
    ends = {
        lay.place("gain"): 0.004,
        lay.place("lean"): 0.02,
        lay.place("centre"): 0.2,
        lay.place("log_front"): 0.6,
        lay.place("log_rear"): 0.6,
        lay.place("log_front_damping"): 0.8,
        lay.place("log_rear_damping"): 0.8,
        lay.place("log_gyration"): 0.15,
        lay.in_time("heave").start: model.heave_m + 5.0 * model.heave_speed,
        lay.in_time("nod").start: model.nod_rad + 5.0 * model.nod_speed,
    }
    for place, sigma in ends.items():
        y = start.copy()
        y[place] += sigma
        fixed = stretch.rows(y, usual).misfit[: stretch.fixed_sigma.size]
        np.testing.assert_allclose(np.sort(np.abs(fixed))[-2:], [0.0, 1.0], atol=1e-9)
    y = start.copy()
    y[lay.bias] = 1e-4 * np.sqrt(STEP) * np.arange(8)
    fixed = stretch.rows(y, usual).misfit[: stretch.fixed_sigma.size]
    np.testing.assert_allclose(np.sort(np.abs(fixed))[-8:], [0.0, *[1.0] * 7], atol=1e-9)
