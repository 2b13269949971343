"""When a segment may be closed: what readings still to come can change in it."""

from collections.abc import Sequence

import numpy as np

from floatref.kernels.kalman_layout import SPREAD, STATES
from floatref.stages.kalman.segment import Segment
from floatref.values.arrays import FloatArray


def covariance(node: FloatArray) -> FloatArray:
    """Return P of the row ``node``, shape (9, 9)."""
    p = np.zeros((STATES, STATES))
    upper = np.triu_indices(STATES)
    p[upper] = node[SPREAD:]
    p.T[upper] = node[SPREAD:]
    return p


def closing(segments: Sequence[Segment], tolerance_m: float) -> int:
    """Return how many of ``segments`` nothing to come changes by ``tolerance_m``, 1-σ.

    Readings to come act through the state x_T at the last node alone. Were it known, the height
    at a node before it would change by E[e_r | e_T], of variance w' P_T^-1 w with w = Psi P e_r,
    Psi the product of (I - K H) F from there to T: no reading can do more.
    """
    latest = covariance(segments[-1].nodes.nodes[-1])
    unknown = np.diag(latest) > 0
    latest = latest[np.ix_(unknown, unknown)]
    closed = 0
    for number in range(len(segments) - 1):
        w = covariance(segments[number].nodes.nodes[-1])[:, 0]
        for later in segments[number + 1 :]:
            w = later.passed @ w
        w = w[unknown]
        if w @ np.linalg.solve(latest, w) > tolerance_m**2:
            break
        closed = number + 1
    return closed
