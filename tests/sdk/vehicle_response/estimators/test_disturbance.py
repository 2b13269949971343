"""Process noise: forces that are white, and roads that do not hold."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref.vehicle_response import ZHU_HALF_CAR, Hold, QuarterCar, discretize, state_space
from floatref.vehicle_response.estimators.disturbance import disturbance_of, hold_error_of

FEW = settings(deadline=None, max_examples=15)
MODEL = QuarterCar(700.0, 75.0, 45e3, 3300.0, 320e3).model()
STEPS = st.floats(1e-4, 0.02)


def pieces(model, step, count):
    """What a force of 1 N in each of ``count`` pieces of a step has done at its end."""
    size = len(model.freedoms)
    pushed = np.vstack([np.zeros((size, size)), np.linalg.inv(model.mass)])
    once = discretize(model, step / count).transition
    along = [np.eye(2 * size)]
    for _ in range(count - 1):
        along.append(once @ along[-1])
    # Half a piece, to second order, is what lies between the middle and the end.
    half = discretize(model, step / count / 2).transition
    return np.array([m @ half for m in along[::-1]]), pushed


@FEW
@given(step=STEPS, sizes=st.tuples(st.floats(0.0, 50.0), st.floats(0.1, 50.0)))
@pytest.mark.parametrize("model", [MODEL, ZHU_HALF_CAR.model()], ids=lambda m: m.name)
def test_white_forces_add_up_over_the_step(model, step, sizes):
    names = model.freedoms[0].name, model.freedoms[-1].name
    found = disturbance_of(model, step, dict(zip(names, sizes, strict=True)))
    along, pushed = pieces(model, step, 200)
    squares = np.zeros(len(model.freedoms))
    squares[[0, -1]] = np.square(sizes)
    each = along @ (pushed * squares @ pushed.T) @ along.transpose(0, 2, 1)
    scale = np.sqrt(np.diag(found))
    scale = np.where(scale > 0, scale, 1.0)
    expected = each.sum(axis=0) * step / 200
    np.testing.assert_allclose(
        found / scale / scale[:, None], expected / scale / scale[:, None], atol=2e-3
    )


@FEW
@given(step=STEPS, parts=st.integers(2, 6))
def test_two_steps_are_one_that_is_as_long(step, parts):
    densities = {"body": 5.0, "wheel": 20.0}
    short, total = disturbance_of(MODEL, step / parts, densities), 0.0
    once = discretize(MODEL, step / parts).transition
    for _ in range(parts):
        total = once @ total @ once.T + short if np.ndim(total) else short
    np.testing.assert_allclose(disturbance_of(MODEL, step, densities), total, rtol=1e-8)


@pytest.mark.cites("(15) of Zhu")
@FEW
@given(step=st.floats(20.0, 1000.0))
def test_after_a_long_step_it_stands_still(step):
    """What comes in is what is damped: A·Q + Q·Aᵀ + W = 0."""
    found = disturbance_of(MODEL, step, {"body": 5.0, "wheel": 20.0})
    a, _ = state_space(MODEL)
    damped = a @ found + found @ a.T
    wanted = np.diag([0.0, 0.0, (5.0 / 700.0) ** 2, (20.0 / 75.0) ** 2])
    scale = np.sqrt(np.diag(found))
    flow = np.abs(a) @ np.outer(scale, scale)
    assert (np.abs(damped + wanted) <= 1e-9 * (flow + flow.T)).all()


@pytest.mark.parametrize("hold", Hold)
def test_a_walking_force_errs_from_its_hold_by_what_is_told(hold):
    """Drawn walks of class D at 20 m/s, in 50 pieces of a step, against their hold."""
    step, pieces_of, rng = 0.004, 50, np.random.default_rng(4)
    rate = (2 * np.pi * 0.1) ** 2 * 1024e-6 * 20.0 / 2
    moves = rng.normal(size=(4000, pieces_of)) * 320e3 * np.sqrt(rate * step / pieces_of)
    walk = np.hstack([np.zeros((4000, 1)), moves.cumsum(axis=1)])
    fine = discretize(MODEL, step / pieces_of, Hold.FIRST_ORDER)
    state = np.zeros((4000, 4))
    for before, after in zip(walk.T[:-1], walk.T[1:], strict=True):
        state = (
            state @ fine.transition.T + np.outer(before, fine.before) + np.outer(after, fine.after)
        )
    coarse = discretize(MODEL, step, hold)
    error = state - np.outer(walk[:, -1], coarse.after)
    spread = np.sqrt(np.diag(hold_error_of(MODEL, step, 20.0, "D", hold)))
    # The wheel's velocity, which the force reaches first; the mean square of 4000 is within 7 %.
    assert error[:, 3].std() == pytest.approx(spread[3], rel=0.1)


def test_a_class_is_four_times_the_one_before_and_speed_counts_once():
    once = hold_error_of(MODEL, 0.005, 10.0, "B")
    np.testing.assert_allclose(hold_error_of(MODEL, 0.005, 10.0, "C"), 4 * once)
    np.testing.assert_allclose(hold_error_of(MODEL, 0.005, 20.0, "B"), 2 * once)


@pytest.mark.parametrize(
    ("call", "says"),
    [
        (lambda: disturbance_of(MODEL, 0.0, {}), "time step of 0 s"),
        (lambda: disturbance_of(MODEL, 0.1, {"roof": 1.0}), "no freedom 'roof'; it has body"),
        (lambda: disturbance_of(MODEL, 0.1, {"body": -1.0}), "force on the body is -1"),
        (lambda: disturbance_of(MODEL, 0.1, {"body": np.nan}), "force on the body is nan"),
        (lambda: hold_error_of(MODEL, 0.1, 10.0, "J"), "class J: unknown; choose one of A to H"),
        (lambda: hold_error_of(MODEL, 0.1, 0.0, "A"), "a speed of 0 m/s"),
        (lambda: hold_error_of(MODEL, -0.1, 10.0, "A"), "time step of -0.1 s"),
    ],
)
def test_what_cannot_be_is_refused_in_one_line(call, says):
    with pytest.raises(InputError, match=says) as raised:
        call()
    assert "\n" not in str(raised.value)
