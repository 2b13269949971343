"""Memory that was freed below what is still used goes back to the system."""

import sys
from pathlib import Path

import numpy as np
import pytest

from floatref.intake.freed_memory import return_freed

COUNT, BYTES = 2000, 100_000
"""Arrays so small that the allocator keeps them, 200 MB of them."""


def resident_bytes():
    pages = int(Path("/proc/self/statm").read_text().split()[1])
    return 4096 * pages


@pytest.mark.skipif(sys.platform != "linux", reason="the allocator is glibc's")
def test_what_was_freed_is_given_back():
    arrays = [np.ones(BYTES // 8) for _ in range(COUNT)]
    # One array in ten stays, so that nothing ends at the top of the heap.
    kept = arrays[::10]
    full = resident_bytes()
    del arrays
    if not return_freed():
        pytest.skip("another allocator")
    assert resident_bytes() < full - 0.8 * COUNT * BYTES
    assert sum(float(each[0]) for each in kept) == len(kept)
