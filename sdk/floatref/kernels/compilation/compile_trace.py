"""What numba compiles and what it loads from its cache, printed where the environment asks for it.

`FLOATREF_TRACE=compile` gives a line for each on standard error. A kernel that others call is
compiled within theirs, so that its line stands before theirs, further to the right, and its time is
part of theirs.
"""

import sys
from collections.abc import Callable
from time import perf_counter
from typing import Any

from floatref.values.display.tracing import is_traced

WORD = "compile"


def trace_compilation() -> None:
    """Have every compilation printed from now on, if that is traced."""
    if is_traced(WORD):
        from numba.core import event

        events: Any = event
        events.register("numba:compile", _listener(events.Listener))


def trace_loads(dispatcher: Any) -> Callable[..., Any]:
    """Return ``dispatcher``, or a function that calls it and prints its loads, if traced."""
    if not is_traced(WORD):
        found: Callable[..., Any] = dispatcher
        return found

    def call(*args: Any, **kwargs: Any) -> Any:
        before = set(dispatcher.stats.cache_hits)
        result = dispatcher(*args, **kwargs)
        for types in set(dispatcher.stats.cache_hits) - before:
            _print("loaded  ", dispatcher, types)
        return result

    return call


def _listener(base: Any) -> Any:
    """Return a listener to begin and end of compilations; ``base`` is numba's class of those."""
    begun: list[float] = []

    def on_start(_: Any, event: Any) -> None:
        begun.append(perf_counter())

    def on_end(_: Any, event: Any) -> None:
        taken = perf_counter() - begun.pop()
        depth = "  " * len(begun)
        _print(f"{taken:6.3f} s {depth}", event.data["dispatcher"], event.data["args"])

    return type("Compilations", (base,), {"on_start": on_start, "on_end": on_end})()


def _print(what: str, dispatcher: Any, types: Any) -> None:
    function = dispatcher.py_func
    name = f"{function.__module__}.{function.__qualname__}"
    print(f"compile {what} {name}({', '.join(map(str, types))})", file=sys.stderr)
