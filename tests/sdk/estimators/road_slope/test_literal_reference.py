"""Rows, derivatives, answer and covariance are those of the literal reference."""

from dataclasses import replace

import numpy as np
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from tests.sdk.estimators.road_slope.short_runs import MODEL, RUNS, Case, Run, as_ours, draw

from floatref.estimators.road_slope.gauss_newton import SETTLED_RAD, Fit, _go, fit
from floatref.values.arrays import FloatArray, IndexArray
from floatref_reference.road_slope.bends import first_intensity
from floatref_reference.road_slope.gauss_newton import (
    after_step,
    covariance,
    full_step,
    jacobian,
    least_squares,
)
from floatref_reference.road_slope.levelled import deviation
from floatref_reference.road_slope.rows import misfits
from floatref_reference.road_slope.symbols import Stretch as Literal
from floatref_reference.road_slope.unknowns import as_vector, start
from floatref_reference.road_slope.wheels import road_points

SEEDS = st.integers(0, 2**32 - 1)
LEANS = st.sampled_from([0.0, 0.012])
ANSWER = 2e-4
"""Of a 1-σ: the SDK solves with the normal matrix, the reference with the derivatives."""
COVARIANCE = 1e-3
"""Of the product of two 1-σ: normal matrices have conditions up to 1e14."""
few = settings(deadline=None, max_examples=8)


def order_of(case: Case) -> tuple[IndexArray, FloatArray]:
    """Return the SDK's rows in the order of the reference, and their signs there.

    Only a height has the same sign in both: what was read less what is expected.
    """
    N, K, middles = case.ours.layout.points, case.ours.layout.nodes, case.ours.middles.size
    read = int(np.sum(~np.isnan(case.literal.readings.height)))
    sizes = [read, K - 1, 8, N - 1, N, N - 1, middles, middles, K]
    parts = np.split(np.arange(sum(sizes)), np.cumsum(sizes)[:-1])
    height, bias, known, rises, slopes, bends, force, swing, even = parts
    road = np.column_stack([rises, bends]).ravel()
    order = [height, force, swing, even, known[:1], bias, slopes, road, known[1:]]
    sign = np.full(sum(sizes), -1.0)
    sign[:read] = 1.0
    return np.concatenate(order), sign


def drawn_place(case: Case, seed: int) -> tuple[FloatArray, FloatArray]:
    """Return unknowns about the true ones, and intensities of the slope."""
    rng = np.random.default_rng(seed)
    layout, y = case.ours.layout, as_vector(case.truth)
    y = y + 1e-3 * rng.normal(size=layout.size)
    return y, 10.0 ** rng.uniform(-7, -3, layout.points - 1)


@few
@given(run=RUNS, lean=LEANS)
def test_both_begin_at_the_same_unknowns(run: Run, lean: float) -> None:
    case = draw(run, replace(MODEL, lean_rad=lean, gain=0.008, hz=1.4, centre=0.4))
    np.testing.assert_allclose(case.ours.start(), start(case.literal), rtol=1e-15)
    points = road_points(case.literal)
    assert case.ours.layout.points == points.number
    assert abs(case.ours.first_m - points.first) < 1e-9


@settings(deadline=None, max_examples=40)
@given(run=RUNS, seed=SEEDS, lean=LEANS)
def test_all_misfits_agree(run: Run, seed: int, lean: float) -> None:
    case = draw(run, replace(MODEL, lean_rad=lean))
    y, bends = drawn_place(case, seed)
    order, sign = order_of(case)
    ours = case.ours.rows(y, bends).misfit[order]
    expected = misfits(y, case.literal, bends)
    np.testing.assert_allclose(sign * ours, expected, rtol=1e-11, atol=1e-9)


@few
@given(run=RUNS, seed=SEEDS)
def test_all_derivatives_agree(run: Run, seed: int) -> None:
    """Those by ln f and ln ζ are differences in the SDK, accurate to the square of their step."""
    case = draw(run)
    y, bends = drawn_place(case, seed)
    order, sign = order_of(case)
    # The rows of the SDK hold what is predicted, of which a misfit is the negative.
    ours = -case.ours.rows(y, bends).derivative[order].toarray()
    expected = sign[:, np.newaxis] * jacobian(y, case.literal, bends)
    rough = [case.ours.layout.place(name) for name in ("log_hz", "log_damping")]
    size = np.abs(expected).max(axis=1, keepdims=True)
    np.testing.assert_allclose(ours[:, rough] / size, expected[:, rough] / size, atol=1e-8)
    ours[:, rough] = expected[:, rough] = 0.0
    np.testing.assert_allclose(ours / size, expected / size, rtol=0, atol=1e-13)


def assert_same_covariance(found: Fit, literal: FloatArray, seed: int) -> None:
    """Compare that of all unknowns, and of sums of them with both signs."""
    sigma = np.sqrt(np.diag(literal))
    signs = np.random.default_rng(seed).choice([-1.0, 1.0], size=(5, sigma.size))
    for weights in (np.diag(1.0 / sigma), signs / sigma / np.sqrt(sigma.size)):
        expected = weights @ literal @ weights.T
        np.testing.assert_allclose(found.covariance(weights), expected, rtol=0, atol=COVARIANCE)


