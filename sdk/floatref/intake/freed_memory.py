"""Memory that was freed, given back to the system where a long run turns.

The arrays of a block are so small that the allocator of glibc keeps them when they are freed, and
nothing that lies behind them on the heap is let go. A smoother that has waited for three minutes
leaves some hundred megabytes, and the profile is laid out beside them.
"""

import sys
from functools import cache
from typing import Any


def return_freed() -> bool:
    """Give what was freed back to the system; return whether the allocator has a call for it."""
    trim = _find_call()
    return bool(trim is not None and trim(0))


@cache
def _find_call() -> Any:
    """Return glibc's `malloc_trim`, None without it."""
    if sys.platform != "linux":
        return None
    import ctypes

    return getattr(ctypes.CDLL(None), "malloc_trim", None)
