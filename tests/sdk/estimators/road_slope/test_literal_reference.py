"""Rows, derivatives, answer and covariance are those of the literal reference."""

from dataclasses import asdict, replace

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from tests.sdk.estimators.road_slope.short_runs import MODEL, RUNS, Case, Run, draw

from floatref.estimators.road_slope.bends import first_bends
from floatref.estimators.road_slope.elevation_sigma import elevation_sigma, turn
from floatref.estimators.road_slope.gauss_newton import SETTLED_RAD, Fit, _go, fit
from floatref.estimators.road_slope.known_rows import known_before
from floatref.estimators.road_slope.levelled import is_believed
from floatref.estimators.road_slope.rows import Stretch, Weights
from floatref.values.arrays import FloatArray, IndexArray
from floatref_reference.road_slope import doubt
from floatref_reference.road_slope.constants import Constants
from floatref_reference.road_slope.gauss_newton import (
    Answer,
    after_step,
    full_step,
    jacobian,
    least_squares,
)
from floatref_reference.road_slope.held import Held, first_held
from floatref_reference.road_slope.priors import is_believed as is_believed_literally
from floatref_reference.road_slope.priors import prior_misfit
from floatref_reference.road_slope.rows import misfits
from floatref_reference.road_slope.symbols import Places, Readings
from floatref_reference.road_slope.symbols import Stretch as Literal
from floatref_reference.road_slope.unknowns import as_vector, by_name, start
from floatref_reference.road_slope.wheels import road_points, slopes_under_wheels

SEEDS = st.integers(0, 2**32 - 1)
LEANS = st.sampled_from([0.0, 0.012])
ANSWER = 1e-3
"""Of a 1-σ: the SDK solves with the normal matrix, the reference with the derivatives."""
COVARIANCE = 3e-3
"""Of the product of two 1-σ: normal matrices have conditions up to 1e14."""
few = settings(deadline=None, max_examples=8)


def literal(ours: Stretch) -> Literal:
    """Return what the reference knows of the same stretch."""
    seen, places = ours.readings, ours.places
    named = {name: value for name, value in asdict(ours.model).items() if name in Constants._fields}
    constants = Constants(**named | {"interval_s": seen.interval_s})
    readings = Readings(
        seen.height, seen.force, seen.place, seen.speed, seen.along, seen.missing, seen.pause_s
    )
    return Literal(readings, Places(places.front_m, places.rear_m, places.lever_m), constants)


def order_of(case: Case) -> tuple[IndexArray, FloatArray]:
    """Return the SDK's rows in the order of the reference, and their signs there.

    Only a height has the same sign in both: what was read less what is expected.
    """
    N, K = case.ours.layout.points, case.ours.layout.nodes
    middles = case.ours.readings.middles.size
    read = int(np.sum(~np.isnan(case.ours.readings.height)))
    sizes = [K - 1, K, K, 12, N - 1, N, N - 1, read, K - 1, K - 1, middles, middles, middles]
    parts = np.split(np.arange(sum(sizes)), np.cumsum(sizes)[:-1])
    bias, heave, nod, known, rises, slopes, bends = parts[:7]
    height, offset, moment, force, bounce, pitch = parts[7:]
    walks = [known[:1], bias, known[1:2], offset, known[2:3], moment]
    road = [slopes, np.column_stack([rises, bends]).ravel()]
    order = [height, force, bounce, pitch, *walks, heave, nod, *road, known[3:]]
    sign = np.full(sum(sizes), -1.0)
    sign[:read] = 1.0
    return np.concatenate(order), sign


def drawn_place(case: Case, seed: int) -> tuple[FloatArray, Weights, Held]:
    """Return unknowns about the true ones, and what a pass holds that began elsewhere."""
    rng = np.random.default_rng(seed)
    N, K = case.ours.layout.points, case.ours.layout.nodes
    y = case.truth + 1e-3 * rng.normal(size=case.ours.layout.size)
    bends = 10.0 ** rng.uniform(-7, -3, N - 1)
    sagged, beta = 1e-3 * rng.normal(size=K - 1), 0.02 * rng.normal(size=K)
    loose = float(rng.choice([1.0, 7.5]))
    ours = Weights(bends, sagged, np.diff(beta), loose)
    return y, ours, Held(bends, beta, sagged, loose)


