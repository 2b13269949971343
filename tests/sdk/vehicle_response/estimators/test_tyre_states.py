"""The road as a state of a tyre with damping is the solution of F = k·u + c·u'."""

from decimal import Decimal, localcontext

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import solve_ivp

from floatref.vehicle_response import Hold, QuarterCar, discretize
from floatref.vehicle_response.estimators.joint_filter import with_tyre_states

FEW = settings(deadline=None, max_examples=15)


def car(damping):
    return QuarterCar(700.0, 75.0, 45e3, 3300.0, 320e3, damping).model()


@FEW
@given(
    damping=st.floats(50.0, 1e7),
    force=st.tuples(st.floats(-1e4, 1e4), st.floats(-1e4, 1e4)),
    first=st.floats(-0.1, 0.1),
    hold=st.sampled_from(Hold),
)
def test_a_step_is_the_solution_for_a_force_that_changes_linearly(damping, force, first, hold):
    model, step = car(damping), 0.005
    found = with_tyre_states(model, discretize(model, step, hold))
    x = found.transition[4] @ [0, 0, 0, 0, first]
    x += found.before[4, 0] * force[0] + found.after[4, 0] * force[1]

    def rate(t, u):
        return (force[0] + (force[1] - force[0]) * t / step - 320e3 * u) / damping

    right = solve_ivp(rate, (0.0, step), [first], rtol=1e-9, atol=1e-12, method="LSODA").y[0, -1]
    assert abs(x - right) <= 1e-8


@FEW
@given(hold=st.sampled_from(Hold))
def test_a_tyre_without_damping_adds_none_and_the_vehicle_stays_as_it_is(hold):
    plain = discretize(car(0.0), 0.005, hold)
    assert with_tyre_states(car(0.0), plain).transition.shape == (4, 4)
    damped = discretize(car(100.0), 0.005, hold)
    found = with_tyre_states(car(100.0), damped)
    np.testing.assert_array_equal(found.transition[:4, :4], damped.transition)
    np.testing.assert_array_equal(found.input[:4], damped.input)
    assert not found.transition[:4, 4].any()
    assert not found.transition[4, :4].any()


@FEW
@given(damping=st.floats(2.0, 15.0).map(lambda x: 10.0**x))
def test_a_slow_tyre_loses_no_digits(damping):
    """What 1 N after the step gives is (1 - (1 - exp(-s))/s)/k, here with 60 digits."""
    model = car(damping)
    found = with_tyre_states(model, discretize(model, 0.005)).after[4, 0]
    with localcontext() as context:
        context.prec = 60
        steps = 320_000 * Decimal("0.005") / Decimal(damping)
        right = float((1 - (1 - (-steps).exp()) / steps) / 320_000)
    assert found == pytest.approx(right, rel=1e-9, abs=0.0)
