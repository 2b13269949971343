"""The observer's equations are those of the reference, and its samples those of (10) and (11)."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref.vehicle_response import (
    Freedom,
    Kind,
    Reading,
    Trailer,
    Tyre,
    UnknownInputObserver,
    VehicleModel,
    default_gains,
)
from floatref.vehicle_response.estimators.gains import output_matrix
from floatref.vehicle_response.estimators.unknown_inputs import observer_equations
from floatref_reference.imine import (
    section_2_trailer,
    section_4_a_observer,
    section_4_b_convergence,
    section_4_state_form,
    section_5_simulation,
)

SEEDS = st.integers(0, 2**32 - 1)
STEP = 1.0 / section_5_simulation.F_S


def drawn(seed):
    """A trailer, the same in the reference, and gains of every displacement on every state."""
    rng = np.random.default_rng(seed)
    # Both count the parameters as the paper does.
    common = (np.array(section_2_trailer.Trailer()) * rng.uniform(0.8, 1.25, 16)).tolist()
    model = Trailer(*common).model()
    gains = np.vstack([np.diag(rng.uniform(10.0, 40.0, 5)), np.diag(rng.uniform(20.0, 200.0, 5))])
    gains = gains + rng.uniform(-0.5, 0.5, gains.shape)
    return model, section_4_state_form.state_form(section_2_trailer.Trailer(*common)), gains, rng


def readings(model):
    return [Reading(Kind.DISPLACEMENT, freedom.name, 1e-4) for freedom in model.freedoms]


@pytest.mark.cites("(8) of Imine", "(9) of Imine", "(12) to (14) of Imine")
@settings(deadline=None, max_examples=25)
@given(seed=SEEDS)
def test_the_error_matrix_is_that_of_the_reference(seed):
    model, form, gains, _ = drawn(seed)
    places = section_4_state_form.output_matrix([0, 1, 2, 3, 4])
    expected = section_4_b_convergence.error_matrix(form, gains, places)
    found = observer_equations(model, gains, output_matrix(model, readings(model))).error
    scale = np.abs(expected).max(axis=1, keepdims=True)
    assert (np.abs(found - expected) <= 1e-12 * scale).all()


@pytest.mark.cites("(8) of Imine", "(9) of Imine", "(10) of Imine", "(11) of Imine")
@settings(deadline=None, max_examples=25)
@given(seed=SEEDS)
def test_the_inputs_act_as_in_the_reference(seed):
    model, form, gains, rng = drawn(seed)
    places = section_4_state_form.output_matrix([0, 1, 2, 3, 4])
    x, u, y, a = rng.normal(size=10), rng.normal(size=2), rng.normal(size=5), rng.normal(size=2)
    slope = section_4_a_observer.estimator(x, u, a, form)
    rate = section_4_a_observer.observer(x, u, slope, y, form, gains, places)
    equations = observer_equations(model, gains, output_matrix(model, readings(model)))
    found = equations.error @ np.append(x, u) + equations.inputs @ np.append(y, a)
    expected = np.append(rate, slope)
    assert np.abs(found - expected).max() <= 1e-9 * np.abs(expected).max()


@pytest.mark.slow
@pytest.mark.cites("(10) of Imine", "(11) of Imine")
@settings(deadline=None, max_examples=4)
@given(seed=SEEDS)
def test_samples_are_those_of_the_reference(seed):
    model, form, gains, rng = drawn(seed)
    y, a = 1e-3 * rng.normal(size=(16, 5)), rng.normal(size=(16, 2))
    watch = UnknownInputObserver.of(model, STEP, gains, readings(model), 0.05, degree=1)
    found = replace(watch, settling_s=0.0).estimate(y, a)
    places = section_4_state_form.output_matrix([0, 1, 2, 3, 4])
    steps = section_5_simulation.sub_steps(watch.error_matrix, STEP, reach=0.02)
    begin = np.append(found.states[0], found.road[0])
    states, road = section_5_simulation.observe(a, y, STEP, form, gains, places, steps, begin)
    assert np.abs(found.road - road).max() <= 1e-9 * np.abs(road).max()
    assert (np.abs(found.states - states).max(axis=0) <= 1e-9 * np.abs(states).max(axis=0)).all()


def test_a_trailer_at_rest_on_the_road_begins_on_it():
    model = Trailer().model()
    watch = UnknownInputObserver.of(
        model, STEP, default_gains(model, readings(model)), readings(model), 0.05
    )
    object.__setattr__(watch, "settling_s", 0.0)
    # Without a hitch the chassis may lie anywhere: here level, 20 mm higher than at first.
    found = watch.estimate(np.tile([0.02, 0.02, 0.02, 0.0, 0.0], (50, 1)), np.zeros((50, 2)))
    assert np.abs(found.road - 0.02).max() <= 1e-12


def shared_mass(couplings, tyres):
    freedoms = (Freedom("body", "z_s", "sprung"), Freedom("wheel", "z_u", "unsprung"))
    mass = np.array([[400.0, couplings], [couplings, 40.0]])
    return VehicleModel("odd car", freedoms, tyres, mass, np.eye(2), 1e5 * np.eye(2))


@pytest.mark.parametrize(
    "model",
    [
        shared_mass(1.0, (Tyre("wheel", 1e5),)),
        shared_mass(0.0, (Tyre("wheel", 5e4), Tyre("wheel", 5e4))),
    ],
)
def test_a_wheel_that_does_not_move_alone_is_refused(model):
    gains = default_gains(model, readings(model))
    with pytest.raises(InputError, match="the wheel has more than one tyre, or shares its mass"):
        UnknownInputObserver.of(model, STEP, gains, readings(model), 0.05)
