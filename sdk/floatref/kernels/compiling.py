"""How kernels are compiled: lazily, cached where the folder allows it."""

from collections.abc import Callable
from typing import Any, ParamSpec, TypeVar

from numba import njit

P = ParamSpec("P")
R = TypeVar("R")
OPTIONS: dict[str, Any] = {"nogil": True, "fastmath": {"contract"}, "error_model": "numpy"}


def compiled(function: Callable[P, R]) -> Callable[P, R]:
    """Return ``function`` compiled on first call, keeping its type.

    A product and a sum may become one fused operation, which rounds once instead of twice; no
    other freedom is given, so infinities, NaN and the order of operations are as written. A
    division by zero gives infinity or NaN, as in numpy: a loop that could raise stays scalar.

    A name with an underscore is called by other kernels alone, and gets no entry from Python: that
    saves a seventh of the compilation time.

    numba refuses `cache=True` with RuntimeError when it finds no folder to write to (a
    read-only installation without a home); the kernel is then compiled in every process.
    """
    inner = function.__name__.startswith("_")
    options = {**OPTIONS, "no_cpython_wrapper": inner, "no_cfunc_wrapper": inner}
    try:
        kernel: Callable[P, R] = njit(cache=True, **options)(function)
    except RuntimeError:
        kernel = njit(**options)(function)
    return kernel
