"""What a filter leaves behind for the backward pass."""

from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass
from typing import ClassVar, NamedTuple, Self

import numpy as np

from floatref.values.arrays import FlagArray, FloatArray, IndexArray


@dataclass(eq=False)
class Nodes(ABC):
    """The nodes of a stretch of a wheel path: places where the filter's covariance is known.

    The first state is the height, the second its velocity.

    Attributes:
        at: sample, and end of the updates, shape (k, 2).
        rows: what the filter keeps of a node, shape (k, width).
        updates: what it keeps of a scalar update, shape (m, update_width).
    """

    states: ClassVar[int]
    width: ClassVar[int]
    update_width: ClassVar[int]

    at: IndexArray
    rows: FloatArray
    updates: FloatArray

    @classmethod
    def room(cls, nodes: int, updates: int) -> Self:
        """Return room for so many ``nodes`` and ``updates``."""
        rows, kept = np.empty((nodes, cls.width)), np.empty((updates, cls.update_width))
        return cls(np.empty((nodes, 2), np.int64), rows, kept)

    def filled(self, count: int) -> Self:
        """Return the first ``count``, without the room behind them."""
        end = int(self.at[count - 1, 1]) if count else 0
        return type(self)(self.at[:count], self.rows[:count], self.updates[:end])

    def parted(self, sample: int) -> tuple[Self, Self]:
        """Return those before ``sample``, and those behind."""
        count = int(np.searchsorted(self.at[:, 0], sample))
        head = self.filled(count)
        end = len(head.updates)
        at = self.at[count:] - np.array([0, end])
        return head, type(self)(at, self.rows[count:], self.updates[end:])

    @classmethod
    def joined(cls, parts: Sequence[Self]) -> Self:
        """Return ``parts``, one or more and each behind the one before, as one."""
        parts = [part for part in parts if len(part.at)] or parts[:1]
        if len(parts) == 1:
            return parts[0]
        ends = np.cumsum([0, *(len(p.updates) for p in parts)])
        at = [p.at + np.array([0, end]) for p, end in zip(parts, ends, strict=False)]
        rows, updates = [p.rows for p in parts], [p.updates for p in parts]
        return cls(np.concatenate(at), np.concatenate(rows), np.concatenate(updates))

    def last(self) -> Self:
        """Return the last node alone, without its updates."""
        at = np.array([[self.at[-1, 0], 0]])
        return type(self)(at, self.rows[-1:].copy(), self.updates[:0])

    @abstractmethod
    def back(self, before: int, step: float, adjoint: FloatArray) -> FloatArray:
        """Return the corrections of height and velocity on both sides of each node, shape (k, 4).

        ``adjoint``, shape (states,), is lambda behind the last node and becomes that behind the
        sample ``before``, where the node before these lies; ``step`` in s lies between samples.
        """

    @abstractmethod
    def correction(self, adjoint: FloatArray) -> FloatArray:
        """Return the correction behind the last node, shape (4,), by lambda there."""

    @abstractmethod
    def passes(self, before: int, step: float, chosen: IndexArray) -> tuple[FloatArray, FloatArray]:
        """Return how errors pass on between the nodes ``chosen``, shapes (n, states, states).

        The first is Psi, the product of (I - K H) F from the one chosen before (the first from
        ``before``), the second the sum of Psi' H' H Psi / S on the way.
        """

    @abstractmethod
    def column(self, chosen: IndexArray) -> FloatArray:
        """Return P e_r at the nodes ``chosen``, shape (n, states)."""

    @abstractmethod
    def latest(self) -> FloatArray:
        """Return P at the last node, shape (states, states)."""

    @classmethod
    @abstractmethod
    def seen(cls, standing: bool) -> FloatArray:
        """Return what readings to come can tell of a state, shape (m, states)."""


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


def upper(states: int) -> tuple[IndexArray, IndexArray]:
    """Return where the upper half of a covariance has its entries, row by row."""
    rows, columns = np.triu_indices(states)
    return rows, columns
