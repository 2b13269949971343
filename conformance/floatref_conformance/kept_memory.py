"""Memory that a process keeps for its next arrays.

A recording of minutes is arrays of tens of megabytes. The allocator of glibc takes each from the
system and gives it back after use, and the system clears it page by page before it is given
again: of a simulated drive that is a third of the processor time. Other allocators, and a glibc
that refuses so large a threshold, stay as they are.
"""

import ctypes
import sys

TRIM_THRESHOLD, MMAP_THRESHOLD, ARENA_MAX = -1, -3, -8
"""Numbers of the options of `mallopt`."""
LARGEST_BYTES = 1 << 30
"""Larger arrays go back to the system as before, and so does what is free beyond as much."""

_mallopt = getattr(ctypes.CDLL(None), "mallopt", None) if sys.platform == "linux" else None


def keep_memory() -> bool:
    """Have this process keep memory that it has freed; return whether its allocator can.

    Its threads then share one heap: with one for each, every heap would keep memory, and those of
    threads are too small for a large array.
    """
    # The others alone would have every array taken from the system, as large ones are.
    if _mallopt is None or not _mallopt(MMAP_THRESHOLD, LARGEST_BYTES):
        return False
    return bool(_mallopt(TRIM_THRESHOLD, LARGEST_BYTES) and _mallopt(ARENA_MAX, 1))
