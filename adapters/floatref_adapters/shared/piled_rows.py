"""Rows that come one by one, handed on in pieces that fit in memory."""

from collections.abc import Iterable, Iterator, Sequence
from itertools import islice

import numpy as np

from floatref import Rows

ROWS = 1 << 13
"""Rows handed on together."""


def piled(rows: Iterable[tuple[int, Sequence[float]]], names: Sequence[str]) -> Iterator[Rows]:
    """Yield ``rows``, each a tick and the values of the columns ``names``, in pieces.

    Values that are not finite are missing.
    """
    coming = iter(rows)
    while pile := list(islice(coming, ROWS)):
        ticks = np.array([tick for tick, _ in pile], dtype=np.int64)
        table = np.array([values for _, values in pile], dtype=np.float64)
        table[~np.isfinite(table)] = np.nan
        columns = table.reshape(len(pile), len(names)).T
        yield Rows({n: np.ascontiguousarray(c) for n, c in zip(names, columns, strict=True)}, ticks)


__all__ = ["piled"]
