"""Kernels compile with a cache, and without one where no folder can hold it."""

import numba
import pytest

from floatref.kernels import compiling


def doubled(x: float) -> float:
    return 2.0 * x


def test_a_compiled_function_gives_the_same_result():
    assert compiling.compiled(doubled)(1.5) == doubled(1.5)


def test_without_a_folder_for_the_cache_it_still_compiles(monkeypatch):
    asked, njit = [], numba.njit

    def without_folder(**options):
        asked.append(options.get("cache", False))
        if options.get("cache"):
            raise RuntimeError("cannot cache function: no locator available")
        return njit(**options)

    monkeypatch.setattr(numba, "njit", without_folder)
    assert compiling.compiled(doubled)(1.5) == 3.0
    assert asked == [True, False]


def test_where_numba_is_told_to_compile_nothing_the_function_itself_is_called(monkeypatch):
    monkeypatch.setattr(numba.config, "DISABLE_JIT", True)
    assert compiling.compiled(doubled)(1.5) == 3.0


@pytest.mark.parametrize("value", [float("nan"), float("inf")])
def test_nan_and_infinity_survive_compilation(value):
    def passed(x: float) -> bool:
        return x != x or x == float("inf")

    assert compiling.compiled(passed)(value)
