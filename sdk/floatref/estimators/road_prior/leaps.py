"""Leaps of the height sensor at standstill: the lines they flag and their warnings."""

from collections.abc import Iterator, Mapping, Sequence
from typing import NamedTuple

import numpy as np

from floatref.estimators.models.road_prior_values import HEIGHT, VELOCITY
from floatref.estimators.smoothing.nodes import Nodes
from floatref.values.arrays import BoolArray, Flag, FlagArray, FloatArray, Records

LEAST_M = 0.01
"""Less than that is an edge of the road under a laser that sways: cracks, joints, leaves."""


class Leap(NamedTuple):
    """A reading at a standstill, its sample and its error in m."""

    sample: int
    by_m: float


def changes(nodes: Nodes, ends: Records) -> FloatArray:
    """Return what the readings of ``nodes`` change in height, in m, and velocity, in m/s.

    Shape (2, n); for ``ends`` see `road_prior_values`.
    """
    found = np.zeros((2, len(ends)))
    gain = nodes.updates["gain"][:, [HEIGHT, VELOCITY]]
    found[:, ~np.isnan(ends["seen"])] = gain.T * _innovations(nodes)
    return found


def leaps(nodes: Nodes, ends: Records, edge: float) -> list[Leap]:
    """Return the readings at a standstill for which the road was let go, if far enough off.

    ``edge`` is the square of how many deviations off that needs.
    """
    seen = ~np.isnan(ends["seen"])
    standing = ends["travel"][seen] <= 0.0
    if not standing.any():
        return []
    innovation = _innovations(nodes)
    far = np.abs(innovation) > LEAST_M
    there = np.flatnonzero(standing & are_let_go(nodes, edge) & far)
    samples = nodes.at[seen][there].tolist()
    return [Leap(*each) for each in zip(samples, innovation[there].tolist(), strict=True)]


def are_let_go(nodes: Nodes, edge: float) -> BoolArray:
    """Return for which readings of ``nodes`` at a standstill the road was let go, shape (n,).

    Of readings while the vehicle moves it tells nothing. For ``edge`` see `leaps`.
    """
    # The square of the innovation was added to its variance there.
    share = _innovations(nodes) ** 2 * nodes.updates["information"]
    found: BoolArray = (share >= edge / (1.0 + edge)) & (share < 1.0)
    return found


def _innovations(nodes: Nodes) -> FloatArray:
    found: FloatArray = nodes.updates["innovation"] / nodes.updates["information"]
    return found


def mark_leaps(
    flags: FlagArray | None, found: Sequence[Leap], first: int, size: int
) -> FlagArray | None:
    """Return ``flags`` of samples from ``first`` on, with those of leaps."""
    inside = [each.sample - first for each in found if first <= each.sample < first + size]
    if not inside:
        return flags
    own = np.zeros(size, np.uint8) if flags is None else flags.copy()
    own[inside] |= np.uint8(Flag.SLOW)
    return own


def lines(found: Mapping[str, Sequence[Leap]], origin_s: float, step: float) -> Iterator[str]:
    """Yield a line for each wheel path whose height sensor has leapt, with its largest leap."""
    for track, each in found.items():
        if each:
            most = max(each, key=lambda leap: abs(leap.by_m))
            when = origin_s + step * most.sample
            yield (
                f"height, {track}: leaps by {1e3 * abs(most.by_m):.0f} mm at {when:.2f} s while "
                "nothing moves; something has come or gone under the laser; the stop is not valid"
            )
