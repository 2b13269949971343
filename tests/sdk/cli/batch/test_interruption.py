"""An interruption ends the work even where the exception gets lost."""

import signal
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


LEFT = """
import multiprocessing, os, signal, time
from pathlib import Path
from floatref.cli.batch.interruption import interruptible

def sleep_on():
    time.sleep(60.0)

if __name__ == "__main__":
    with interruptible(lambda: "the line"):
        try:
            os.kill(os.getpid(), signal.SIGTERM)
            time.sleep(300.0)
        finally:
            # What a cluster does whose worker a signal to all has ended.
            child = multiprocessing.get_context("spawn").Process(target=sleep_on, daemon=True)
            child.start()
            time.sleep(1.0)
            status = Path(f"/proc/{child.pid}/status")
            if status.exists():
                print(status.read_text().partition("SigIgn:")[2].split()[0])
"""


def test_a_worker_that_is_started_behind_the_signal_ends_too(tmp_path) -> None:
    """With SIGTERM ignored it would hear none, and Python would wait for it for ever."""
    script = tmp_path / "left.py"
    script.write_text(LEFT, encoding="utf-8")
    done = subprocess.run(
        [sys.executable, str(script)], capture_output=True, text=True, timeout=200, check=False
    )
    assert "the line" in done.stderr
    assert int(done.stdout or "0", 16) & (1 << signal.SIGTERM - 1) == 0