@few
@given(run=RUNS, lean=LEANS)
def test_both_begin_at_the_same_unknowns(run: Run, lean: float) -> None:
    case = draw(run, replace(MODEL, lean_rad=lean, gain=0.008, hz=1.4, centre=0.4))
    known = literal(case.ours)
    np.testing.assert_allclose(case.ours.start(), start(known), rtol=1e-14)
    points = road_points(known)
    assert case.ours.layout.points == points.number
    assert abs(case.ours.first_m - points.first) < 1e-9


@pytest.mark.slow
@settings(deadline=None, max_examples=40)
@given(run=RUNS, seed=SEEDS, lean=LEANS)
def test_all_misfits_agree(run: Run, seed: int, lean: float) -> None:
    case = draw(run, replace(MODEL, lean_rad=lean))
    y, held, theirs = drawn_place(case, seed)
    order, sign = order_of(case)
    ours = sign * case.ours.rows(y, held).misfit[order]
    expected = misfits(y, literal(case.ours), theirs)
    np.testing.assert_allclose(ours, expected, rtol=1e-9, atol=1e-7)


@few
@given(run=RUNS, seed=SEEDS)
def test_all_derivatives_agree(run: Run, seed: int) -> None:
    case = draw(run)
    y, held, theirs = drawn_place(case, seed)
    order, sign = order_of(case)
    # The rows of the SDK hold what is predicted, of which a misfit is the negative.
    ours = -case.ours.rows(y, held).derivative[order].toarray()
    expected = sign[:, np.newaxis] * jacobian(y, literal(case.ours), theirs)
    size = np.abs(expected).max(axis=1, keepdims=True)
    np.testing.assert_allclose(ours / size, expected / size, rtol=0, atol=1e-10)


def assert_same_covariance(found: Fit, expected: FloatArray, seed: int) -> None:
    """Compare that of all unknowns, and of sums of them with both signs."""
    sigma = np.sqrt(np.diag(expected))
    signs = np.random.default_rng(seed).choice([-1.0, 1.0], size=(5, sigma.size))
    for weights in (np.diag(1.0 / sigma), signs / sigma / np.sqrt(sigma.size)):
        by_theirs = weights @ expected @ weights.T
        np.testing.assert_allclose(found.covariance(weights), by_theirs, rtol=0, atol=COVARIANCE)


@pytest.mark.slow
@settings(deadline=None, max_examples=12)
@given(run=RUNS, seed=SEEDS, lean=LEANS)
def test_answers_and_covariances_agree(run: Run, seed: int, lean: float) -> None:
    """Where passes end by a change next to the bound, rounding decides after how many they do."""
    case = draw(run, replace(MODEL, lean_rad=lean))
    expected, found = least_squares(literal(case.ours)), fit(case.ours)
    assume(min(abs(c / SETTLED_RAD - 1) for c in (found.changed_rad, expected.change)) > 0.02)
    assume(expected.change < SETTLED_RAD)
    assert found.passes == expected.passes
    sigma = np.sqrt(np.diag(expected.covariance))
    off = (found.unknowns - as_vector(expected.unknowns)) / sigma
    np.testing.assert_allclose(off, 0.0, atol=ANSWER)
    np.testing.assert_allclose(found.bends, expected.held.intensity, rtol=1e-2)
    assert_same_covariance(found, expected.covariance, seed)


@pytest.mark.slow
@few
@given(run=RUNS, seed=SEEDS, factor=st.floats(0.0, 4.0))
def test_a_step_is_halved_as_often(run: Run, seed: int, factor: float) -> None:
    """From nothing, when it is of the right length, to four times, when it is far too long."""
    case = draw(run)
    y, held, theirs = drawn_place(case, seed)
    known = literal(case.ours)
    step, before = full_step(y, known, theirs), case.ours.misfit(y, held)
    for way in (10.0**factor * step, -(10.0 ** (factor - 2)) * step):
        found = _go(case.ours, y.copy(), way, before, held)
        np.testing.assert_allclose(found, after_step(y, way, known, theirs), rtol=1e-12)