@settings(deadline=None, max_examples=12)
@given(run=RUNS, seed=SEEDS, lean=LEANS)
def test_answers_and_covariances_agree(run: Run, seed: int, lean: float) -> None:
    """Where passes end by a change next to the bound, rounding decides after how many they do."""
    case = draw(run, replace(MODEL, lean_rad=lean))
    expected, found = least_squares(case.literal), fit(case.ours)
    assume(min(abs(c / SETTLED_RAD - 1) for c in (found.changed_rad, expected.change)) > 0.02)
    assert found.passes == expected.passes
    assume(expected.change < SETTLED_RAD)
    sigma = np.sqrt(np.diag(expected.covariance))
    off = (found.unknowns - as_vector(expected.unknowns)) / sigma
    np.testing.assert_allclose(off, 0.0, atol=ANSWER)
    np.testing.assert_allclose(found.bends, expected.intensity, rtol=1e-3)
    assert abs(found.of("gain") - expected.unknowns.gain) < ANSWER * MODEL.gain_sigma
    assert_same_covariance(found, expected.covariance, seed)


def test_where_nothing_changes_both_make_the_fewest_passes() -> None:
    """A level road without readings but 0 is the answer from the first."""
    literal, zero = draw(Run(1)).literal, np.zeros(20)
    still = literal._replace(
        readings=literal.readings._replace(height=zero, force=zero, along=zero)
    )
    assert fit(as_ours(still, MODEL)).passes == least_squares(still).passes == 4


@few
@given(run=RUNS, seed=SEEDS, factor=st.floats(0.0, 4.0))
def test_a_step_is_halved_as_often(run: Run, seed: int, factor: float) -> None:
    """From nothing, when it is of the right length, to four times, when it is far too long."""
    case = draw(run)
    y, bends = drawn_place(case, seed)
    step, before = full_step(y, case.literal, bends), case.ours.misfit(y, bends)
    for way in (10.0**factor * step, -(10.0 ** (factor - 2)) * step):
        found = _go(case.ours, y, way, before, bends)
        np.testing.assert_allclose(found, after_step(y, way, case.literal, bends), rtol=1e-12)


def low_pass(places: FloatArray, at: float, wavelength_m: float) -> FloatArray:
    """Return weights, of sum 1, of the response of the gain 1/(1 + (λ_c ν)⁶), cut at 1.5 λ_c."""
    a = 2 * np.pi / wavelength_m * np.abs(places - at)
    b = np.sqrt(3) / 2 * a
    kernel = np.exp(-a) + np.exp(-a / 2) * (np.cos(b) + np.sqrt(3) * np.sin(b))
    kernel[np.abs(places - at) > 1.5 * wavelength_m] = 0.0
    return np.asarray(kernel / kernel.sum())


def road_and_beyond(literal: Literal, size: int, reach_m: float) -> tuple[FloatArray, FloatArray]:
    """Return places in m from the first point, and the elevations there as sums of unknowns."""
    N, d = road_points(literal).number, literal.constants.spacing
    beyond = round(reach_m / d)
    known, eye = np.clip(np.arange(-beyond, N + beyond), 0, N - 1), np.eye(size)
    places = d * np.arange(-beyond, N + beyond, dtype=np.float64)
    further = (places - d * known)[:, np.newaxis]
    return places, eye[known] + further * eye[N + known]


@settings(deadline=None, max_examples=6)
@given(run=RUNS, wavelength_m=st.floats(5.0, 15.0), share=st.floats(0, 1))
def test_sigma_is_that_of_a_high_pass_of_the_road_and_the_lines_beyond(
    run: Run, wavelength_m: float, share: float
) -> None:
    case = draw(run)
    found, points = fit(case.ours), road_points(case.literal)
    mark = points.spacing * round(share * (points.number - 1))
    size = found.stretch.layout.size
    places, road = road_and_beyond(case.literal, size, 2 * wavelength_m)
    weights = (np.isclose(places, mark) - low_pass(places, mark, wavelength_m)) @ road
    known = covariance(found.unknowns, case.literal, found.bends)
    expected = deviation(weights[np.newaxis], known)
    sigma = found.elevation_sigma(np.array([points.first + mark]), wavelength_m)
    np.testing.assert_allclose(sigma, expected, rtol=1e-6)


@few
@given(run=RUNS)
def test_first_intensities_agree(run: Run) -> None:
    """A pass that is held to them has the rows of the reference."""
    case = draw(run)
    bends = first_intensity(case.ours.layout.points, case.literal.constants)
    y = case.ours.start()
    total = float(np.sum(misfits(y, case.literal, bends) ** 2))
    assert abs(case.ours.misfit(y, bends) / total - 1) < 1e-9
