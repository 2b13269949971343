"""When a segment may be closed: what readings still to come can change in it."""

from collections.abc import Sequence

import numpy as np

from floatref.estimators.smoothing.segment import Segment
from floatref.estimators.smoothing.sigma import Settled, high_pass
from floatref.values.arrays import FloatArray, IndexArray

SMALLEST = 1e-10
"""Directions of so small a variance, relative, are known as they are."""


def influence(
    marks: Settled, latest: FloatArray, seen: FloatArray, wanted: IndexArray, wavelength_m: float
) -> FloatArray:
    """Return by how much, 1-σ in m, readings to come can change the result at marks ``wanted``.

    They act through z_T, what can be ``seen`` of the state at the last mark, alone; ``latest`` is
    that state's covariance. Were z_T known, a height before it would change by E[e_j | z_T], of
    covariance w_j' Z^-1 w_k with w the part of Psi P e_r that can be seen, Psi the product of
    (I - K H) F from there to T, and Z the covariance of z_T; no reading can give more. Only
    the part that passes HPF_B3x2 counts: an error of the whole run's height does not.
    """
    from floatref.estimators.smoothing import covariance

    reach = np.empty_like(marks.column)
    covariance.reach(marks.column, marks.passed, reach)
    spread = seen @ latest @ seen.T
    scale = np.sqrt(np.maximum(np.diag(spread), np.finfo(np.float64).tiny))
    inverse = np.linalg.pinv(spread / np.outer(scale, scale), SMALLEST, hermitian=True)
    passed = high_pass(marks.distance_m, wavelength_m, wanted) @ reach @ seen.T / scale
    change: FloatArray = np.sqrt(np.maximum(np.einsum("ij,jk,ik->i", passed, inverse, passed), 0.0))
    return change


def changes(segments: Sequence[Segment], behind: Settled | None, wavelength_m: float) -> FloatArray:
    """Return by how much, 1-σ in m, what is to come can change the end of each of ``segments``.

    Shape (n - 1,): not of the last, which has just ended.
    """
    marks = Settled.of([segment.marks for segment in segments])
    ends = np.cumsum([len(segment.marks.at) for segment in segments]) - 1
    if behind is not None:
        ends += len(behind.at)
        marks = marks.behind(behind)
    latest = segments[-1].marks.latest
    standing = marks.distance_m[-2:-1] == marks.distance_m[-1]
    seen = segments[-1].nodes.select_seen(bool(standing.any()))
    return influence(marks, latest, seen, ends[:-1], wavelength_m)


def count_settled(change: FloatArray, tolerance_m: float) -> int:
    """Return how many segments, from the first, have ends of no more ``change`` than allowed."""
    open_ends = change > tolerance_m
    return int(np.argmax(open_ends)) if open_ends.any() else open_ends.size
