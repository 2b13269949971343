"""Nodes of the Kalman filter of chapter 6."""

from typing import ClassVar

import numpy as np

from floatref.estimators.kalman.layout import DRIFT, NODE, OFFSET, SPREAD, STATES, UPDATE
from floatref.estimators.smoothing.nodes import Nodes, upper
from floatref.values.arrays import FloatArray, IndexArray

SEEN = np.delete(np.eye(STATES), (DRIFT, OFFSET), axis=0)
"""What readings to come can tell of the state at last: never the height but with GNSS's drift."""
SEEN[0, DRIFT] = 1.0
STANDING = np.eye(STATES)[0] + np.eye(STATES)[OFFSET]
"""At a stop also how far the height is from where the stop began."""
UPPER = upper(STATES)


class KalmanNodes(Nodes):
    """A node closes a sub-block, or is a sample with observations."""

    states: ClassVar[int] = STATES
    width: ClassVar[int] = NODE
    update_width: ClassVar[int] = UPDATE

    def back(self, before: int, step: float, adjoint: FloatArray) -> FloatArray:
        """Go back by (I - K H)' and A', in place of (6.17)."""
        from floatref.estimators.kalman import backward

        found = np.empty((len(self.at), 4))
        backward.smooth(self.at, self.rows, self.updates, before, step, adjoint, found)
        return found

    def correction(self, adjoint: FloatArray) -> FloatArray:
        """Return -P lambda of height and velocity behind the last node."""
        from floatref.estimators.kalman import backward

        found = np.zeros(4)
        backward.correct(self.rows[-1], adjoint, found)
        return found

    def passes(self, before: int, step: float, chosen: IndexArray) -> tuple[FloatArray, FloatArray]:
        """Multiply (I - K H) A."""
        from floatref.estimators.kalman import backward

        passed, gathered = np.empty((2, chosen.size, STATES, STATES))
        nodes = self.at, self.rows, self.updates
        backward.closed_loop(*nodes, before, step, chosen, passed, gathered)
        return passed, gathered

    def column(self, chosen: IndexArray) -> FloatArray:
        """Return P e_r."""
        return self.rows[chosen, SPREAD : SPREAD + STATES]

    def latest(self) -> FloatArray:
        """Return P at the last node."""
        found = np.empty((STATES, STATES))
        found[UPPER] = found.T[UPPER] = self.rows[-1, SPREAD:]
        return found

    @classmethod
    def seen(cls, standing: bool) -> FloatArray:
        """Return all but the height, which GNSS tells with its drift alone."""
        return np.vstack([SEEN, STANDING]) if standing else SEEN
