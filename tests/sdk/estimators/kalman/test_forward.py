"""The forward pass between two samples and at one, against (6.47), (6.48) and appendix C."""

from dataclasses import replace
from typing import NamedTuple

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.estimators.kalman import forward
from floatref.estimators.kalman.noise import Noise
from floatref.estimators.kalman.references import Plan
from floatref.estimators.kalman.track import TrackFilter
from floatref.estimators.models import kalman_values as values
from floatref.estimators.models.kalman_values import DRIFT, HEIGHT, KINDS, OFFSET, STATES, TRUSTED
from floatref.values.arrays import new_record
from floatref_reference.appendix_c.process_model import matrix_a, matrix_q, matrix_w
from floatref_reference.chapter_6.section_6_1_3_multi_rate import multi_rate_update
from floatref_reference.chapter_6.section_6_3_6_system import f, h

G, STEP, ARM = 9.80665, 1 / 500, (0.8, -0.5, 1.6)
laws = settings(deadline=None, max_examples=25)
SEEDS = st.integers(0, 2**32 - 1)
UPPER = (slice(None), *np.triu_indices(STATES))
SCALES = np.array([1.0, 0.5, 0.05, 0.05, 0.1, 0.01, 0.01, 0.01, 0.1, 0.1])
STILL = Noise(**dict.fromkeys(vars(Noise()), 0.0))
NOISES = st.sampled_from([Noise(), STILL, Noise(acceleration=0.1, pitch_rate=1e-2)])


class Out(NamedTuple):
    x: np.ndarray
    p: np.ndarray
    memory: np.record
    height: np.ndarray
    nodes: np.ndarray
    updates: np.ndarray


