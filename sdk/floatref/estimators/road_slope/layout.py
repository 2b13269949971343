"""Which unknown is where in the vector, and matrices of rows over all of them."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.sparse import coo_array, csr_array

from floatref.values.arrays import FloatArray, IndexArray

GLOBALS = (
    "gain",
    "lean",
    "centre",
    "log_front",
    "log_rear",
    "log_front_damping",
    "log_rear_damping",
    "log_gyration",
)
"""κ, λ, H, ln K_f, ln K_r, ln C_f, ln C_r and ln γ, in the order in which they end the vector."""
IN_TIME = ("height", "pitch", "bias", "heave", "nod", "offset", "moment")
"""r, θ, b, u, n, o and μ, in the order in which they follow the road."""
SHARES = (1.0 / 12.0, 10.0 / 12.0, 1.0 / 12.0)
"""Shares of three nodes in the mean under two boxes of what is smooth."""


@dataclass(frozen=True)
class Layout:
    """The vector z, s, those of `IN_TIME` and the `GLOBALS`.

    The road has ``points``, the time ``nodes``.
    """

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

    def in_time(self, name: str) -> slice:
        """Return where the one of `IN_TIME` is."""
        begin = 2 * self.points + IN_TIME.index(name) * self.nodes
        return slice(begin, begin + self.nodes)

    @property
    def height(self) -> slice:
        """Where r is."""
        return self.in_time("height")

    @property
    def pitch(self) -> slice:
        """Where θ is."""
        return self.in_time("pitch")

    @property
    def bias(self) -> slice:
        """Where b is."""
        return self.in_time("bias")

    @property
    def size(self) -> int:
        """Number of all unknowns."""
        return 2 * self.points + len(IN_TIME) * self.nodes + len(GLOBALS)

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
        rows, columns = places(csr_array(part))
        return rows, columns + where.start, np.asarray(part.data, np.float64)


def places(matrix: csr_array) -> tuple[IndexArray, IndexArray]:
    """Return rows and columns of all values of a ``matrix``, in their order."""
    rows = np.repeat(np.arange(matrix.shape[0]), np.diff(matrix.indptr))
    return rows, np.asarray(matrix.indices, np.int64)


def triples(middles: IndexArray, nodes: int, shares: Sequence[float]) -> csr_array:
    """Return the matrix of ``shares`` of the nodes before, at and behind ``middles``."""
    count = middles.size
    columns = np.column_stack((middles - 1, middles, middles + 1)).ravel()
    begins = 3 * np.arange(count + 1)
    return csr_array((np.tile(shares, count), columns, begins), (count, nodes))


def between_points(places: FloatArray, first: float, spacing: float, points: int) -> csr_array:
    """Return the matrix of the lines between ``points`` of the road at ``places``, in m."""
    at = (places - first) / spacing
    low = np.clip(np.floor(at).astype(np.int64), 0, points - 2)
    values = np.column_stack((1.0 - (at - low), at - low)).ravel()
    columns = np.column_stack((low, low + 1)).ravel()
    return csr_array((values, columns, 2 * np.arange(places.size + 1)), (places.size, points))
