"""The filter's Jacobians are what sympy derives from the model, and the page shows these."""

import importlib.util
from pathlib import Path

import numpy as np
import pytest
import sympy as sp
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.estimators.kalman import forward
from floatref.estimators.kalman.noise import Noise
from floatref.estimators.kalman.references import Plan
from floatref.estimators.kalman.track import TrackFilter
from floatref.estimators.models import kalman_values as values
from floatref.estimators.models.kalman_values import KINDS, STATES
from floatref.values.arrays import new_record

GENERATOR = Path(__file__).parents[4] / ".ci" / "jacobians.py"
SPEC = importlib.util.spec_from_file_location("jacobians", GENERATOR)
symbolic = importlib.util.module_from_spec(SPEC)
SPEC.loader.exec_module(symbolic)

STEP, ARM = 1 / 500, (0.8, -0.5, 1.6)
SIZE = np.array([1.0, 0.5, 0.6, 0.6, 0.1, 0.1, 0.1, 0.1, 0.1, 0.1])
STILL = Noise(**dict.fromkeys(vars(Noise()), 0.0))
SYMBOLS = [
    *(*symbolic.STATE, *symbolic.INPUT, *symbolic.ARM),
    *(symbolic.STEP, symbolic.GRAVITY, symbolic.LEVEL),
]
MATRICES = symbolic.jacobians() | {"h": symbolic.measurement()}
FUNCTIONS = {name: sp.lambdify(SYMBOLS, matrix) for name, matrix in MATRICES.items()}
laws = settings(deadline=None, max_examples=50)
SEEDS = st.integers(0, 2**32 - 1)


def drawn(seed, turning=1.0):
    """Return a state at large angles, inputs with gravity, and the force the lean counts from."""
    rng = np.random.default_rng(seed)
    u = np.array([5.0, 3.0, 4.0, *[turning] * 3]) * rng.uniform(-1, 1, 6)
    u[2] += values_of(STILL).gravity
    return SIZE * rng.uniform(-1, 1, STATES), u, rng.uniform(-3, 3)


def values_of(noise):
    return TrackFilter.of(Plan(), noise, STEP, ARM, 0.0).model._replace(sub_block=1)


def derived(name, x, u, level):
    numbers = *x, *u, *ARM, STEP, values_of(STILL).gravity, level
    return np.array(FUNCTIONS[name](*numbers), dtype=np.float64)


def step_once(x, p, u, level, noise=STILL):
    """Return P and the transition after a step of constant inputs, from ``x`` and ``p``."""
    state = values.Filter(x.copy(), p.copy(), new_record(values.MEMORY))
    state.memory.level = level
    model, height = values_of(noise), np.empty(2)
    unweighted = u - [0, 0, model.gravity, 0, 0, 0]
    inputs = values.Inputs(0, *(np.full(2, component) for component in unweighted))
    nothing = np.empty(0, np.int64), np.empty(0, np.int64)
    rows = np.empty((0, KINDS)), np.empty((0, KINDS)), np.empty(0)
    out = values.Output(height, np.empty(3, values.NODE), np.empty(0, values.UPDATE))
    assert forward.run(model, inputs, values.Observations(*nothing, *rows), state, out) == 2
    return state.p, out.nodes["transition"][1]


@pytest.mark.cites("(6.11)", "(C.3)", "(C.4)")
@laws
@given(seed=SEEDS)
def test_the_transition_of_a_step_is_the_derivative_of_the_process_model(seed):
    x, u, level = drawn(seed)
    A = derived("A", x, u, level)
    _, transition = step_once(x, np.zeros((STATES, STATES)), u, level)
    for name in values.TRANSITION.names:
        of, _, by = name.partition("_")
        place = getattr(values, of.upper()), getattr(values, by.upper())
        assert transition[name] == pytest.approx(A[place], rel=1e-11, abs=1e-15), name


@pytest.mark.cites("(6.10)", "(6.11)", "(C.3)")
@laws
@given(seed=SEEDS)
def test_the_covariance_is_carried_by_every_element_of_that_derivative(seed):
    x, u, level = drawn(seed)
    A, root = derived("A", x, u, level), np.random.default_rng(seed).normal(size=(STATES, STATES))
    p = root @ root.T
    np.testing.assert_allclose(step_once(x, p, u, level)[0], A @ p @ A.T, rtol=1e-11, atol=1e-12)


@pytest.mark.cites("(6.12)", "(C.5)", "(C.6)")
@laws
@given(seed=SEEDS)
def test_the_noise_of_a_step_comes_in_by_the_derivative_by_noise(seed):
    """Without rates, since the filter takes the attitude behind the step."""
    x, u, level = drawn(seed, turning=0.0)
    x[values.ROLL_BIAS] = x[values.PITCH_BIAS] = 0.0
    densities = np.random.default_rng(seed).uniform(0.1, 2.0, 7)
    names = ("acceleration", "roll_rate", "pitch_rate", "yaw_rate")
    walks = ("acceleration_walk", "roll_rate_walk", "pitch_rate_walk")
    noise = Noise(**{**vars(STILL), **dict(zip((*names, *walks), densities, strict=True))})
    Q = np.diag(densities**2 * np.array([1 / STEP] * 4 + [STEP] * 3))
    W = derived("W", x, u, level)
    found = step_once(x, np.zeros((STATES, STATES)), u, level, noise)[0]
    np.testing.assert_allclose(found, W @ Q @ W.T, rtol=1e-11, atol=1e-18)


@pytest.mark.cites("(6.14)", "(6.48)", "(C.8)", "(C.9)")
@laws
@given(seed=SEEDS)
def test_readings_and_their_rows_are_the_measurement_model_and_its_derivative(seed):
    """But for the drift, which only readings from GNSS have."""
    x, u, level = drawn(seed)
    x[values.DRIFT] = 0.0
    memory = new_record(values.MEMORY)
    memory.roll_rate, memory.pitch_rate, memory.yaw_rate = u[3:]
    rows, predicted = np.empty((KINDS, STATES)), np.empty(KINDS)
    state = values.Filter(x, np.zeros((STATES, STATES)), memory)
    forward.expect(values_of(STILL), state, rows, predicted)
    H = derived("H", x, u, level)
    assert H[values.HEIGHT, values.DRIFT] == 1.0
    H[values.HEIGHT, values.DRIFT] = 0.0
    np.testing.assert_allclose(rows, H, rtol=1e-11, atol=1e-14)
    np.testing.assert_allclose(predicted, derived("h", x, u, level)[:, 0], rtol=1e-11, atol=1e-14)


@pytest.mark.slow
def test_the_page_shows_these_derivatives():
    assert symbolic.PAGE.read_text(encoding="utf-8") == symbolic.page()