def run(u, x, p, at=(), marks=(), rows=(), noise=STILL, sub_block=5, step=STEP):
    """Run the kernel over inputs ``u`` (n, 6), with gravity, from the state ``x``."""
    state = values.Filter(x.copy(), p.copy(), new_record(values.MEMORY))
    nodes = np.empty(len(u) // sub_block + len(at) + 2, values.NODE)
    out = values.Output(np.empty(len(u)), nodes, np.empty(KINDS * len(at), values.UPDATE))
    inputs = values.Inputs(0, *map(np.ascontiguousarray, (u - [0, 0, G, 0, 0, 0]).T))
    rows = np.array(rows).reshape(len(at), 2 * KINDS + 1)
    y, variances = np.ascontiguousarray(rows[:, :KINDS]), np.ascontiguousarray(rows[:, KINDS:-1])
    times = np.array(at, np.int64), np.array(marks, np.int64)
    observations = values.Observations(*times, y, variances, rows[:, -1].copy())
    count = forward.run(model_of(noise, sub_block, step), inputs, observations, state, out)
    updates = out.updates[: nodes["updated"][count - 1]]
    return Out(*state, out.height, nodes[:count], updates)


def model_of(noise, sub_block, step=STEP):
    model = TrackFilter.of(Plan(), noise, step, ARM, 0.0).model
    return model._replace(sub_block=sub_block)


def drawn(seed, count=6, turning=1.0):
    rng = np.random.default_rng(seed)
    size = np.array([5.0, 3.0, 4.0, *[turning] * 3])
    u = size * rng.uniform(-1, 1, (1, 6)) + 0.1 * size * rng.uniform(-1, 1, (count, 6))
    u[:, 2] += G
    root = rng.normal(size=(STATES, STATES))
    p = SCALES[:, None] * (root @ root.T) * SCALES
    return u, SCALES * rng.uniform(-1, 1, STATES), p


def relative(p, to=None):
    spread = np.diag(p if to is None else to)
    scale = np.sqrt(np.where(spread > 0, spread, 1.0))
    return p / np.outer(scale, scale)


def carried(x, u):
    """Return the state after all steps by (6.47), the inputs of a step the means of its ends."""
    found = x[:7]
    for mean in (u[:-1] + u[1:]) / 2:
        found = f(found, mean, STEP)
        surge = mean[0] * x[7]
        found = found + surge * np.array([STEP**2 / 2, STEP, 0, 0, 0, 0, 0])
    return np.concatenate((found, x[7:]))


@pytest.mark.slow
@pytest.mark.cites("(6.9)", "(6.47)")
@laws
@given(seed=SEEDS)
def test_the_state_goes_from_sample_to_sample(seed):
    u, x, p = drawn(seed)
    np.testing.assert_allclose(run(u, x, p).x, carried(x, u), rtol=0, atol=1e-10)


@pytest.mark.cites("(6.10)", "(C.3)", "(C.4)")
@laws
@given(seed=SEEDS)
def test_the_composed_transition_is_the_derivative_of_the_whole_sub_block(seed):
    u, x, p = drawn(seed)
    reach = 1e-6 * SCALES
    ends = [[carried(x + sign * dx, u) for dx in np.diag(reach)] for sign in (1, -1)]
    F = np.subtract(*ends).T / (2 * reach)
    np.testing.assert_allclose(relative(run(u, x, p).p), relative(F @ p @ F.T), atol=1e-5)


@pytest.mark.cites("(6.10)", "(C.5)", "(C.6)")
@laws
@given(seed=SEEDS, case=st.sampled_from([(0.0, 0.0, 1e-9), (0.0, 1.0, 1e-3), (0.3, 1.0, 0.02)]))
def test_the_noise_of_a_sub_block_is_that_of_its_steps(seed, case):
    """But for the walks of the gyros' biases within it, and for changing sensitivities."""
    turning, walking, within = case
    u, x, _ = drawn(seed, turning=turning)
    u[:] = u[0]
    x[5:] = 0.0
    usual = Noise()
    walks = walking * usual.roll_rate_walk, walking * usual.pitch_rate_walk
    noise = replace(usual, roll_rate_walk=walks[0], pitch_rate_walk=walks[1])
    white = np.array([noise.acceleration, noise.roll_rate, noise.pitch_rate, noise.yaw_rate])
    walk = np.array([noise.acceleration_walk, noise.roll_rate_walk, noise.pitch_rate_walk])
    Q = matrix_q(np.concatenate((white / STEP**0.5, walk * STEP**0.5)))
    P, state = np.zeros((7, 7)), x[:7]
    for mean in u[1:]:
        A, W = matrix_a(state, mean, STEP), matrix_w(state, STEP)
        P, state = A @ P @ A.T + W @ Q @ W.T, f(state, mean, STEP)
    found = run(u, x, np.zeros((STATES, STATES)), noise=noise).p[:7, :7]
    np.testing.assert_allclose(relative(found, P), relative(P), atol=within)


def observed(x, p, y, variance, mark=0, noise=STILL, moved=0.0):
    """Observe ``y`` at a single sample at which the body turns."""
    u = np.array([[0.3, 0.2, G, 0.4, -0.3, 0.2]])
    row = np.concatenate((y, variance, [moved]))
    return run(u, x, p, [0], [mark], [row], noise), u[0]


@pytest.mark.cites("(6.13)", "(6.16)")
@laws
@given(seed=SEEDS, lost=st.sets(st.integers(0, 3)), size=st.sampled_from([1e-6, 1.0, 1e3]))
def test_one_reading_after_the_other_is_the_update_by_all(seed, lost, size):
    _, x, p = drawn(seed)
    tiny, u = observed(x, 1e-12 * p, np.zeros(KINDS), np.ones(KINDS), TRUSTED)
    H, expected = tiny.updates["row"], h(x[:7], u, ARM)
    expected[0] += x[DRIFT]
    y = expected + 0.01
    y[list(lost)] = np.nan
    variance = size * np.array([0.012, 0.03, 0.002, 0.003]) ** 2
    out, _ = observed(x, p, y, variance, TRUSTED)
    state, P = multi_rate_update(x, p, y, expected, H, np.diag(variance))
    np.testing.assert_allclose((out.x - state) / SCALES, 0.0, atol=1e-8)
    np.testing.assert_allclose((out.p - P) / np.outer(SCALES, SCALES), 0.0, atol=1e-8)


def test_a_held_height_is_the_antennas_and_a_reflected_one_the_reference_points():
    _, x, p = drawn(3)
    height = np.array([0.01, np.nan, np.nan, np.nan])
    held, _ = observed(x, p, height, np.ones(KINDS), values.RELATIVE | values.CAPTURE | TRUSTED)
    assert held.updates["row"][0, DRIFT] == held.updates["row"][0, OFFSET] == 0.0
    innovation = held.updates["innovation"] / held.updates["information"]
    assert innovation == pytest.approx(0.01, abs=1e-12)
    risen, _ = observed(x, p, height, np.ones(KINDS), values.REFLECTED | values.RENEW | TRUSTED)
    assert np.flatnonzero(risen.updates["row"][0]).tolist() == [HEIGHT, OFFSET]
    innovation = risen.updates["innovation"] / risen.updates["information"]
    assert innovation == pytest.approx(0.01, abs=1e-12)
    assert risen.updates["information"] == pytest.approx(1.0)


@laws
@given(kind=st.integers(0, 3), off=st.floats(0.05, 50.0), trusted=st.booleans())
def test_a_wild_reading_is_left_out_unless_it_is_trusted(kind, off, trusted):
    """Wild is beyond ten times the expected deviation and beyond what a vehicle does."""
    x, p = np.zeros(STATES), np.diag(np.square(1e-3 * SCALES))
    y = np.full(KINDS, np.nan)
    y[kind] = off + (ARM[2] if kind == 0 else 0.0)
    row = np.concatenate((y, np.full(KINDS, 1e-4), [0.0]))
    mark = TRUSTED if trusted else 0
    out = run(np.array([[0.0, 0, G, 0, 0, 0]]), x, p, [0], [mark], [row])
    floor = [0.2, 0.5, np.radians(3.0), np.radians(3.0)][kind]
    wild = off > floor and off > 0.11 and not trusted
    assert len(out.updates) == (0 if wild else 1)
    assert out.memory.rejected[kind] == wild
    assert np.array_equal(out.x, x) == wild


def test_heights_that_insist_are_another_datum():
    """Left out as often as needed, they move the drift and not the height."""
    count, leap = values.BELIEVED_AT + 30, 5.0
    u = np.tile([0.0, 0, G, 0, 0, 0], (count, 1))
    row = np.array([ARM[2] + leap, *[np.nan] * 3, *[1e-4] * 4, 0.0])
    p = np.diag(np.square(1e-3 * SCALES))
    out = run(u, np.zeros(STATES), p, range(count), [0] * count, [row] * count, sub_block=1)
    assert count - len(out.updates) == out.memory.rejected[HEIGHT] == values.BELIEVED_AT - 1
    assert out.x[DRIFT] == pytest.approx(leap, abs=1e-3)
    assert np.abs(out.height).max() < 1e-3


@laws
@given(seed=SEEDS, noise=NOISES, size=st.sampled_from([1e-8, 1e-4, 10.0]), data=st.data())
def test_the_covariance_stays_one(seed, noise, size, data):
    """At every node it is symmetric, and no variance of any direction is negative."""
    rng = np.random.default_rng(seed)
    u, x, _ = drawn(seed, count=60)
    held = values.RELATIVE | values.CAPTURE | TRUSTED
    marks = [0, TRUSTED, held, values.REFLECTED | TRUSTED, values.REFLECTED | values.RENEW]
    at = sorted(data.draw(st.sets(st.integers(0, 59), min_size=1, max_size=30)))
    chosen = rng.choice(marks, len(at))
    rows = np.hstack([0.01 * rng.normal(size=(len(at), 4)), np.full((len(at), 4), size)])
    rows = np.hstack([rows, rng.choice([0.0, 1e-6, 1e4], (len(at), 1))])
    out = run(u, x, np.diag(np.square(SCALES)), at, chosen, rows, noise)
    spread = np.empty((len(out.nodes), STATES, STATES))
    spread.transpose(0, 2, 1)[UPPER] = spread[UPPER] = out.nodes["covariance"]
    np.testing.assert_array_equal(spread[-1], out.p)
    for p in spread:
        spread = np.diag(np.diag(p) + 1e-8 * SCALES**2)
        assert np.linalg.eigvalsh(relative(p, spread)).min() > -1e-3


@laws
@given(seed=SEEDS)
def test_what_is_known_without_noise_is_not_moved_by_any_reading(seed):
    u, x, p = drawn(seed, count=20)
    rows = [np.concatenate((np.ones(KINDS), np.full(KINDS, 1e-6), [0.0]))] * 4
    out = run(u, x, 0.0 * p, [0, 3, 8, 19], [TRUSTED] * 4, rows)
    assert not out.p.any()
    np.testing.assert_allclose(out.height, run(u, x, 0.0 * p).height, rtol=0, atol=1e-12)


@laws
@given(length=st.integers(1, 23), sub_block=st.integers(1, 7))
def test_the_last_sample_becomes_a_node_unless_it_is_one(length, sub_block):
    u, x, p = drawn(5, count=length)
    out = run(u, x, p, sub_block=sub_block, noise=Noise())
    nodes, state = np.empty(1, values.NODE), values.Filter(out.x, out.p, out.memory)
    made = forward.end(model_of(Noise(), sub_block), state, nodes)
    assert made == (0 if (length - 1) % sub_block == 0 else 1)
    assert out.nodes["at"].tolist() == list(range(0, length, sub_block))
    if made:
        assert (nodes["at"][0], nodes["updated"][0]) == (length - 1, 0)
        every = run(u, x, p, sub_block=length - 1, noise=Noise())
        np.testing.assert_allclose(relative(out.p), relative(every.p), atol=1e-4)
