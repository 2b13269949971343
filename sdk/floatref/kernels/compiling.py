"""How kernels are compiled: lazily, cached where the folder allows it."""

from collections.abc import Callable
from typing import ParamSpec, TypeVar

from numba import njit

P = ParamSpec("P")
R = TypeVar("R")


def compiled(function: Callable[P, R]) -> Callable[P, R]:
    """Return ``function`` compiled on first call, keeping its type.

    numba refuses `cache=True` with RuntimeError when it finds no folder to write to (a
    read-only installation without a home); the kernel is then compiled in every process.
    """
    try:
        kernel: Callable[P, R] = njit(cache=True, nogil=True)(function)
    except RuntimeError:
        kernel = njit(nogil=True)(function)
    return kernel
