"""What a filter leaves behind for the backward pass."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from floatref.values.arrays import (
    FlagArray,
    FloatArray,
    IndexArray,
    Records,
    new_record,
    new_records,
)

CORRECTION = np.dtype(
    [
        (f"{side}_{state}", np.float64)
        for side in ("near", "far")
        for state in ("height", "velocity")
    ],
    align=True,
)
"""What is added to height and velocity at a node, on the near and on the far side of its update."""


@dataclass(frozen=True, eq=False)
class Kind:
    """What the nodes of one kind of filter have of their own.

    Attributes:
        node: fields of a node, among them `at`, the sample, `updated`, the end of its updates, how
            far these `rise` and `climb`, and the upper half of the `covariance`.
        update: fields of a scalar update, among them `gain`, `innovation` and `information`.
        seen: what later readings can show of a state, shape (m, states).
        standing: the same at a stop.
    """

    node: np.dtype[np.void]
    update: np.dtype[np.void]
    seen: FloatArray
    standing: FloatArray


@dataclass(frozen=True, eq=False)
class Nodes:
    """The nodes of a stretch of a wheel path: places where the filter's covariance is known.

    The first state is the height, the second its velocity.

    Attributes:
        kind: of the filter.
        rows: one for each node.
        updates: one for each scalar update, in order.
    """

    kind: Kind
    rows: Records
    updates: Records

    @classmethod
    def room(cls, kind: Kind, nodes: int, updates: int) -> "Nodes":
        """Return room for that many ``nodes`` and ``updates``."""
        return cls(kind, new_records(nodes, kind.node), new_records(updates, kind.update))

    @property
    def at(self) -> IndexArray:
        """The samples of the nodes, shape (k,)."""
        at: IndexArray = self.rows["at"]
        return at

    @property
    def states(self) -> int:
        """The number of states."""
        return int(self.kind.seen.shape[1])

    def take_first(self, count: int) -> "Nodes":
        """Return the first ``count``, without the room behind them."""
        end = int(self.rows["updated"][count - 1]) if count else 0
        return Nodes(self.kind, self.rows[:count], self.updates[:end])

    def behind(self, filled: "Nodes") -> "Nodes":
        """Return the room that is left behind those ``filled``, the first of this one."""
        rows, updates = self.rows[len(filled.rows) :], self.updates[len(filled.updates) :]
        return Nodes(self.kind, rows, updates)

    def grow(self, filled: "Nodes", more: "Nodes") -> "Nodes":
        """Return those ``filled`` and ``more``, the first `behind` them, without copying.

        The updates of ``more`` are counted from the first of all afterwards.
        """
        more.rows["updated"] += len(filled.updates)
        rows = self.rows[: len(filled.rows) + len(more.rows)]
        updates = self.updates[: len(filled.updates) + len(more.updates)]
        return Nodes(self.kind, rows, updates)

    def split(self, samples: Sequence[int]) -> list["Nodes"]:
        """Return those before each of ``samples``, which increase, and those behind the last.

        Each part has memory of its own: what is stored of one keeps nothing of the others.
        """
        cuts = [0, *np.searchsorted(self.at, samples).tolist(), len(self.rows)]
        return [self._copy(first, behind) for first, behind in pairwise(cuts)]

    def _copy(self, first: int, behind: int) -> "Nodes":
        """Return a copy of the nodes from ``first`` up to, without, ``behind``."""
        begin, end = (int(self.rows["updated"][k - 1]) if k else 0 for k in (first, behind))
        rows = self.rows[first:behind].copy()
        rows["updated"] -= begin
        return Nodes(self.kind, rows, self.updates[begin:end].copy())

    @classmethod
    def concatenate(cls, parts: Sequence["Nodes"]) -> "Nodes":
        """Return ``parts``, one or more and each behind the one before, as one."""
        parts = [part for part in parts if len(part.rows)] or parts[:1]
        if len(parts) == 1:
            return parts[0]
        ends = np.cumsum([0, *(len(part.updates) for part in parts)])
        rows = [
            _shift_updates(part.rows, end) for part, end in zip(parts, ends.tolist(), strict=False)
        ]
        updates = np.concatenate([part.updates for part in parts])
        return cls(parts[0].kind, np.concatenate(rows), updates)

    def last(self) -> "Nodes":
        """Return the last node alone, without its updates."""
        rows = self.rows[-1:].copy()
        rows["updated"] = 0
        # Of its own: a view of none would keep the memory of all.
        return Nodes(self.kind, rows, self.updates[:0].copy())

    def back(self, before: int, step: float, adjoint: FloatArray) -> Records:
        """Return the corrections at each node.

        It goes back by (I - K H)' and F', in place of (6.17). ``adjoint``, shape (states,), is
        lambda behind the last node and becomes that behind the sample ``before``, where the node
        before these lies; ``step`` in s lies between samples.
        """
        from floatref.estimators.smoothing import backward

        found = new_records(len(self.rows), CORRECTION)
        backward.smooth(self.rows, self.updates, before, step, adjoint, found)
        return found

    def correction(self, adjoint: FloatArray) -> np.record:
        """Return the correction on the far side of the last node, -P lambda, by lambda there."""
        from floatref.estimators.smoothing import backward

        found = new_record(CORRECTION)
        backward.correct(self.rows[-1], adjoint, found)
        return found

    def passes(self, before: int, step: float, chosen: IndexArray) -> tuple[FloatArray, FloatArray]:
        """Return how errors pass on between the nodes ``chosen``, shapes (n, states, states).

        The first is Psi, the product of (I - K H) F from the one chosen before (the first from
        ``before``), the second the sum of Psi' H' H Psi / S on the way.
        """
        from floatref.estimators.smoothing import backward

        passed, gathered = np.empty((2, chosen.size, self.states, self.states))
        backward.closed_loop(self.rows, self.updates, before, step, chosen, passed, gathered)
        return passed, gathered

    def column(self, chosen: IndexArray) -> FloatArray:
        """Return P e_r at the nodes ``chosen``, shape (n, states)."""
        column: FloatArray = self.rows["covariance"][chosen, : self.states]
        return column

    def latest(self) -> FloatArray:
        """Return P at the last node, shape (states, states)."""
        found, upper = np.empty((self.states, self.states)), np.triu_indices(self.states)
        found[upper] = found.T[upper] = self.rows["covariance"][-1]
        return found

    def select_seen(self, standing: bool) -> FloatArray:
        """Return what later readings can show of a state, shape (m, states)."""
        return self.kind.standing if standing else self.kind.seen


def _shift_updates(rows: Records, by: int) -> Records:
    """Return ``rows`` whose updates are counted from ``by`` places further back."""
    if by == 0:
        return rows
    moved = rows.copy()
    moved["updated"] += by
    return moved


class Filtered(NamedTuple):
    """What a filter makes of a block of a wheel path.

    Attributes:
        height: in m.
        nodes: what the backward pass needs.
        flags: of all that went in.
    """

    height: FloatArray
    nodes: Nodes
    flags: FlagArray | None
