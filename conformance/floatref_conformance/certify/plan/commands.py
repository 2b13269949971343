"""The floatref command as a program of its own, a few at a time; all end with this process."""

import os
import subprocess
import sys
import threading
from dataclasses import dataclass

COMMAND = (sys.executable, "-P", "-m", "floatref")
"""-P: a folder called floatref in the current folder is not taken for the package."""

LONGEST_S = 24 * 3600.0
"""Longest time in s of one command; one that takes longer hangs."""


class Stopped(Exception):
    """The command is not run any more."""


@dataclass(frozen=True)
class Answer:
    """What a command printed on stdout, and its error in one line, empty if it did its work."""

    output: str
    error: str = ""


class Commands:
    """Runs floatref commands, from any thread; on leaving the context all of them are ended."""

    def __init__(self) -> None:
        """Nothing runs yet."""
        self._lock = threading.Lock()
        self._running: set[subprocess.Popen[str]] = set()
        self._stopped = False

    def __enter__(self) -> "Commands":
        """Return itself."""
        return self

    def __exit__(self, *raised: object) -> None:
        """End what runs, and let nothing start any more."""
        with self._lock:
            self._stopped = True
            for process in self._running:
                process.kill()

    def run(self, *words: str) -> Answer:
        """Run ``floatref WORDS`` to its end; Stopped once the context was left."""
        process = self._start(words)
        try:
            output, text = process.communicate(timeout=LONGEST_S)
        except subprocess.TimeoutExpired:
            process.kill()
            return Answer("", f"floatref was ended: not done after {LONGEST_S / 3600:g} h")
        finally:
            with self._lock:
                self._running.discard(process)
        return Answer(output, _complaint(process.returncode, text))

    def _start(self, words: tuple[str, ...]) -> subprocess.Popen[str]:
        with self._lock:
            if self._stopped:
                raise Stopped
            process = subprocess.Popen(
                [*COMMAND, *words],
                stdin=subprocess.DEVNULL,
                stdout=subprocess.PIPE,
                stderr=subprocess.PIPE,
                encoding="utf-8",
                errors="replace",
                env={**os.environ, "PYTHONIOENCODING": "utf-8:backslashreplace"},
            )
            self._running.add(process)
            return process


def _complaint(code: int, text: str) -> str:
    """Return in one line why a command ended with ``code``; nothing for 0."""
    if code == 0:
        return ""
    if code < 0:
        return f"floatref was ended by signal {-code}{' (out of memory?)' * (code == -9)}"
    lines = [line for line in text.splitlines() if line.strip()] or [f"exit code {code}"]
    return " ".join(lines[-1].removeprefix("Error: ").split())
