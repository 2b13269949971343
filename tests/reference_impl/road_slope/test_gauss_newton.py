"""The answer is least squares, and errs as its covariance says, in runs drawn from the model."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref_reference.road_slope.bends import intensity_by_slopes
from floatref_reference.road_slope.gauss_newton import (
    Answer,
    after_step,
    covariance,
    full_step,
    jacobian,
    least_squares,
    squares,
)
from floatref_reference.road_slope.levelled import deviation
from floatref_reference.road_slope.rows import misfits
from floatref_reference.road_slope.symbols import Constants, Prior, Stretch
from floatref_reference.road_slope.unknowns import as_vector, by_name, start
from floatref_reference.road_slope.wheels import road_points

C = Constants(
    interval=0.1,
    spacing=1.0,
    bend=1e-6,
    acceleration=0.02,
    slope=0.005,
    start_height=0.1,
    offset=0.1,
    most_bend=1.0,
    first_bend=1.0,
    gain=Prior(0.008, 0.002),
    hz=Prior(1.6, 0.05),
    damping=Prior(0.3, 0.05),
)
"""Intensities are held at one value, so that the answer is one least-squares problem's; and
the accelerometer is so coarse that the square of the pitch is nearly a line within its 1-σ."""
BENDING = C._replace(bend=2e-7, most_bend=4000.0, first_bend=30.0)
Stopping = Callable[..., Stretch]


def held(stretch: Stretch) -> np.ndarray:
    return np.full(road_points(stretch).number - 1, stretch.constants.bend)


def errors(answer: Answer, truth: Any) -> Any:
    """Return all errors over their 1-σ by name."""
    N, K = len(truth.slope), len(truth.pitch)
    off = as_vector(answer.unknowns) - as_vector(truth)
    return by_name(off / np.sqrt(np.diag(answer.covariance)), N, K)


@settings(deadline=None, max_examples=5)
@given(seed=st.integers(0, 999))
def test_derivatives_by_the_complex_step_are_those_by_differences(
    drawn: Any, stopping: Stopping, seed: int
) -> None:
    stretch, truth = drawn(stopping(C, K=20), seed)
    vector, g = as_vector(truth), held(stretch)
    J = jacobian(vector, stretch, g)
    h = 1e-5 * np.eye(len(vector))
    above, below = (misfits(vector[:, None] + sign * h, stretch, g) for sign in (1, -1))
    scale = np.max(np.abs(J), axis=1, keepdims=True)
    assert (above - below) / 2e-5 / scale == pytest.approx(J / scale, abs=1e-6)


@settings(deadline=None, max_examples=5)
@given(seed=st.integers(0, 999))
def test_the_answer_is_where_the_sum_of_squares_has_no_gradient(
    drawn: Any, stopping: Stopping, seed: int
) -> None:
    """A few steps more lead there, by a small part of the 1-σ of every unknown."""
    stretch, _ = drawn(stopping(C, cut=30), seed)
    answer, g = least_squares(stretch), held(stretch)
    settled, sigma = as_vector(answer.unknowns), np.sqrt(np.diag(answer.covariance))
    x = settled
    for _ in range(5):
        x = after_step(x, full_step(x, stretch, g), stretch, g)
    J = jacobian(x, stretch, g)
    gradient = J.T @ misfits(x, stretch, g) / np.linalg.norm(J, axis=0)
    assert gradient == pytest.approx(np.zeros(len(x)), abs=1e-5)
    assert (x - settled) / sigma == pytest.approx(np.zeros(len(x)), abs=0.1)
    assert answer.change < 3e-4
    assert 4 <= answer.passes <= 12


@pytest.mark.parametrize("seed", range(4))
def test_a_run_gives_back_the_pitch_and_the_constants_it_was_drawn_with(
    drawn: Any, stopping: Stopping, seed: int
) -> None:
    stretch, truth = drawn(stopping(C), seed)
    answer = least_squares(stretch)
    off = errors(answer, truth)
    assert np.abs(off.pitch).max() < 4.5
    assert np.abs([*off[5:], *off.elevation]).max() < 4.5
    where = by_name(np.arange(len(answer.covariance)), len(truth.slope), 40)
    assert np.sqrt(answer.covariance[where.gain, where.gain]) < 0.5 * C.gain.sigma
    contrast = np.zeros((1, len(answer.covariance)))
    contrast[0, where.pitch[[0, 39]]] = 1, -1
    (sigma,), found = deviation(contrast, answer.covariance), answer.unknowns.pitch
    assert sigma < 0.003
    assert abs(found[0] - found[39] - truth.pitch[0] + truth.pitch[39]) < 4.5 * sigma


def test_the_covariance_is_the_inverse_of_the_normal_matrix(drawn: Any, stopping: Stopping) -> None:
    stretch, truth = drawn(stopping(C), 1)
    J = jacobian(as_vector(truth), stretch, held(stretch))
    cov = covariance(as_vector(truth), stretch, held(stretch))
    assert np.array_equal(cov, cov.T)
    assert J @ (cov @ (J.T @ J)) == pytest.approx(J, rel=1e-3, abs=1e-3)


@pytest.mark.slow
def test_errors_over_many_draws_are_as_the_covariance_says(drawn: Any, stopping: Stopping) -> None:
    """Of each kind of unknown; and S of the truth is higher by one for each unknown."""
    means, rises = [], []
    for seed in range(60):
        stretch, truth = drawn(stopping(C, cut=30), seed)
        answer, g = least_squares(stretch), held(stretch)
        means.append([np.mean(part**2) for part in errors(answer, truth)])
        found, drawn_as = as_vector(answer.unknowns), as_vector(truth)
        rise = squares(drawn_as, stretch, g) - squares(found, stretch, g)
        rises.append(rise / len(found))
    assert np.mean(means, axis=0) == pytest.approx(np.ones(11), abs=0.6)
    assert np.mean(rises) == pytest.approx(1, abs=0.06)


def test_intensities_are_those_of_the_slopes_found(drawn: Any, stopping: Stopping) -> None:
    stretch, _ = drawn(stopping(C._replace(bend=1e-3, slope=0.03)), 2)
    stretch = stretch._replace(constants=BENDING)
    answer = least_squares(stretch)
    assert np.array_equal(
        answer.intensity, intensity_by_slopes(answer.unknowns.slope, stretch.constants)
    )
    cov = covariance(as_vector(answer.unknowns), stretch, answer.intensity)
    assert np.array_equal(answer.covariance, cov)
    assert answer.intensity.max() > BENDING.bend


def test_a_step_that_helps_is_taken_whole(drawn: Any, stopping: Stopping) -> None:
    stretch, _ = drawn(stopping(C), 3)
    x, g = start(stretch), held(stretch)
    step = full_step(x, stretch, g)
    assert np.array_equal(after_step(x, step, stretch, g), x + step)


@pytest.mark.parametrize(
    ("factor", "taken"), [(1, 1), (6, 1.5), (12, 1.5), (24, 1.5), (1000, 62.5)]
)
def test_a_step_too_long_is_halved_four_times_at_most(
    drawn: Any, stopping: Stopping, factor: float, taken: float
) -> None:
    """Along a line S is a parabola with its least at 1: up to 2 it does not grow."""
    stretch, truth = drawn(stopping(C), 4)
    x, g = as_vector(truth), held(stretch)
    step = np.zeros(len(x))
    where = by_name(np.arange(len(x)), len(truth.slope), 40)
    step[where.offset] = 1e-9
    x[where.offset] += 1.0
    J = jacobian(x, stretch, g)[:, where.offset]
    step[where.offset] = -(J @ misfits(x, stretch, g)) / (J @ J)
    new = after_step(x, factor * step, stretch, g)
    assert (new - x)[where.offset] == pytest.approx(taken * step[where.offset])


def test_a_step_out_of_range_ends_at_the_range(drawn: Any, stopping: Stopping) -> None:
    stretch, truth = drawn(stopping(C), 4)
    x, g = as_vector(truth), held(stretch)
    where = by_name(np.arange(len(x)), len(truth.slope), 40)
    new = after_step(x, 1e6 * np.eye(len(x))[where.gain], stretch, g)
    assert new[where.gain] == 0.02
    assert squares(new, stretch, g) > squares(x, stretch, g)
