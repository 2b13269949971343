"""Discretization against series and closed forms."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref.vehicle_response import IMINE_TRAILER, ZHU_HALF_CAR, Hold, discretize, state_space

SEEDS = st.integers(0, 2**32 - 1)
laws = settings(deadline=None, max_examples=15)
STEP = 1 / 200


def drawn_states(seed, model):
    rng, count = np.random.default_rng(seed), len(model.freedoms)
    state = np.concatenate([0.01 * rng.normal(size=count), 0.2 * rng.normal(size=count)])
    return state, *(1e4 * rng.normal(size=(2, len(model.tyres))))


@laws
@given(seed=SEEDS, hold=st.sampled_from(Hold))
def test_two_steps_are_one_of_twice_the_length(seed, hold, drawn_parameters):
    for parameters in drawn_parameters(seed):
        model = parameters.model()
        state, first, last = drawn_states(seed, model)
        if hold is Hold.ZERO_ORDER:
            last = first
        half, whole = discretize(model, STEP, hold), discretize(model, 2 * STEP, hold)
        middle = (first + last) / 2
        found = half.transition @ state + half.before @ first + half.after @ middle
        found = half.transition @ found + half.before @ middle + half.after @ last
        wanted = whole.transition @ state + whole.before @ first + whole.after @ last
        scale = np.abs(wanted).max()
        np.testing.assert_allclose(found, wanted, rtol=1e-10, atol=1e-10 * scale)


def test_where_the_stiffness_can_be_inverted_it_is_the_formula_of_the_paper():
    model = ZHU_HALF_CAR.model()
    a, b = state_space(model)
    system = discretize(model, STEP)
    printed = (system.transition - np.eye(10)) @ np.linalg.inv(a) @ b
    np.testing.assert_allclose(system.input, printed, rtol=1e-9, atol=1e-9 * np.abs(printed).max())
    np.testing.assert_array_equal(system.after, 0.0)


def test_a_chassis_without_a_hitch_turns_on_at_its_rate():
    model = IMINE_TRAILER.model()
    free = np.array([0.0, 0.0, IMINE_TRAILER.axle_m, 0.0, 1.0])
    found = discretize(model, 0.5).transition @ np.concatenate([free, 2.0 * free])
    np.testing.assert_allclose(found, np.concatenate([2.0 * free, 2.0 * free]), atol=1e-9)


@laws
@given(seed=SEEDS)
def test_states_less_the_last_forces_need_no_next_ones(seed, drawn_parameters):
    for parameters in drawn_parameters(seed):
        model = parameters.model()
        state, first, last = drawn_states(seed, model)
        system = discretize(model, STEP, Hold.FIRST_ORDER)
        rest = state - system.after @ first
        found = system.transition @ rest + system.input @ first + system.after @ last
        wanted = system.transition @ state + system.before @ first + system.after @ last
        np.testing.assert_allclose(found, wanted, rtol=1e-9, atol=1e-9 * np.abs(wanted).max())
        output = np.random.default_rng(seed).normal(size=(3, state.size))
        direct = np.ones((3, first.size))
        through = system.feedthrough(output, direct)
        reading = output @ state + direct @ first
        np.testing.assert_allclose(output @ rest + through @ first, reading, rtol=1e-7)


@pytest.mark.parametrize("step_s", [0.0, -0.01, float("nan"), float("inf")])
def test_a_step_is_a_number_above_zero(step_s):
    with pytest.raises(InputError, match=r"model two-wheel-trailer: a time step of .* above zero"):
        discretize(IMINE_TRAILER.model(), step_s)
