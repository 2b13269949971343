"""The backward pass and its companions against the matrices that they stand for."""

from dataclasses import dataclass

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.estimators.models import kalman_values as kalman
from floatref.estimators.models import road_prior_values as road
from floatref.estimators.smoothing import backward
from floatref.estimators.smoothing.nodes import CORRECTION

STEP, BEFORE = 0.01, 5
laws = settings(deadline=None, max_examples=30)
SEEDS = st.integers(0, 2**32 - 1)
SIDES = list(CORRECTION.names)


@dataclass(frozen=True)
class Kalman:
    """The Kalman filter's nodes, whose lean or offset may begin anew."""

    values = kalman
    renewals = (0, 0, kalman.LEAN, kalman.OFFSET)

    @staticmethod
    def transition(node, span):
        """Return F, with what begins anew at the node."""
        F, J = np.eye(kalman.STATES), np.eye(kalman.STATES)
        F[0, 1], F[0, kalman.BIAS], F[1, kalman.BIAS] = span, span**2 / 2, span
        for name in kalman.TRANSITION.names:
            of, _, by = name.partition("_")
            F[getattr(kalman, of.upper()), getattr(kalman, by.upper())] = node["transition"][name]
        if node["renewed"] == kalman.LEAN:
            J[kalman.BIAS, kalman.LEAN], J[kalman.LEAN, kalman.LEAN] = node["shift"], 0.0
        if node["renewed"] == kalman.OFFSET:
            J[kalman.OFFSET] = -np.eye(kalman.STATES)[0]
        return J @ F

    @staticmethod
    def row(update):
        return update["row"]


@dataclass(frozen=True)
class Road:
    """The road prior's nodes, whose lean and tilt may begin anew."""

    values = road
    renewals = (0, 0, 1)

    @staticmethod
    def transition(node, span):
        """Return F, with what begins anew at the node."""
        F, J = np.eye(road.STATES), np.eye(road.STATES)
        F[0, 1], F[0, road.BIAS], F[1, road.BIAS] = span, -(span**2) / 2, -span
        F[0, road.LEAN], F[1, road.LEAN] = -node["lean_twice"], -node["lean_once"]
        F[0, road.TILT], F[1, road.TILT] = -node["tilt_twice"], -node["tilt_once"]
        # The clearance is the height less a road that fades and climbs.
        F[road.CLEARANCE] = F[0] - node["stays"] * np.eye(road.STATES)[0]
        F[road.CLEARANCE, road.CLEARANCE] = F[road.SLOPE, road.SLOPE] = node["stays"]
        F[road.CLEARANCE, road.SLOPE] = -node["climbs"]
        if node["renewed"]:
            J[road.LEAN, road.LEAN] = J[road.TILT, road.TILT] = 0.0
        return J @ F

    @staticmethod
    def row(update):
        row = np.zeros(road.STATES)
        row[road.CLEARANCE] = 1.0
        return row


models = pytest.mark.parametrize("model", [Kalman(), Road()], ids=["kalman", "road"])
COUNTS = st.integers(1, 6)


def filled(rng, count, fields):
    rows = np.zeros(count, fields)
    for name in fields.names:
        part = rows[name]
        if part.dtype.names:
            for inner in part.dtype.names:
                part[inner] = 0.5 * rng.normal(size=count)
        else:
            part[:] = 0.5 * rng.normal(size=part.shape)
    return rows


def drawn(model, seed, count):
    """Return nodes with what any filter might leave in them, and their updates."""
    rng = np.random.default_rng(seed)
    nodes = filled(rng, count, model.values.NODE)
    nodes["at"] = np.cumsum(rng.integers(1, 6, count)) + 7
    nodes["updated"] = np.cumsum(rng.integers(0, 4, count))
    nodes["renewed"] = rng.choice(model.renewals, count)
    return nodes, filled(rng, nodes["updated"][-1], model.values.UPDATE)


def covariance(model, node):
    p = np.zeros((model.values.STATES, model.values.STATES))
    p[np.triu_indices(model.values.STATES)] = node["covariance"]
    return p + np.triu(p, 1).T


def parts(model, nodes, updates):
    """Yield F, and the updates of every node."""
    first, done = BEFORE, 0
    for node in nodes:
        F = model.transition(node, (node["at"] - first) * STEP)
        yield F, updates[done : node["updated"]]
        first, done = node["at"], node["updated"]


@models
@pytest.mark.cites("(6.17)")
@laws
@given(seed=SEEDS, count=COUNTS)
def test_the_adjoint_goes_back_through_updates_and_transitions(model, seed, count):
    nodes, updates = drawn(model, seed, count)
    adjoint = np.random.default_rng(seed).normal(size=model.values.STATES)
    found, corrections = adjoint.copy(), np.empty(count, CORRECTION)
    backward.smooth(nodes, updates, BEFORE, STEP, found, corrections)
    expected = []
    steps = [*parts(model, nodes, updates)]
    for node, (F, done) in zip(nodes[::-1], steps[::-1], strict=True):
        behind = -(covariance(model, node) @ adjoint)[:2]
        jump = np.array([node["rise"], node["climb"]])
        expected.append([*(behind + jump), *behind])
        for update in done[::-1]:
            total = update["gain"] @ adjoint + update["innovation"]
            adjoint = adjoint - model.row(update) * total
        adjoint = F.T @ adjoint
    sides = np.stack([corrections[side] for side in SIDES], axis=1)
    np.testing.assert_allclose(sides, expected[::-1], rtol=1e-9, atol=1e-9)
    np.testing.assert_allclose(found, adjoint, rtol=1e-9, atol=1e-9)


@models
@laws
@given(seed=SEEDS, count=COUNTS, data=st.data())
def test_an_error_passes_on_through_the_closed_loop(model, seed, count, data):
    """Psi is the product of all (I - K H) F, and what is gathered the sum of Psi' H' H Psi / S."""
    nodes, updates = drawn(model, seed, count)
    last, states = count - 1, model.values.STATES
    wanted = [*sorted(data.draw(st.sets(st.integers(0, last - 1)))), last] if last else [0]
    passed, gathered = np.full((2, len(wanted), states, states), np.nan)
    backward.closed_loop(nodes, updates, BEFORE, STEP, np.array(wanted), passed, gathered)
    psi, sums, k = np.eye(states), np.zeros((states, states)), 0
    for number, (F, done) in enumerate(parts(model, nodes, updates)):
        psi = F @ psi
        for update in done:
            row = model.row(update)
            sums += np.outer(row @ psi, row @ psi) * update["information"]
            psi = psi - np.outer(update["gain"], row @ psi)
        if number == wanted[k]:
            scale = np.abs(psi).max() ** 2 + np.abs(sums).max()
            np.testing.assert_allclose(passed[k], psi, atol=1e-9 * scale)
            np.testing.assert_allclose(gathered[k], sums, atol=1e-9 * scale)
            psi, sums, k = np.eye(states), np.zeros((states, states)), k + 1
