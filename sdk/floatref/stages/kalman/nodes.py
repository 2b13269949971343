"""What the filter leaves behind for the backward pass."""

from dataclasses import dataclass

import numpy as np

from floatref.kernels.kalman_layout import KINDS, NODE, UPDATE
from floatref.values.arrays import FloatArray, IndexArray


@dataclass(eq=False)
class Nodes:
    """The nodes of a stretch: samples and ends of updates (k, 2), nodes, updates."""

    at: IndexArray
    nodes: FloatArray
    updates: FloatArray

    @classmethod
    def room(cls, samples: int, sub_block: int, observations: int) -> "Nodes":
        """Return room for the nodes of so many ``samples``."""
        count = samples // sub_block + observations + 2
        updates = np.empty((KINDS * observations, UPDATE))
        return cls(np.empty((count, 2), np.int64), np.empty((count, NODE)), updates)

    def filled(self, count: int) -> "Nodes":
        """Return the first ``count``, without the room behind them."""
        end = int(self.at[count - 1, 1]) if count else 0
        return Nodes(self.at[:count], self.nodes[:count], self.updates[:end])

    def parted(self, sample: int) -> tuple["Nodes", "Nodes"]:
        """Return those before ``sample``, and those behind."""
        count = int(np.searchsorted(self.at[:, 0], sample))
        head = self.filled(count)
        end = len(head.updates)
        tail = Nodes(self.at[count:] - np.array([0, end]), self.nodes[count:], self.updates[end:])
        return head, tail

    @classmethod
    def joined(cls, parts: list["Nodes"]) -> "Nodes":
        """Return ``parts``, each behind the one before, as one."""
        parts = [part for part in parts if len(part.at)]
        if len(parts) == 1:
            return parts[0]
        ends = np.cumsum([0, *(len(p.updates) for p in parts)])
        at = [p.at + np.array([0, end]) for p, end in zip(parts, ends, strict=False)]
        nodes, updates = [p.nodes for p in parts], [p.updates for p in parts]
        return cls(np.concatenate(at), np.concatenate(nodes), np.concatenate(updates))