def low_pass(places: FloatArray, at: float, wavelength_m: float) -> FloatArray:
    """Return weights, of sum 1, of the response of the gain 1/(1 + (λ_c ν)⁶), cut at 1.5 λ_c."""
    a = 2 * np.pi / wavelength_m * np.abs(places - at)
    b = np.sqrt(3) / 2 * a
    kernel = np.exp(-a) + np.exp(-a / 2) * (np.cos(b) + np.sqrt(3) * np.sin(b))
    kernel[np.abs(places - at) > 1.5 * wavelength_m] = 0.0
    return np.asarray(kernel / kernel.sum())


def road_and_beyond(known: Literal, size: int, reach_m: float) -> tuple[FloatArray, FloatArray]:
    """Return places in m from the first point, and the elevations there as sums of unknowns."""
    N, d = road_points(known).number, known.constants.spacing_m
    beyond = round(reach_m / d)
    inside, eye = np.clip(np.arange(-beyond, N + beyond), 0, N - 1), np.eye(size)
    places = d * np.arange(-beyond, N + beyond, dtype=np.float64)
    further = (places - d * inside)[:, np.newaxis]
    return places, eye[inside] + further * eye[N + inside]


@settings(deadline=None, max_examples=6)
@given(run=RUNS, seed=SEEDS, wavelength_m=st.floats(5.0, 15.0), share=st.floats(0, 1))
def test_sigma_is_that_of_a_high_pass_of_the_road_and_the_lines_beyond(
    run: Run, seed: int, wavelength_m: float, share: float
) -> None:
    case = draw(run)
    known, points = literal(case.ours), road_points(literal(case.ours))
    y, bends = case.truth, drawn_place(case, seed)[1].bends
    found = Fit(case.ours, y, bends, 1, 0.0)
    mark = points.spacing * round(share * (points.number - 1))
    places, road = road_and_beyond(known, y.size, 2 * wavelength_m)
    weights = (np.isclose(places, mark) - low_pass(places, mark, wavelength_m)) @ road
    held = case.ours.weights(y, bends)
    beta = case.ours.slope @ y[case.ours.layout.elevation]
    theirs = Held(bends, beta, held.sagged)
    answer = Answer(by_name(y, points.number, beta.size), theirs, np.empty((0, 0)), 1, 0.0)
    expected = doubt.elevation_sigma(weights[np.newaxis], answer, known)
    sigma = elevation_sigma(found, np.array([points.first + mark]), wavelength_m)
    np.testing.assert_allclose(sigma, expected, rtol=1e-4)


@few
@given(run=RUNS)
def test_turns_agree(run: Run) -> None:
    case = draw(run)
    known, lay = literal(case.ours), case.ours.layout
    beta = np.array(slopes_under_wheels(case.truth[lay.elevation], known))
    found = turn(Fit(case.ours, case.truth, np.full(lay.points - 1, 1e-5), 1, 0.0))
    assert found == pytest.approx(doubt.turning(beta, known), rel=1e-9, abs=1e-12)


@few
@given(run=RUNS)
def test_first_passes_agree(run: Run) -> None:
    """What the first pass holds gives the sum of squares of the reference."""
    case = draw(run)
    known, y = literal(case.ours), case.ours.start()
    held = case.ours.weights(y, first_bends(case.ours.layout.points, case.ours.model), 30.0)
    held = held._replace(sagged=np.full(held.sagged.size, case.ours.model.first_sag_m))
    total = float(np.sum(misfits(y, known, first_held(known)) ** 2))
    assert abs(case.ours.misfit(y, held) / total - 1) < 1e-9


@few
@given(run=RUNS, seed=SEEDS, spread=st.floats(0.1, 3.0), change=st.floats(0.0, 6e-3))
def test_both_believe_the_same_answers(run: Run, seed: int, spread: float, change: float) -> None:
    """Of unknowns that are off what was known of them by some of its 1-σ."""
    case = draw(run)
    y, rng = case.ours.start(), np.random.default_rng(seed)
    known = known_before(case.ours.layout, case.ours.model)
    means, sigmas = np.array(list(known.values())).T
    y[list(known)] = means + spread * sigmas * rng.normal(size=means.size)
    ours = Fit(case.ours, y, np.full(case.ours.layout.points - 1, 1e-5), 7, change)
    x = by_name(y, case.ours.layout.points, case.ours.layout.nodes)
    constants = literal(case.ours).constants
    assert ours.prior_misfit == pytest.approx(prior_misfit(x, constants), rel=1e-9)
    assert is_believed(ours) == is_believed_literally(x, constants, change)
