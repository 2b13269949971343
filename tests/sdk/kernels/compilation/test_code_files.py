"""Processes that compile one kernel at once find their own code afterwards, or none.

They are two threads here, whose steps, those of numba, come in every order there is.
"""

import itertools
import threading

import numpy as np
import pytest
from numba.core.caching import IndexDataCacheFile

from floatref.kernels.compilation.code_files import CodeFiles
from floatref.kernels.compiling import compiled

STEPS = ("_load_index", "_save_index", "_save_data")
ORDERS = [
    tuple("ab"[k not in of_a] for k in range(2 * len(STEPS)))
    for of_a in itertools.combinations(range(2 * len(STEPS)), len(STEPS))
]
KEYS = {"a": ("float64", "this processor"), "b": ("int64", "this processor")}
WAIT_S = 60.0


@pytest.fixture
def files(tmp_path):
    """Return what makes the files of a process."""
    return lambda: CodeFiles(IndexDataCacheFile(str(tmp_path), "total-3.py311", 7), "total-3.py311")


class Turns:
    """Lets the steps of two threads go on in an order."""

    def __init__(self, order):
        self.rest, self.changed = list(order), threading.Condition()

    def step(self, function):
        def stepped(*args):
            name = threading.current_thread().name
            with self.changed:
                if name in KEYS:
                    assert self.changed.wait_for(lambda: self.rest[:1] == [name], WAIT_S)
                    self.rest.pop(0)
                result = function(*args)
                self.changed.notify_all()
            return result

        return stepped


@pytest.mark.parametrize("order", ORDERS, ids="".join)
def test_code_is_that_of_its_types_in_every_order(files, monkeypatch, order):
    turns = Turns(order)
    for name in STEPS:
        monkeypatch.setattr(IndexDataCacheFile, name, turns.step(getattr(IndexDataCacheFile, name)))
    threads = [
        threading.Thread(target=files().save, args=(key, f"code of {name}"), name=name)
        for name, key in KEYS.items()
    ]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(WAIT_S)
    assert not turns.rest
    for name, key in KEYS.items():
        assert files().load(key) == f"code of {name}"


@pytest.mark.parametrize("suffix", [".nbi", ".nbc"])
@pytest.mark.parametrize("size", [0, 1, -1])
def test_a_file_that_was_cut_is_not_there(files, tmp_path, suffix, size):
    files().save(KEYS["a"], "code")
    (path,) = tmp_path.glob(f"*{suffix}")
    path.write_bytes(path.read_bytes()[:size])
    assert files().load(KEYS["a"]) is None
    files().save(KEYS["a"], "new code")
    assert files().load(KEYS["a"]) == "new code"


def test_what_cannot_be_written_ends_nothing(files, monkeypatch):
    def full(*_):
        raise OSError("No space left on device")

    monkeypatch.setattr(IndexDataCacheFile, "_save_data", full)
    files().save(KEYS["a"], "code")
    assert files().load(KEYS["a"]) is None


def test_code_of_another_source_or_that_is_forgotten_is_none(files, tmp_path):
    files().save(KEYS["a"], "code")
    newer = CodeFiles(IndexDataCacheFile(str(tmp_path), "total-3.py311", 8), "total-3.py311")
    assert newer.load(KEYS["a"]) is None
    files().flush()
    assert files().load(KEYS["a"]) is None


def total(x):
    """Return the sum of ``x``."""
    result = 0.0
    for k in range(x.size):
        result += x[k]
    return result


def test_a_kernel_loads_what_another_has_compiled(tmp_path, monkeypatch):
    monkeypatch.setattr("numba.config.CACHE_DIR", str(tmp_path))
    for hits in (0, 1):
        kernel = compiled(total)
        for kind in (np.float64, np.int64):
            assert kernel(np.arange(5, dtype=kind)) == 10.0
        assert list(kernel.dispatcher().stats.cache_hits.values()) == [hits] * 2 * hits
