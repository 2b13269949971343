"""The order in which unknowns are eliminated, so that few are together in rows at a time."""

import numpy as np
from scipy.sparse import csr_array

from floatref.estimators.road_slope.layout import GLOBALS, IN_TIME, Layout, places
from floatref.values.arrays import FloatArray, IndexArray

BEFORE, BEHIND = -0.75, 0.25
"""The slope at a point is eliminated before, the elevation behind the node that is the last to
touch it: a height has neighbours in the rows of the node after it."""


def elimination_order(
    layout: Layout, under_laser: csr_array, wheels: tuple[csr_array, csr_array]
) -> IndexArray:
    """Return all unknowns, those of the nodes in time, the constants of the vehicle last.

    A point of the road follows the last node to which it matters: for its elevation that from
    which on the laser and both axles have passed, by the matrices of the road ``under_laser`` and
    under the ``wheels``; for its slope the laser alone.
    """
    found = np.full(layout.size, np.inf)
    found[layout.elevation] = _last_touch(under_laser, *wheels) + BEHIND
    found[layout.slope] = _last_touch(under_laser) + BEFORE
    for name in IN_TIME:
        found[layout.in_time(name)] = np.arange(layout.nodes)
    assert np.isinf(found).sum() == len(GLOBALS)
    return np.argsort(found, kind="stable")


def _last_touch(*under: csr_array) -> FloatArray:
    """Return the last node that touches each point, between those touched as if evenly."""
    last = np.full(under[0].shape[1], -1)
    for nodes, points in map(places, under):
        np.maximum.at(last, points, nodes)
    touched = np.flatnonzero(last >= 0)
    return np.asarray(np.interp(np.arange(last.size), touched, last[touched]))
