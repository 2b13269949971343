"""Invariant zeros against motions that are known to leave every reading at zero."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.vehicle_response import Hold, Kind, QuarterCar, Reading, discretize, output_matrices
from floatref.vehicle_response.estimators.observability import (
    lasting_motions,
    null_space,
    unseen_modes,
)

CORNER = QuarterCar(700.0, 75.0, 45e3, 3300.0, 320e3).model()


def system_of(readings, step_s=0.005, hold=Hold.ZERO_ORDER):
    system = discretize(CORNER, step_s, hold)
    output, direct = output_matrices(CORNER, readings)
    return system, output, system.feedthrough(output, direct)


def wheel(kind):
    return Reading(kind, "wheel", 1.0)


@settings(deadline=None, max_examples=25)
@given(seed=st.integers(0, 2**32 - 1))
def test_units_do_not_decide_what_is_nothing(seed):
    rng = np.random.default_rng(seed)
    deficient = rng.normal(size=(6, 3)) @ rng.normal(size=(3, 5))
    rows, columns = 10.0 ** rng.uniform(-12, 12, (6, 1)), 10.0 ** rng.uniform(-12, 12, 5)
    untold = null_space(rows * deficient * columns)
    assert untold.shape == (5, 2)
    size = np.abs(columns[:, None] * untold).max()
    np.testing.assert_allclose(deficient @ (columns[:, None] * untold), 0.0, atol=1e-9 * size)
    assert null_space(rows * np.vstack([np.diag(columns), columns])).size == 0


@pytest.mark.parametrize("hold", list(Hold))
@pytest.mark.parametrize("step_s", [0.0005, 0.005, 0.05])
def test_an_accelerometer_alone_leaves_a_lifted_road_untold(hold, step_s):
    system, output, direct = system_of([wheel(Kind.ACCELERATION)], step_s, hold)
    found = lasting_motions(system, output, direct)
    zero, motion = found[0]
    assert zero == 1.0
    state, force = motion[:4, 0] + system.after @ motion[4:, 0], motion[4, 0]
    np.testing.assert_allclose(state / state[0], [1.0, 1.0, 0.0, 0.0], atol=1e-6)
    assert force / state[0] == pytest.approx(320e3)


def test_every_motion_that_is_found_is_one():
    system, output, direct = system_of([wheel(Kind.ACCELERATION)], 0.05, Hold.FIRST_ORDER)
    found = lasting_motions(system, output, direct)
    assert max(abs(zero) for zero, _ in found) > 2.0
    for zero, motion in found:
        state, force = motion[:4], motion[4:]
        after = system.transition @ state + system.input @ force
        size = np.abs(motion).max()
        np.testing.assert_allclose(after, zero * state, atol=1e-12 * size)
        np.testing.assert_allclose(output @ state + direct @ force, 0.0, atol=1e-9 * size)


def test_a_displacement_leaves_none():
    assert not lasting_motions(*system_of([wheel(Kind.ACCELERATION), wheel(Kind.DISPLACEMENT)]))


def test_a_free_body_is_unseen_by_its_own_velocity():
    loose = discretize(QuarterCar(700.0, 75.0, 45e3, 3300.0, 1e-9).model(), 0.005)
    output = np.array([[0.0, 0.0, 1.0, 0.0]])
    modes = unseen_modes(loose, output)
    assert modes
    for mode in modes:
        np.testing.assert_allclose(mode[0], mode[1], rtol=1e-6)
    assert not unseen_modes(loose, np.array([[1.0, 0.0, 0.0, 0.0]]))
