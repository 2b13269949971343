"""How many rows an adapter delivers together, and the memory that they take in turn."""

import numpy as np

MOST_ROWS = 1 << 16
MOST_SAMPLES = 1 << 22
"""Of all columns together: 32 MiB."""
FEWEST_ROWS = 1 << 10
KEPT_BYTES = (1 << 25) - (1 << 16)
"""Just below the most that glibc learns from."""


def rows_for(columns: int) -> int:
    """Return how many rows of so many columns are a piece; all of it is in memory at once."""
    return min(max(MOST_SAMPLES // max(columns, 1), FEWEST_ROWS), MOST_ROWS)


def keep_freed_memory() -> None:
    """Have the next piece take the memory of the last one.

    glibc gives freed memory back to the system, which has to clear it before it comes again: for
    a format that needs no decoding that takes longer than reading. It keeps pieces of the size of
    the largest that was ever freed; this one is never touched.
    """
    np.empty(KEPT_BYTES, np.uint8)


__all__ = ["MOST_ROWS", "keep_freed_memory", "rows_for"]
