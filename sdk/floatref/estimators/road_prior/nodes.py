"""Nodes of the road-prior filter."""

from typing import ClassVar

import numpy as np

from floatref.estimators.road_prior.layout import NODE, SPREAD, STATES, UPDATE
from floatref.estimators.smoothing.nodes import Nodes, upper
from floatref.values.arrays import FloatArray, IndexArray

UPPER = upper(STATES)


class RoadNodes(Nodes):
    """A node ends a sub-block, and has one update at most."""

    states: ClassVar[int] = STATES
    width: ClassVar[int] = NODE
    update_width: ClassVar[int] = UPDATE

    def back(self, before: int, step: float, adjoint: FloatArray) -> FloatArray:
        """Go back by (I - K H)' and F'."""
        from floatref.estimators.road_prior import backward

        found = np.empty((len(self.at), 4))
        backward.smooth(self.at, self.rows, self.updates, before, step, adjoint, found)
        return found

    def correction(self, adjoint: FloatArray) -> FloatArray:
        """Return -P lambda of height and velocity behind the last node."""
        from floatref.estimators.road_prior import backward

        found = np.zeros(4)
        backward.correct(self.rows[-1], adjoint, found)
        return found

    def passes(self, before: int, step: float, chosen: IndexArray) -> tuple[FloatArray, FloatArray]:
        """Multiply (I - K H) F."""
        from floatref.estimators.road_prior import backward

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
        """Return every state: the road tells each in time."""
        return np.eye(STATES)
