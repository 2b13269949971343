"""Rows in pieces that fit in memory: how many go together, and the memory that they take."""

from collections.abc import Iterable, Iterator, Sequence
from itertools import islice

import numpy as np

from floatref import Rows

MOST_ROWS = 1 << 16
MOST_SAMPLES = 1 << 22
"""Of all columns together: 32 MiB."""
FEWEST_ROWS = 1 << 10
KEPT_BYTES = (1 << 25) - (1 << 16)
"""Just below the most that glibc learns from."""


def count_piece_rows(columns: int) -> int:
    """Return how many rows of ``columns`` columns are a piece; a whole piece is in memory."""
    return min(max(MOST_SAMPLES // max(columns, 1), FEWEST_ROWS), MOST_ROWS)


def keep_freed_memory() -> None:
    """Have the next piece take the memory of the last one.

    glibc gives freed memory back to the system, which has to clear it before it comes again: for
    a format that needs no decoding that takes longer than reading. It keeps pieces of the size of
    the largest that was ever freed; this one is never touched.
    """
    np.empty(KEPT_BYTES, np.uint8)


ROWS = 1 << 13
"""Rows handed on together."""


def pile_rows(rows: Iterable[tuple[int, Sequence[float]]], names: Sequence[str]) -> Iterator[Rows]:
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
