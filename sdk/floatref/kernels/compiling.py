"""How kernels are compiled: lazily, cached where the folder allows it."""

from collections.abc import Callable
from typing import Any, ParamSpec, TypeVar

from numba import njit
from numba.extending import overload

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
    return _compile(function, OPTIONS)


def compiled_unfused(function: Callable[P, R]) -> Callable[P, R]:
    """Return ``function`` as `compiled` does, with every product and every sum rounded.

    Its results are those of a library that was compiled for any processor.
    """
    return _compile(function, {**OPTIONS, "fastmath": False})


def _compile(function: Callable[P, R], given: dict[str, Any]) -> Callable[P, R]:
    inner = function.__name__.startswith("_")
    options = {**given, "no_cpython_wrapper": inner, "no_cfunc_wrapper": inner}
    try:
        kernel: Callable[P, R] = njit(cache=True, **options)(function)
    except RuntimeError:
        kernel = njit(**options)(function)
    return kernel


def chosen(field: str, having: Callable[P, R], lacking: Callable[P, R]) -> Callable[P, R]:
    """Return a function of three arguments for compiled callers, the first of them a record.

    It is ``having`` where the record has a ``field`` of that name, else ``lacking``: that is
    decided when the caller is compiled, for each type of record, and takes no time after that.
    Both have to be in the file of their caller, for the sake of its cache.
    """

    def choice(*_: P.args, **__: P.kwargs) -> R:
        raise NotImplementedError("only compiled functions can call this")

    @overload(choice)
    def choose(record: Any, value: Any, array: Any) -> Callable[..., Any]:
        function: Any = having if field in record.fields else lacking

        def call(record: Any, value: Any, array: Any) -> Any:
            return function(record, value, array)

        return call

    return choice
