"""The backward pass and its companions against the matrices that they stand for."""

import numpy as np
import pytest
from floatref.kernels.kalman_layout import BIAS, LEAN, OFFSET, STATES
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.kernels import kalman_backward
from floatref.kernels import kalman_layout as layout

STEP = 0.01
TURNED = [2, 3, 5, 6]
"""Pitch, roll and the biases of the gyros, by which the composed rows go."""
laws = settings(deadline=None, max_examples=30)
SEEDS = st.integers(0, 2**32 - 1)
RENEWED = st.lists(st.sampled_from([0, 0, LEAN, OFFSET]), min_size=1, max_size=6)


def drawn(seed, renewed):
    """Return nodes with what any filter might leave in them, and their updates."""
    rng = np.random.default_rng(seed)
    count = len(renewed)
    last = np.cumsum(rng.integers(1, 6, count)) + 7
    ends = np.cumsum(rng.integers(0, 4, count))
    nodes = 0.5 * rng.normal(size=(count, layout.NODE))
    nodes[:, layout.RENEWED] = renewed
    updates = 0.5 * rng.normal(size=(ends[-1], layout.UPDATE))
    return np.column_stack((last, ends)), nodes, updates


def transition(node, span):
    """Return F, with what begins anew at the node."""
    F, J = np.eye(STATES), np.eye(STATES)
    F[0, 1], F[0, BIAS], F[1, BIAS] = span, span**2 / 2, span
    for row in range(4):
        F[row, TURNED] = node[4 * row : 4 * row + 4]
    F[:2, LEAN] = node[16:18]
    if node[layout.RENEWED] == LEAN:
        J[BIAS, LEAN], J[LEAN, LEAN] = node[layout.SHIFT], 0.0
    if node[layout.RENEWED] == OFFSET:
        J[OFFSET] = -np.eye(STATES)[0]
    return J @ F


def covariance(node):
    p = np.zeros((STATES, STATES))
    p[np.triu_indices(STATES)] = node[layout.SPREAD :]
    return p + np.triu(p, 1).T


def parts(at, nodes, updates, before):
    """Yield F, and the updates with their rows and gains, of every node."""
    first, done = before, 0
    for (sample, end), node in zip(at, nodes, strict=True):
        F = transition(node, (sample - first) * STEP)
        yield F, [(u, u[:STATES], u[STATES : 2 * STATES]) for u in updates[done:end]]
        first, done = sample, end


@pytest.mark.cites("(6.17)")
@laws
@given(seed=SEEDS, renewed=RENEWED)
def test_the_adjoint_goes_back_through_updates_and_transitions(seed, renewed):
    at, nodes, updates = drawn(seed, renewed)
    adjoint = np.random.default_rng(seed).normal(size=STATES)
    found, corrections = adjoint.copy(), np.empty((len(at), 4))
    kalman_backward.smooth(at, nodes, updates, 5, STEP, found, corrections)
    expected = []
    for node, (F, done) in zip(nodes[::-1], [*parts(at, nodes, updates, 5)][::-1], strict=True):
        behind = -(covariance(node) @ adjoint)[:2]
        expected.append([*(behind + node[layout.JUMP : layout.JUMP + 2]), *behind])
        for update, row, gain in done[::-1]:
            adjoint = adjoint - row * (gain @ adjoint + update[layout.INNOVATION])
        adjoint = F.T @ adjoint
    np.testing.assert_allclose(corrections, expected[::-1], rtol=1e-9, atol=1e-9)
    np.testing.assert_allclose(found, adjoint, rtol=1e-9, atol=1e-9)


@laws
@given(seed=SEEDS, renewed=RENEWED, data=st.data())
def test_an_error_passes_on_through_the_closed_loop(seed, renewed, data):
    """Psi is the product of all (I - K H) F, and what is gathered the sum of Psi' H' H Psi / S."""
    at, nodes, updates = drawn(seed, renewed)
    last = len(at) - 1
    wanted = [*sorted(data.draw(st.sets(st.integers(0, last - 1)))), last] if last else [0]
    passed, gathered = np.full((2, len(wanted), STATES, STATES), np.nan)
    kalman_backward.closed_loop(at, nodes, updates, 5, STEP, np.array(wanted), passed, gathered)
    psi, sums, k = np.eye(STATES), np.zeros((STATES, STATES)), 0
    for number, (F, done) in enumerate(parts(at, nodes, updates, 5)):
        psi = F @ psi
        for update, row, gain in done:
            sums += np.outer(row @ psi, row @ psi) * update[layout.INNOVATION + 1]
            psi = psi - np.outer(gain, row @ psi)
        if number == wanted[k]:
            scale = np.abs(psi).max() ** 2 + np.abs(sums).max()
            np.testing.assert_allclose(passed[k], psi, atol=1e-9 * scale)
            np.testing.assert_allclose(gathered[k], sums, atol=1e-9 * scale)
            psi, sums, k = np.eye(STATES), np.zeros((STATES, STATES)), k + 1
