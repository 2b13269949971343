"""Kernels compile with a cache, and without one where no folder can hold it."""

import numba
import pytest

from floatref.kernels import compiling


def doubled(x: float) -> float:
    return 2.0 * x


def test_a_compiled_function_gives_the_same_result():
    assert compiling.compiled(doubled)(1.5) == doubled(1.5)


@pytest.fixture
def without_folder(monkeypatch):
    """Let numba find no folder for its cache; return what was asked of it."""
    asked, njit = [], numba.njit

    def without_folder(**options):
        asked.append(options.get("cache", False))
        if options.get("cache"):
            raise RuntimeError("cannot cache function: no locator available")
        return njit(**options)

    monkeypatch.setattr(numba, "njit", without_folder)
    return asked


def test_without_a_folder_for_the_cache_it_still_compiles(without_folder):
    assert compiling.compiled(doubled)(1.5) == 3.0
    assert without_folder == [True, False]


def test_code_is_stored_where_there_is_a_folder_for_it(tmp_path, monkeypatch):
    monkeypatch.setattr(numba.config, "CACHE_DIR", str(tmp_path))
    assert compiling.stores_code()


def test_no_code_is_stored_without_a_folder(without_folder):
    assert not compiling.stores_code()


def test_no_code_is_stored_where_nothing_is_compiled(monkeypatch):
    monkeypatch.setattr(numba.config, "DISABLE_JIT", True)
    assert not compiling.stores_code()


def test_where_numba_is_told_to_compile_nothing_the_function_itself_is_called(monkeypatch):
    monkeypatch.setattr(numba.config, "DISABLE_JIT", True)
    assert compiling.compiled(doubled)(1.5) == 3.0


@pytest.mark.parametrize("value", [float("nan"), float("inf")])
def test_nan_and_infinity_survive_compilation(value):
    def passed(x: float) -> bool:
        return x != x or x == float("inf")

    assert compiling.compiled(passed)(value)
