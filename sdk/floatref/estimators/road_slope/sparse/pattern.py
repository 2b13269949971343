"""Rows over all unknowns, the values of which change from pass to pass, but not their places."""

import numpy as np
from scipy.sparse import coo_array, csr_array

from floatref.estimators.road_slope.layout import Layout, places
from floatref.values.arrays import FloatArray, IndexArray

Part = tuple[slice, csr_array] | str
"""A matrix that has values in all places for a slice of the vector, or one of `GLOBALS`."""


class Pattern:
    """The places of the values of some parts, no two of which share one."""

    def __init__(self, layout: Layout, *parts: Part) -> None:
        """Take the places of ``parts``, of which the first is a matrix."""
        count = parts[0][1].shape[0] if isinstance(parts[0], tuple) else 0
        found = [_places(layout, part, count) for part in parts]
        rows, columns = (np.concatenate(each) for each in zip(*found, strict=True))
        shape = count, layout.size
        numbered = csr_array(coo_array((np.arange(rows.size), (rows, columns)), shape))
        numbered.sort_indices()
        self.shape, self.chosen = shape, numbered.data
        self.columns, self.begins = numbered.indices, numbered.indptr

    def fill(self, *values: FloatArray) -> csr_array:
        """Return the rows with the ``values`` of each part, in the order of its matrix."""
        data = np.concatenate(values)[self.chosen]
        return csr_array((data, self.columns, self.begins), self.shape)


def _places(layout: Layout, part: Part, count: int) -> tuple[IndexArray, IndexArray]:
    """Return rows and columns of a part."""
    if isinstance(part, str):
        return np.arange(count), np.full(count, layout.place(part))
    rows, columns = places(part[1])
    return rows, columns + part[0].start


def in_common(*matrices: csr_array) -> tuple[csr_array, FloatArray]:
    """Return a matrix with all places of ``matrices``, and what each has there.

    The latter has the shape (matrices, places).
    """
    width = matrices[0].shape[1]
    keys = [rows * width + columns for rows, columns in map(places, matrices)]
    every, at = np.unique(np.concatenate(keys), return_inverse=True)
    parts = np.split(at, np.cumsum([key.size for key in keys])[:-1])
    values = [np.bincount(i, m.data, every.size) for i, m in zip(parts, matrices, strict=True)]
    rows, columns = np.divmod(every, width)
    where = csr_array(coo_array((np.ones(every.size), (rows, columns)), matrices[0].shape))
    return where, np.array(values)
