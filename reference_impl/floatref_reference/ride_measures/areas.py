"""Stretches of a signal beyond a limit, and how much of them is valid."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy.typing as npt

from floatref_reference.signals import Real, samples


class Area(NamedTuple):
    """A stretch of successive samples.

    Attributes:
        first: index of its first sample.
        last: index of its last sample.
        peak: index of the first of its highest samples.
    """

    first: int
    last: int
    peak: int


def areas_above(x: npt.ArrayLike, limit: Real) -> list[Area]:
    """List the stretches above a limit.

    Equation:
        Every largest set of successive k with x_k > limit.

    Args:
        x: signal, shape (N,).
        limit: the limit, in the unit of x.

    Returns:
        The stretches, in order.
    """
    x_k, found = samples(x), []
    first = peak = -1
    for k, value in enumerate(x_k):
        if value > limit:
            if first < 0:
                first = peak = k
            if value > x_k[peak]:
                peak = k
        elif first >= 0:
            found.append(Area(first, k - 1, peak))
            first = -1
    if first >= 0:
        found.append(Area(first, len(x_k) - 1, peak))
    return found


def valid_share(
    valid: Sequence[bool], first: int, last: int, before: int = 0, after: int = 0
) -> float:
    """Count for how many samples all points are valid that they are computed from.

    Equation:
        Share of k from first to last for which valid_j holds for every j of the profile with
        k - before ≤ j ≤ k + after.

    Args:
        valid: whether a point is valid, shape (N,).
        first: index of the first sample.
        last: index of the last sample.
        before: points before k that its value is computed from.
        after: points behind k that its value is computed from.

    Returns:
        The share, 0 to 1.
    """
    good = 0
    for k in range(first, last + 1):
        good += all(valid[max(k - before, 0) : k + after + 1])
    return good / (last - first + 1)
