"""Commands of floatref in processes of their own, which end with this one, however it ends.

Each waits at its standard input, into which nothing is ever written: on every system that ends
with the process that holds the other end, after a SIGKILL too.
"""

import subprocess
import sys
from collections.abc import Sequence
from threading import Lock

from floatref.errors import InputError
from floatref.files.apart.served_reading import end_with_input

GRACE_S = 10.0
"""Longest time in s until a process has ended that was asked to; then it is killed."""
PROGRAM = "from floatref.cli.warm.children import run_as_child; run_as_child()"


class Children:
    """Processes that are started from several threads, and ended together."""

    def __init__(self) -> None:
        """Begin without any."""
        self._lock = Lock()
        self._running: set[subprocess.Popen[str]] = set()
        self._ended = False

    def run(self, words: Sequence[str]) -> None:
        """Run `floatref` with ``words`` to its end; InputError with its last line if it fails."""
        process = self._start(words)
        # Not `communicate`: that would end the child's standard input.
        assert process.stderr is not None
        lines = process.stderr.read().strip().splitlines()
        code = process.wait()
        with self._lock:
            self._running.discard(process)
        assert process.stdin is not None
        process.stdin.close()
        process.stderr.close()
        if code:
            last = lines[-1] if lines else f"exit code {code}"
            raise InputError(last.removeprefix("Error: "))

    def end(self) -> None:
        """End all that run, and start no more."""
        with self._lock:
            self._ended = True
            running = tuple(self._running)
        for process in running:
            process.terminate()
        for process in running:
            try:
                process.wait(GRACE_S)
            except subprocess.TimeoutExpired:
                process.kill()

    def _start(self, words: Sequence[str]) -> "subprocess.Popen[str]":
        with self._lock:
            if self._ended:
                raise InputError("ended before it began")
            process = subprocess.Popen(
                [sys.executable, "-P", "-c", PROGRAM, *words],
                stdin=subprocess.PIPE,
                stdout=subprocess.DEVNULL,
                stderr=subprocess.PIPE,
                encoding="utf-8",
                errors="replace",
            )
            self._running.add(process)
        return process


def run_as_child() -> None:
    """Run the `floatref` command in this process, and end it as soon as its parent has ended."""
    from floatref.cli.program.starting import start

    end_with_input()
    start()
