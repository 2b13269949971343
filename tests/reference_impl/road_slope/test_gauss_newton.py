"""The answer is least squares, and errs as its covariance says, in runs drawn from the model."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref_reference.road_slope.bends import intensity_by_slopes
from floatref_reference.road_slope.constants import Constants
from floatref_reference.road_slope.doubt import deviation
from floatref_reference.road_slope.gauss_newton import (
    Answer,
    after_step,
    covariance,
    full_step,
    jacobian,
    least_squares,
    squares,
)
from floatref_reference.road_slope.held import Held, first_held, held_by
from floatref_reference.road_slope.rows import misfits
from floatref_reference.road_slope.symbols import Stretch
from floatref_reference.road_slope.unknowns import as_vector, by_name, start
from floatref_reference.road_slope.wheels import road_points, slopes_under_wheels

C = Constants(
    interval_s=0.1,
    spacing_m=1.0,
    bends=1e-6,
    acceleration=0.02,
    slope=0.005,
    start_m=0.1,
    offset_m=0.1,
    most_bend=1.0,
    first_bend=1.0,
    moment_share=0.0,
    gain=0.008,
    gain_sigma=0.002,
    stiffness_sigma=0.1,
    damping_sigma=0.1,
    gyration_sigma=0.05,
    centre_sigma=0.05,
)
"""Intensities and the walk of the moment are held at one value, so that the answer is one
least-squares problem's; and the accelerometer is so coarse that the square of the pitch is nearly
a line within its 1-σ."""
BENDING = C._replace(bends=2e-7, most_bend=4000.0, first_bend=30.0, moment_share=0.3)
Stopping = Callable[..., Stretch]


def held_at(vector: np.ndarray, stretch: Stretch) -> Held:
    N = road_points(stretch).number
    return held_by(vector, stretch, np.full(N - 1, stretch.constants.bends))


def errors(answer: Answer, truth: Any) -> Any:
    """Return all errors over their 1-σ by name."""
    N, K = len(truth.slope), len(truth.pitch)
    off = as_vector(answer.unknowns) - as_vector(truth)
    return by_name(off / np.sqrt(np.diag(answer.covariance)), N, K)


@settings(deadline=None, max_examples=3)
@given(seed=st.integers(0, 999), loose=st.floats(1, 30))
def test_derivatives_by_the_complex_step_are_those_by_differences(
    drawn: Any, stopping: Stopping, seed: int, loose: float
) -> None:
    stretch, truth = drawn(stopping(BENDING, K=8), seed)
    vector = as_vector(truth)
    held = held_at(vector, stretch)._replace(loose=loose)
    J = jacobian(vector, stretch, held)
    h = 1e-5 * np.eye(len(vector))
    above, below = (misfits(vector[:, None] + sign * h, stretch, held) for sign in (1, -1))
    scale = np.max(np.abs(J), axis=1, keepdims=True)
    assert (above - below) / 2e-5 / scale == pytest.approx(J / scale, abs=1e-6)


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(3))
def test_the_answer_is_where_the_sum_of_squares_has_no_gradient(
    drawn: Any, stopping: Stopping, seed: int
) -> None:
    """A few steps more lead there, within a quarter of the 1-σ of every unknown."""
    stretch, _ = drawn(stopping(C, cut=25), seed)
    answer = least_squares(stretch)
    settled, sigma = as_vector(answer.unknowns), np.sqrt(np.diag(answer.covariance))
    x, held = settled, held_at(settled, stretch)
    for _ in range(12):
        x = after_step(x, full_step(x, stretch, held), stretch, held)
    J = jacobian(x, stretch, held)
    gradient = J.T @ misfits(x, stretch, held) / np.linalg.norm(J, axis=0)
    assert gradient == pytest.approx(np.zeros(len(x)), abs=1e-3)
    assert (x - settled) / sigma == pytest.approx(np.zeros(len(x)), abs=0.25)


@pytest.mark.parametrize("seed", [0, *(pytest.param(i, marks=pytest.mark.slow) for i in (1, 2, 3))])
def test_a_run_gives_back_the_pitch_and_the_constants_it_was_drawn_with(
    drawn: Any, stopping: Stopping, seed: int
) -> None:
    stretch, truth = drawn(stopping(C, K=20, speed=3.0), seed)
    answer = least_squares(stretch)
    assert 7 <= answer.passes <= 40
    assert answer.change < 3e-4
    assert answer.held.loose == 1
    off = errors(answer, truth)
    assert np.abs(off.pitch).max() < 4.5
    assert np.abs([*off[9:], *off.elevation]).max() < 4.5
    where = by_name(np.arange(len(answer.covariance)), len(truth.slope), 20)
    assert np.sqrt(answer.covariance[where.gain, where.gain]) < 0.5 * C.gain_sigma
    contrast = np.zeros((1, len(answer.covariance)))
    contrast[0, where.pitch[[0, 19]]] = 1, -1
    (sigma,) = deviation(contrast, answer.covariance, contrast, np.zeros(1))
    found = answer.unknowns.pitch
    assert sigma < 0.003
    assert abs(found[0] - found[19] - truth.pitch[0] + truth.pitch[19]) < 4.5 * sigma


@pytest.mark.slow
def test_the_covariance_is_the_inverse_of_the_normal_matrix(drawn: Any, stopping: Stopping) -> None:
    stretch, truth = drawn(stopping(C, K=12), 1)
    vector = as_vector(truth)
    held = held_at(vector, stretch)
    J, cov = jacobian(vector, stretch, held), covariance(vector, stretch, held)
    assert np.array_equal(cov, cov.T)
    assert J @ (cov @ (J.T @ J)) == pytest.approx(J, rel=1e-3, abs=1e-3)


@pytest.mark.slow
@pytest.mark.nightly
def test_errors_over_many_draws_are_as_the_covariance_says(drawn: Any, stopping: Stopping) -> None:
    """Of each kind of unknown; and S of the truth is higher by one for each unknown."""
    means, rises = [], []
    for seed in range(60):
        stretch, truth = drawn(stopping(C, cut=25), seed)
        answer = least_squares(stretch)
        means.append([np.mean(part**2) for part in errors(answer, truth)])
        found, drawn_as = as_vector(answer.unknowns), as_vector(truth)
        rise = squares(drawn_as, stretch, answer.held) - squares(found, stretch, answer.held)
        rises.append(rise / len(found))
    assert np.mean(means, axis=0) == pytest.approx(np.ones(17), abs=0.6)
    assert np.mean(rises) == pytest.approx(1, abs=0.06)


@pytest.mark.slow
def test_what_is_held_is_that_of_the_unknowns_found(drawn: Any, stopping: Stopping) -> None:
    stretch, _ = drawn(stopping(C._replace(bends=1e-3, slope=0.03), K=20, speed=3.0), 2)
    stretch = stretch._replace(constants=BENDING)
    answer = least_squares(stretch)
    slopes = answer.unknowns.slope
    assert np.array_equal(answer.held.intensity, intensity_by_slopes(slopes, stretch.constants))
    beta = slopes_under_wheels(answer.unknowns.elevation, stretch)
    assert np.array_equal(answer.held.beta, beta)
    assert np.array_equal(answer.held.stepped, np.diff(answer.unknowns.offset))
    assert answer.held.loose == 1
    cov = covariance(as_vector(answer.unknowns), stretch, answer.held)
    assert np.array_equal(answer.covariance, cov)
    assert answer.held.intensity.max() > BENDING.bends


def test_a_step_that_helps_is_taken_whole(drawn: Any, stopping: Stopping) -> None:
    stretch, _ = drawn(stopping(C), 3)
    x, held = start(stretch), first_held(stretch)
    step = full_step(x, stretch, held)
    assert np.array_equal(after_step(x, step, stretch, held), x + step)


@pytest.mark.parametrize(
    ("factor", "taken"), [(1, 1), (6, 1.5), (12, 1.5), (24, 1.5), (1000, 62.5)]
)
def test_a_step_too_long_is_halved_four_times_at_most(
    drawn: Any, stopping: Stopping, factor: float, taken: float
) -> None:
    """Along a line S is a parabola with its least at 1: up to 2 it does not grow."""
    stretch, truth = drawn(stopping(C, K=12), 4)
    x = as_vector(truth)
    held = held_at(x, stretch)
    where = by_name(np.arange(len(x)), len(truth.slope), 12)
    at = where.offset[5]
    x[at] += 1.0
    J = jacobian(x, stretch, held)[:, at]
    step = -(J @ misfits(x, stretch, held)) / (J @ J) * np.eye(len(x))[at]
    new = after_step(x, factor * step, stretch, held)
    assert (new - x)[at] == pytest.approx(taken * step[at])


def test_a_step_out_of_range_ends_at_the_range(drawn: Any, stopping: Stopping) -> None:
    stretch, truth = drawn(stopping(C, K=12), 4)
    x = as_vector(truth)
    held = held_at(x, stretch)
    where = by_name(np.arange(len(x)), len(truth.slope), 12)
    new = after_step(x, 1e6 * np.eye(len(x))[where.gain], stretch, held)
    assert new[where.gain] == 0.02
    assert squares(new, stretch, held) > squares(x, stretch, held)
