"""When a segment may be closed: what readings still to come can change in it."""

from collections.abc import Sequence

import numpy as np

from floatref.stages.kalman.segment import Segment


def closing(segments: Sequence[Segment], tolerance_m: float) -> int:
    """Return how many of ``segments`` nothing to come changes by ``tolerance_m``, 1-σ.

    Readings to come act through the state x_T at the last node alone. Were it known, the height
    at a mark before it would change by E[e_r | e_T], of variance w' P_T^-1 w with w = Psi P e_r,
    Psi the product of (I - K H) F from there to T: no reading can do more.
    """
    latest = segments[-1].marks.covariance[-1]
    unknown = np.diag(latest) > 0
    inverse = np.linalg.inv(latest[np.ix_(unknown, unknown)])
    psi, closed = np.eye(len(latest)), 0
    for number in range(len(segments) - 2, -1, -1):
        for passed in segments[number + 1].marks.passed[::-1]:
            psi = psi @ passed
        w = psi @ segments[number].marks.covariance[-1][:, 0]
        settled = w[unknown] @ inverse @ w[unknown] <= tolerance_m**2
        closed = max(closed, number + 1) if settled else 0
    return closed
