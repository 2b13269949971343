"""`floatref warm` that is killed or interrupted: what it has started ends with it.

Law: whatever ends the command, no process of it goes on, and the next one sweeps what it left.
"""

import os
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

import pytest

from floatref.cli.warm.children import Children
from floatref.errors import InputError

pytestmark = pytest.mark.posix
PIPELINE = "road-prior-smoother"
"""Compiles for a minute where nothing is compiled."""
WAIT_S = ENDS_S = 120.0
"""Where it hangs: a busy machine takes its time, and the command gives its children 10 s to end."""


def processes_in(folder: Path) -> set[int]:
    """Return the processes that have ``folder`` for their temporary files."""
    found = set()
    for entry in Path("/proc").glob("[0-9]*"):
        with suppress(OSError):
            if os.fsencode(folder) in (entry / "environ").read_bytes():
                found.add(int(entry.name))
    return found


def has_children(folder: Path, parent: int) -> bool:
    """Return whether the run of a child has been written, and the child is there."""
    return any(folder.glob("*/*-run")) and len(processes_in(folder) - {parent}) > 0


@contextmanager
def warming(folder: Path) -> Iterator[subprocess.Popen[str]]:
    """Yield the command once its child is compiling."""
    environment = {"TMPDIR": str(folder), "NUMBA_CACHE_DIR": str(folder / "cache")}
    command = [sys.executable, "-m", "floatref", "warm", PIPELINE]
    with subprocess.Popen(
        command, env=os.environ | environment, stderr=subprocess.PIPE, encoding="utf-8"
    ) as process:
        try:
            wait_until(lambda: has_children(folder, process.pid), WAIT_S)
            assert process.poll() is None
            yield process
        finally:
            for each in processes_in(folder):
                with suppress(ProcessLookupError):
                    os.kill(each, signal.SIGKILL)


def wait_until(is_so, longest_s: float) -> None:
    until_s = time.monotonic() + longest_s
    while not is_so():
        assert time.monotonic() < until_s
        time.sleep(0.02)


@pytest.mark.slow
@pytest.mark.parametrize("number", [signal.SIGKILL, signal.SIGTERM, signal.SIGINT])
def test_what_it_has_started_ends_with_it(tmp_path: Path, number: int) -> None:
    with warming(tmp_path) as process:
        process.send_signal(number)
        code = process.wait(ENDS_S)
        wait_until(lambda: not processes_in(tmp_path), ENDS_S)
        assert code == (-number if number == signal.SIGKILL else 130)
        if number != signal.SIGKILL:
            assert [path.name for path in tmp_path.iterdir() if path.name != "cache"] == []


def test_a_child_that_fails_is_its_last_line() -> None:
    with pytest.raises(InputError, match=r"^no-such: not found$"):
        Children().run(["process", "no-such", "--out", "nothing"])


def test_none_is_started_after_the_end() -> None:
    children = Children()
    children.end()
    with pytest.raises(InputError, match="ended before it began"):
        children.run(["adapters"])
