"""A signal that comes while a compiled kernel is loaded ends the command, and not the process."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

pytestmark = pytest.mark.posix

KERNEL = """
from numba import njit

@njit(cache=True)
def double(x):
    return 2 * x

double(1.0)
"""
LOADED = """
import click, signal
from numba.core.codegen import CPUCodeLibrary
from floatref.cli.batch.interruption import interruptible
from floatref.cli.program.interrupts import Interrupt, raising_interrupt

find, asked = CPUCodeLibrary._object_getbuffer_hook.__func__, []

def find_and_hear(cls, module):
    asked.append(module)
    if len(asked) == 3:  # The kernel's own; before it come two that numba shares.
        signal.raise_signal(signal.SIGTERM)
    return find(cls, module)

CPUCodeLibrary._object_getbuffer_hook = classmethod(find_and_hear)
try:
    with {handler}:
        import kernel, time
        for _ in range(1200):  # One call would not end by a signal just before it.
            time.sleep(0.05)
except Interrupt:
    print("Interrupted")
except click.exceptions.Exit:
    pass
"""


@pytest.mark.slow
@pytest.mark.parametrize(
    "handler", ["raising_interrupt()", "raising_interrupt(), interruptible(lambda: 'Interrupted')"]
)
def test_a_signal_while_a_kernel_is_loaded_comes_behind_that(tmp_path: Path, handler: str) -> None:
    """Its exception was dropped within a call from LLVM, and numba wrote to the address 0."""
    (tmp_path / "kernel.py").write_text(KERNEL, encoding="utf-8")
    words = [sys.executable, "-c", "import kernel"]
    where = {"cwd": tmp_path, "env": {**os.environ, "NUMBA_CACHE_DIR": str(tmp_path / "cache")}}
    subprocess.run(words, check=True, **where)
    words[-1] = LOADED.format(handler=handler)
    done = subprocess.run(words, capture_output=True, text=True, timeout=600, check=False, **where)
    assert (done.returncode >= 0, done.stdout + done.stderr) == (True, "Interrupted\n")
