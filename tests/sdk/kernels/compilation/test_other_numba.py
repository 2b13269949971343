"""A numba without one of the private names that speed up loading: kernels compile, load and run."""

from types import SimpleNamespace
from typing import Any

import numba.np
import numpy as np
import pytest
from numba.core.caching import IndexDataCacheFile
from numba.np import arraymath, linalg

from floatref.kernels import compiling
from floatref.kernels.compilation.code_files import CodeFiles, separate_code
from floatref.kernels.compilation.quick_loads import spare_blas, spare_refreshes

OF_LOADS = [("_cache",), ("_cache", "_load_overload")]
OF_LOADS += [("_cache", "_guard_against_spurious_io_errors")]
OF_FILES = [("_cache",), ("_cache", "_cache_file"), ("_cache", "_impl")]
OF_FILES += [("_cache", "_impl", "filename_base")]
OF_FILES += [("_cache", "_cache_file", name) for name in ("_cache_path", "_source_stamp")]


class Lacking:
    """An object without the attribute that a path of names leads to; writing goes to the object."""

    def __init__(self, whole: Any, path: tuple[str, ...]) -> None:
        vars(self).update(whole=whole, path=path)

    def __getattr__(self, name: str) -> Any:
        if name != self.path[0]:
            return getattr(self.whole, name)
        if len(self.path) == 1:
            raise AttributeError(name)
        return Lacking(getattr(self.whole, name), self.path[1:])

    def __setattr__(self, name: str, value: Any) -> None:
        setattr(self.whole, name, value)


def total(x):
    """Return the sum of ``x``."""
    result = 0.0
    for k in range(x.size):
        result += x[k]
    return result


def runs_and_loads() -> Any:
    """Compile a kernel, load it again as another process does, and return its dispatcher."""
    for hits in ([], [1]):
        kernel: Any = compiling.compiled(total)
        assert kernel(np.arange(5.0)) == 10.0
        assert list(kernel.dispatcher().stats.cache_hits.values()) == hits
    return kernel.dispatcher()


@pytest.fixture(autouse=True)
def _folder(tmp_path, monkeypatch):
    monkeypatch.setattr("numba.config.CACHE_DIR", str(tmp_path))


@pytest.mark.parametrize("path", OF_LOADS, ids=".".join)
def test_a_kernel_loads_without_a_name_of_loading(monkeypatch, path):
    monkeypatch.setattr(
        compiling, "spare_refreshes", lambda made: spare_refreshes(Lacking(made, path))
    )
    assert "load_overload" not in vars(runs_and_loads()._cache)


@pytest.mark.parametrize("path", OF_FILES, ids=".".join)
def test_a_kernel_is_stored_without_a_name_of_files(monkeypatch, path):
    monkeypatch.setattr(compiling, "separate_code", lambda made: separate_code(Lacking(made, path)))
    assert type(runs_and_loads()._cache._cache_file) is IndexDataCacheFile


def test_files_of_another_kind_stay_as_they_are():
    class Newer:
        _cache_path, _source_stamp = "", 7

    newer = Newer()
    cache = SimpleNamespace(_cache_file=newer, _impl=SimpleNamespace(filename_base="total"))
    separate_code(SimpleNamespace(_cache=cache))
    assert cache._cache_file is newer


def test_with_all_names_loading_is_quick_and_code_has_files_of_its_own():
    cache = runs_and_loads()._cache
    assert "load_overload" in vars(cache)
    assert type(cache._cache_file) is CodeFiles


def test_without_the_search_for_blas_numba_is_left_alone(monkeypatch):
    of_arrays = arraymath.ensure_blas
    monkeypatch.setattr(numba.np, "linalg", Lacking(linalg, ("ensure_blas",)))
    spare_blas()
    assert arraymath.ensure_blas is of_arrays
    runs_and_loads()
