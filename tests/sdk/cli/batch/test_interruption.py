"""An interruption ends the work even where the exception gets lost."""

import subprocess
import sys

import pytest

from floatref.cli.batch.interruption import LATE

pytestmark = pytest.mark.posix

LOST = """
import os, signal, sys, time
from floatref.cli.batch.interruption import interruptible

class Finalizer:
    def __del__(self):
        os.kill(os.getpid(), signal.SIGINT)
        [0 for _ in range(10**6)]

with interruptible(lambda: "never", ending_s=0.5):
    sys.unraisablehook = lambda error: print(type(error.exc_value).__name__, flush=True)
    Finalizer()
    while True:
        time.sleep(0.05)
"""


def test_an_exception_that_python_drops_ends_the_work_later() -> None:
    """Python drops what a signal raises in a finalizer; after that, no signal is heard."""
    done = subprocess.run(
        [sys.executable, "-c", LOST], capture_output=True, text=True, timeout=600, check=False
    )
    assert done.stdout == "Interrupt\n"
    assert done.returncode == 130
    assert done.stderr == LATE.format(0.5)
