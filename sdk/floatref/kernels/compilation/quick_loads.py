"""What numba does before it loads a compiled kernel, without what the kernel does not need.

These savings use names that numba does not promise. Where one is missing, as in another version,
numba does all that it does by itself: a load takes longer, and nothing else changes.
"""

from typing import Any
from weakref import WeakSet

_READY: WeakSet[Any] = WeakSet()
"""Contexts of numba that know their declarations."""
PARTS_OF_A_LOAD = ("_load_overload", "_guard_against_spurious_io_errors")
"""Names of numba's cache that `spare_refreshes` needs."""


def spare_blas() -> None:
    """Have numba find BLAS when something asks for it: kernels never do.

    numba looks for it when its functions of arrays are imported, and loads the whole of
    `scipy.linalg` for that, a fifth of a second. scipy is there, as we depend on it. Code of others
    that takes products of matrices finds BLAS as before.
    """
    from numba.np import linalg

    # Stubs of numba do not name its inner functions.
    module: Any = linalg
    found = getattr(module, "ensure_blas", None)
    if found is None:
        return
    module.ensure_blas = lambda: None
    try:
        from numba.np import arraymath
    finally:
        module.ensure_blas = found
    functions: Any = arraymath
    functions.ensure_blas = found


def spare_refreshes(dispatcher: Any) -> None:
    """Have ``dispatcher`` refresh the context of numba for its first load alone.

    numba looks for new declarations of functions before each load, in a dozen registries. Code that
    is loaded does not need them, and before anything is compiled numba looks for itself.
    """
    cache: Any = getattr(dispatcher, "_cache", None)
    if not all(hasattr(cache, name) for name in PARTS_OF_A_LOAD):
        return

    def load_overload(types: Any, context: Any) -> Any:
        if context not in _READY:
            context.refresh()
            _READY.add(context)
        with cache._guard_against_spurious_io_errors():
            return cache._load_overload(types, context)

    cache.load_overload = load_overload
