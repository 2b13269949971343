"""`FLOATREF_TRACE=compile` prints what is compiled and what is loaded, and nothing is lost."""

import subprocess
import sys
from pathlib import Path

import pytest

from floatref.kernels.compiling import compiled

PROGRAM = """
import numpy as np
from floatref.kernels.compiling import compiled

@compiled
def _inner(x, place: int) -> float:
    return 2.0 * x[place]

@compiled
def outer(x) -> float:
    return _inner(x, 0) + _inner(x, 1)

print(outer(np.array([1.0, 2.0])))
"""


@pytest.mark.slow
def test_a_kernel_is_compiled_once_for_all_constants_and_then_loaded(tmp_path: Path, monkeypatch):
    (tmp_path / "program.py").write_text(PROGRAM)
    monkeypatch.setenv("FLOATREF_TRACE", "compile")
    monkeypatch.setenv("NUMBA_CACHE_DIR", str(tmp_path / "cache"))
    words = [sys.executable, str(tmp_path / "program.py")]
    first, second = (
        subprocess.run(words, capture_output=True, text=True, check=True) for _ in range(2)
    )
    assert first.stdout == second.stdout == "6.0\n"
    inner, outer = first.stderr.splitlines()
    assert "_inner(array(float64, 1d, C), int64)" in inner
    assert outer.endswith("outer(array(float64, 1d, C))")
    assert outer.index("__main__") < inner.index("__main__")
    assert second.stderr == "compile loaded   __main__.outer(array(float64, 1d, C))\n"


def test_nothing_is_printed_unless_it_is_asked_for(monkeypatch, capsys):
    monkeypatch.setenv("FLOATREF_TRACE", "hooks")
    assert compiled(lambda x: x + 1.0)(1.0) == 2.0
    assert capsys.readouterr() == ("", "")
