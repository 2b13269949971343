"""Steps (a)-(c) in loops, against the same in products and inverses of matrices."""

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from floatref.vehicle_response.estimators.joint_kernel import joint_input_state
from floatref.vehicle_response.estimators.joint_values import Estimates, Memory, System

laws = settings(deadline=None, max_examples=25)
SEEDS = st.integers(0, 2**32 - 1)
SIZES = st.tuples(st.integers(1, 6), st.integers(1, 3), st.integers(0, 4))


def drawn(seed, states, inputs, more):
    """A drawn system in no unit, with a reading for each input and ``more``, and samples."""
    rng = np.random.default_rng(seed)
    readings = inputs + more
    transition = rng.normal(size=(states, states))
    transition *= 0.9 / np.abs(np.linalg.eigvals(transition)).max()
    direct = rng.normal(size=(readings, inputs)) + 3 * np.eye(readings, inputs)
    output = rng.normal(size=(readings, states)) / 10
    after = rng.normal(size=(states, inputs)) / 10
    root = rng.normal(size=(states, states)) / 3
    system = System(
        transition,
        rng.normal(size=(states, inputs)) / 3,
        output,
        direct,
        direct + output @ after,
        rng.uniform(0.1, 1.0, readings),
        root @ root.T,
        after,
        rng.uniform(1.0, 4.0, inputs),
        rng.uniform(0.0, 1.0),
    )
    return system, rng.normal(size=(40, readings))


def started(system):
    states, inputs = system.after.shape
    parts = np.zeros(states), np.eye(states), np.zeros(inputs)
    return Memory(*parts, np.zeros((inputs, inputs)), np.zeros((states, inputs)))


def run(system, samples):
    states, inputs = system.after.shape
    out = Estimates(*(np.full((len(samples), s), 9.0) for s in (inputs, inputs, states, states)))
    done = joint_input_state(samples, system, started(system), out)
    assert done == len(samples)
    return out


def written_out(system, samples):
    """What the kernel promises, by inverses; and the largest condition number of one of them."""
    worst = 1.0
    a, b, after = system.transition, system.influence, system.after
    x, p, f, crossed = started(system).state, np.eye(len(a)), np.zeros(b.shape[1]), 0 * b
    rows = []
    for z in samples:
        on = np.isfinite(z)
        g, j, r = system.output[on], system.feedthrough[on], np.diag(system.variance[on])
        seen = np.linalg.matrix_rank(system.direct[on]) == b.shape[1]
        if seen:
            tilde = np.linalg.inv(g @ p @ g.T + r)
            worst = max(worst, np.linalg.cond(j.T @ tilde @ j))
            spread = np.linalg.inv(j.T @ tilde @ j)
            f = spread @ j.T @ tilde @ (z[on] - g @ x)
            gain = p @ g.T @ tilde
            x = x + gain @ (z[on] - g @ x - j @ f)
            p = p - gain @ (g @ p @ g.T + r - j @ spread @ j.T) @ gain.T
            crossed = -gain @ j @ spread
        else:
            spread = np.diag(system.unknown)
        both = np.hstack([np.eye(len(a)), after])
        joint = np.block([[p, crossed], [crossed.T, spread]])
        missing = np.where(seen, 1.0, np.nan)
        variance = np.diag(both @ joint @ both.T)
        rows.append((missing * f, missing * np.diag(spread), x + after @ f, variance))
        ahead = np.hstack([a, b])
        x, p = a @ x + b @ f, ahead @ joint @ ahead.T + system.disturbance
        crossed = 0 * b if seen else system.stays * (a @ crossed + b @ spread)
    return [np.array(part) for part in zip(*rows, strict=True)], worst


@pytest.mark.slow
@given(seed=SEEDS, sizes=SIZES, gone=st.floats(0.0, 0.6))
@laws
def test_it_is_steps_a_to_c_of_the_readings_that_are_there(seed, sizes, gone):
    system, samples = drawn(seed, *sizes)
    rng = np.random.default_rng(seed + 1)
    samples[rng.random(samples.shape) < gone] = rng.choice([np.nan, np.inf])
    out, (expected, worst) = run(system, samples), written_out(system, samples)
    # An inverse of a worse matrix has lost more than seven of its sixteen digits by itself.
    assume(worst < 1e7)
    for found, right in zip(out, expected, strict=True):
        scale = 1.0 + np.nanmax(np.abs(right), initial=0.0)
        np.testing.assert_allclose(found, right, rtol=0, atol=1e-9 * scale)


def test_it_stops_where_the_covariance_is_no_longer_finite():
    system, samples = drawn(1, 2, 1, 1)
    samples[:] = np.nan
    growing = system._replace(transition=10.0 * np.eye(2))
    out = Estimates(*(np.zeros((400, s)) for s in (1, 1, 2, 2)))
    done = joint_input_state(np.full((400, 2), np.nan), growing, started(growing), out)
    # P grows by 100 a step, up to the largest number, 1.8e308.
    assert 150 <= done <= 158
