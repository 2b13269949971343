"""Which unknown is where in the vector, and matrices of rows over all of them."""

from dataclasses import dataclass

import numpy as np
from scipy.sparse import coo_array, csr_array

from floatref.values.arrays import FloatArray, IndexArray

GLOBALS = ("gain", "lean", "centre", "offset", "log_hz", "log_damping")
"""κ, λ, H, h_0, ln f, ln ζ, in the order in which they end the vector."""


@dataclass(frozen=True)
class Layout:
    """The vector z, s, r, θ, b and the `GLOBALS`: ``points`` of the road, ``nodes`` in time."""

    points: int
    nodes: int

    @property
    def elevation(self) -> slice:
        """Where z is."""
        return slice(0, self.points)

    @property
    def slope(self) -> slice:
        """Where s is."""
        return slice(self.points, 2 * self.points)

    @property
    def height(self) -> slice:
        """Where r is."""
        return self._of_nodes(0)

    @property
    def pitch(self) -> slice:
        """Where θ is."""
        return self._of_nodes(1)

    @property
    def bias(self) -> slice:
        """Where b is."""
        return self._of_nodes(2)

    @property
    def size(self) -> int:
        """Number of all unknowns."""
        return 2 * self.points + 3 * self.nodes + len(GLOBALS)

    def place(self, name: str) -> int:
        """Return where the one of `GLOBALS` is."""
        return self.size - len(GLOBALS) + GLOBALS.index(name)

    def rows(self, *parts: tuple[slice | str, csr_array | FloatArray]) -> csr_array:
        """Return rows over all unknowns, the sum of ``parts``.

        A part is a matrix for a slice of the vector, or a column for one of `GLOBALS`.
        """
        found = [self._spread(where, part) for where, part in parts]
        rows, columns, values = (np.concatenate(each) for each in zip(*found, strict=True))
        shape = (parts[0][1].shape[0], self.size)
        return csr_array(coo_array((values, (rows, columns)), shape))

    def _spread(
        self, where: slice | str, part: csr_array | FloatArray
    ) -> tuple[IndexArray, IndexArray, FloatArray]:
        """Return rows, columns and values of a part."""
        if isinstance(where, str):
            rows = np.arange(part.shape[0])
            return rows, np.full(rows.size, self.place(where)), np.asarray(part, np.float64)
        flat = coo_array(part)
        return np.asarray(flat.row), np.asarray(flat.col + where.start), np.asarray(flat.data)

    def _of_nodes(self, number: int) -> slice:
        begin = 2 * self.points + number * self.nodes
        return slice(begin, begin + self.nodes)


def triples(middles: IndexArray, nodes: int, shares: tuple[float, float, float]) -> csr_array:
    """Return the matrix of ``shares`` of the nodes before, at and behind ``middles``."""
    count = middles.size
    rows = np.tile(np.arange(count), 3)
    columns = np.concatenate((middles - 1, middles, middles + 1))
    return csr_array((np.repeat(shares, count), (rows, columns)), (count, nodes))


def between_points(places: FloatArray, first: float, spacing: float, points: int) -> csr_array:
    """Return the matrix of the lines between ``points`` of the road at ``places``, in m."""
    at = (places - first) / spacing
    low = np.clip(np.floor(at).astype(np.int64), 0, points - 2)
    share, rows = at - low, np.arange(places.size)
    values = np.concatenate((1.0 - share, share))
    columns = np.concatenate((low, low + 1))
    return csr_array((values, (np.tile(rows, 2), columns)), (places.size, points))
