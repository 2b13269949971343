"""When a segment may be closed: what readings still to come can change in it."""

from collections.abc import Sequence

import numpy as np

from floatref.stages.kalman.segment import Segment
from floatref.stages.kalman.sigma import Settled, high_pass
from floatref.values.arrays import FloatArray, IndexArray


def influence(
    marks: Settled, latest: FloatArray, wanted: IndexArray, wavelength_m: float
) -> FloatArray:
    """Return by how much, 1-σ in m, readings to come can change the result at marks ``wanted``.

    They act through the state x_T at the last mark alone, of covariance ``latest``. Were it known,
    a height before it would change by E[e_j | e_T], of covariance w_j' P_T^-1 w_k with
    w = Psi P e_r, Psi the product of (I - K H) F from there to T; no reading can tell more. What
    counts is what HPF_B3x2 leaves of that: an error of the whole run's height is none.
    """
    from floatref.kernels import kalman_covariance

    reach = np.empty_like(marks.column)
    kalman_covariance.reach(marks.column, marks.passed, reach)
    weights = high_pass(marks.distance_m, wavelength_m, wanted)
    known = np.diag(latest) > 0
    passed = (weights @ reach)[:, known]
    inverse = np.linalg.inv(latest[np.ix_(known, known)])
    change: FloatArray = np.sqrt(np.einsum("ij,jk,ik->i", passed, inverse, passed))
    return change


def closing(
    segments: Sequence[Segment], behind: Settled | None, wavelength_m: float, tolerance_m: float
) -> int:
    """Return how many of ``segments`` nothing to come changes by ``tolerance_m``, 1-σ."""
    marks = Settled.of([segment.marks for segment in segments])
    ends = np.cumsum([len(segment.marks.at) for segment in segments]) - 1
    if behind is not None:
        ends += len(behind.at)
        marks = marks.behind(behind)
    latest = segments[-1].marks.covariance[-1]
    open_ends = influence(marks, latest, ends[:-1], wavelength_m) > tolerance_m
    return int(np.argmax(open_ends)) if open_ends.any() else len(segments) - 1
