"""How kernels are compiled: on first use, cached where the folder allows it.

numba itself is imported when the first kernel is called: what only lists pipelines, converts a
file or prints its help does not wait for it.
"""

from collections.abc import Callable
from functools import cache, update_wrapper
from threading import RLock
from typing import Any, Generic, ParamSpec, TypeVar, cast

from floatref.kernels.compilation.code_files import separate_code
from floatref.kernels.compilation.compile_trace import trace_compilation, trace_loads
from floatref.kernels.compilation.garbage import pause_collector
from floatref.kernels.compilation.quick_loads import spare_blas, spare_refreshes

P = ParamSpec("P")
R = TypeVar("R")
OPTIONS: dict[str, Any] = {"nogil": True, "fastmath": {"contract"}, "error_model": "numpy"}
_LOCK = RLock()
_CHOICES: list[Callable[[], None]] = []
"""Choices that numba has not been given yet."""


class Kernel(Generic[P, R]):
    """A function that numba compiles, once for each signature, when it is called.

    Compiled callers take it as numba's own dispatcher, which `dispatcher` makes and returns.
    """

    def __init__(self, function: Callable[P, R], options: dict[str, Any]) -> None:
        """Compile ``function`` with these ``options`` of numba; nothing is done before a call."""
        update_wrapper(self, function)
        inner = function.__name__.startswith("_")
        self.py_func = function
        self._options = {**options, "no_cpython_wrapper": inner, "no_cfunc_wrapper": inner}
        self._dispatcher: Any = None
        self._call: Any = None

    def __call__(self, *args: P.args, **kwargs: P.kwargs) -> R:
        """Return what the compiled function returns."""
        found: R = (self._call or self._load())(*args, **kwargs)
        return found

    def dispatcher(self) -> Any:
        """Return numba's dispatcher of the function.

        numba refuses `cache=True` with RuntimeError when it finds no folder to write to (a
        read-only installation without a home); the kernel is then compiled in every process.
        """
        with _LOCK:
            if self._dispatcher is None:
                njit = _load_numba()
                try:
                    made = njit(cache=True, **self._options)(self.py_func)
                except RuntimeError:
                    made = njit(**self._options)(self.py_func)
                if made is self.py_func:
                    # NUMBA_DISABLE_JIT: numba gives the function itself.
                    self._dispatcher = self._call = made
                    return made
                if made.stats.cache_path is not None:
                    separate_code(made)
                    spare_refreshes(made)
                _take_constants_as_values(made)
                self._dispatcher, self._call = made, trace_loads(made)
            return self._dispatcher

    def _load(self) -> Any:
        self.dispatcher()
        return self._call

    @property
    def signatures(self) -> list[Any]:
        """Types of arguments for which it has been compiled or loaded in this process."""
        return self._dispatcher.signatures if self._dispatcher else []

    def __reduce__(self) -> str:
        """Copy and pickle as a function: by its name."""
        return self.py_func.__qualname__


def compiled(function: Callable[P, R]) -> Callable[P, R]:
    """Return ``function`` compiled on first call, keeping its type.

    A product and a sum may become one fused operation, which rounds once instead of twice; no
    other freedom is given, so infinities, NaN and the order of operations are as written. A
    division by zero gives infinity or NaN, as in numpy: a loop that could raise stays scalar.

    A name with an underscore is called by other kernels alone, and gets no entry from Python: that
    saves a seventh of the compilation time.
    """
    return Kernel(function, OPTIONS)


def compiled_unfused(function: Callable[P, R]) -> Callable[P, R]:
    """Return ``function`` as `compiled` does, with every product and every sum rounded.

    Its results are those of a library that was compiled for any processor.
    """
    return Kernel(function, {**OPTIONS, "fastmath": False})


def chosen(field: str, having: Callable[P, R], lacking: Callable[P, R]) -> Callable[P, R]:
    """Return a function of three arguments for compiled callers, the first of them a record.

    It is ``having`` where the record has a ``field`` of that name, else ``lacking``: that is
    decided when the caller is compiled, for each type of record, and takes no time after that.
    Both have to be in the file of their caller, for the sake of its cache.
    """

    def choice(*_: P.args, **__: P.kwargs) -> R:
        raise NotImplementedError("only compiled functions can call this")

    def choose(record: Any, value: Any, array: Any) -> Callable[..., Any]:
        function: Any = having if field in record.fields else lacking

        def call(record: Any, value: Any, array: Any) -> Any:
            return function(record, value, array)

        return call

    def give() -> None:
        from numba.extending import overload

        overload(choice)(choose)

    with _LOCK:
        _CHOICES.append(give)
    return choice


def stores_code() -> bool:
    """Return whether numba finds a folder in which compiled kernels are stored."""
    # The folder follows from the file of the function, of which nothing is compiled.
    stats = getattr(Kernel(stores_code, OPTIONS).dispatcher(), "stats", None)
    return stats is not None and stats.cache_path is not None


def _load_numba() -> Callable[..., Any]:
    """Return numba's decorator, once numba knows our kernels and choices."""
    from numba import njit

    _introduce_kernels()
    while _CHOICES:
        _CHOICES.pop(0)()
    decorator: Callable[..., Any] = njit
    return decorator


@cache
def _introduce_kernels() -> None:
    """Have numba know kernels, once in a process."""
    from numba import types
    from numba.core import event
    from numba.extending import typeof_impl

    pause_collector(event)
    spare_blas()
    typeof_impl.register(Kernel)(lambda kernel, _: types.Dispatcher(kernel.dispatcher()))
    trace_compilation()


def _take_constants_as_values(dispatcher: Any) -> None:
    """Have ``dispatcher`` compiled once for all integers that a compiled caller writes out.

    numba would compile it again for each: nine times for the places of a matrix.
    """
    from numba import types

    template_of, plain = dispatcher.get_call_template, cast(Any, types).unliteral

    def get_call_template(args: Any, kws: Any) -> Any:
        named = {name: plain(each) for name, each in dict(kws).items()}
        return template_of(tuple(map(plain, args)), named)

    dispatcher.get_call_template = get_call_template
