"""The normalized innovations of the Kalman filter of a wheel path, kind by kind of reading."""

from dataclasses import dataclass, field

import numpy as np

from floatref.estimators.kalman.references import DATUM_M
from floatref.estimators.models.kalman_values import (
    CAPTURE,
    DRIFT,
    HEIGHT,
    KINDS,
    OFFSET,
    PITCH,
    RELATIVE,
    RENEW,
    ROLL,
    VELOCITY,
    Observations,
)
from floatref.estimators.smoothing.nodes import Nodes
from floatref.values.arrays import BoolArray, FloatArray, IndexArray, Records
from floatref.values.innovations import Innovations

NAMES = (
    *("gnss_height", "gnss_vertical_velocity", "gnss_pitch", "gnss_roll"),
    *("constant_height", "constant_velocity", "constant_pitch", "constant_roll"),
    "reflection",
)
"""Readings of GNSS, constants in their place in the same order, and the height sensor at a stop."""
REFLECTION = 2 * KINDS


@dataclass(eq=False)
class NormalizedInnovations:
    """What the updates of a filter were off by, over what it expected.

    Attributes:
        origin_s: time of sample 0, in s.
        step: between two samples, in s.
        attitude: whether pitch and roll are those of GNSS.
        kinds: by their `NAMES`, those that there were.
        begun: whether a height of GNSS has set the datum.
    """

    origin_s: float
    step: float
    attitude: bool
    kinds: dict[str, Innovations] = field(default_factory=dict)
    begun: bool = False

    def add(self, nodes: Nodes, schedule: Observations) -> None:
        """Take the updates of ``nodes``, whose readings are those of ``schedule``.

        ν/√S is the update's ν/S over the root of its 1/S. A reading from which something begins,
        as the datum of GNSS does, is off by nothing or by anything, and does not count.
        """
        updates = nodes.updates
        if len(updates) == 0:
            return
        at = np.repeat(nodes.at, np.diff(nodes.rows["updated"], prepend=0))
        marks = schedule.marks[np.searchsorted(schedule.at, at)]
        kinds = self._kinds(updates["row"], marks)
        z = updates["innovation"] / np.sqrt(updates["information"])
        counts = ~self._begins(kinds, marks, updates)
        for kind in np.unique(kinds).tolist():
            chosen = (kinds == kind) & counts
            own = self.kinds.setdefault(NAMES[kind], Innovations())
            own.add(self.origin_s + self.step * at[chosen], z[chosen])

    def finish(self, rejected: IndexArray) -> dict[str, Innovations]:
        """Return all kinds in the order of `NAMES`; ``rejected``, shape (4,), were left out."""
        for kind, count in enumerate(rejected.tolist()):
            if count:
                name = NAMES[kind if self.attitude or kind < PITCH else kind + KINDS]
                self.kinds.setdefault(name, Innovations()).left_out = count
        return {name: self.kinds[name] for name in NAMES if name in self.kinds}

    def _kinds(self, rows: FloatArray, marks: IndexArray) -> IndexArray:
        """Return the place in `NAMES` of each update, by its row of H, (C.8)."""
        found = np.where(rows[:, ROLL] != 0.0, ROLL, PITCH)
        found[rows[:, VELOCITY] != 0.0] = VELOCITY
        heights = rows[:, HEIGHT] != 0.0
        found[heights] = HEIGHT
        constant = (marks & RELATIVE != 0) & ~heights
        constant |= heights & (rows[:, DRIFT] == 0.0)
        if not self.attitude:
            constant |= found >= PITCH
        found[constant] += KINDS
        found[heights & (rows[:, OFFSET] != 0.0)] = REFLECTION
        return found

    def _begins(self, kinds: IndexArray, marks: IndexArray, updates: Records) -> BoolArray:
        """Return which updates set a datum, or what a height is relative to, shape (n,)."""
        first: BoolArray = (kinds == REFLECTION) & (marks & RENEW != 0)
        first |= (kinds == HEIGHT + KINDS) & (marks & CAPTURE != 0)
        gnss = kinds == HEIGHT
        # A new datum is as good as unknown, and is in the variance of what is read there.
        first |= gnss & (updates["information"] * DATUM_M**2 <= 1.0)
        if not self.begun and gnss.any():
            first[np.argmax(gnss)] = self.begun = True
        return first
