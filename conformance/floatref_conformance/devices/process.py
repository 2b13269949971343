"""A device's process: lines in and out within time limits, and an end without remains."""

import atexit
import signal
import subprocess
import sys
from collections.abc import Sequence
from contextlib import suppress
from functools import partial
from pathlib import Path
from time import monotonic

from floatref_conformance.devices.descendants import Descendants
from floatref_conformance.devices.pipes import OF_COMMANDS, Feed, Lines, Most, Tail
from floatref_conformance.errors import DeviceError, DeviceHung
from floatref_conformance.parent_death import killed_with_parent

STEP_S = 0.05
"""Interval in which a silent process is inspected, in s."""
GRACE_S = 1.0
"""Time that a pipe or process may take to end after the processes that use it, in s."""
SHOWN_LINES = 5
SHOWN_LENGTH = 200


def start(
    argv: Sequence[str],
    folder: Path,
    variables: Sequence[str] = (),
    most: Most = OF_COMMANDS,
) -> "Child":
    """Start ``argv`` in ``folder`` without a shell, in a session of its own.

    It gets the ``variables`` beside those that every device gets, and may write ``most``. Raises
    DeviceError if it cannot be started.
    """
    descendants, process = Descendants(variables), None
    try:
        process = subprocess.Popen(
            list(argv),
            bufsize=0,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            cwd=folder,
            env=descendants.environment,
            start_new_session=sys.platform != "win32",
            # No guard beside it: nothing has to be awake when the judge is killed.
            preexec_fn=killed_with_parent(),
        )
        return Child(process, descendants, most)
    except BaseException as error:
        descendants.end(process)
        if isinstance(error, (OSError, ValueError)):
            reason = getattr(error, "strerror", None) or error
            raise DeviceError(f"{argv[0]} cannot be started ({reason})") from error
        raise


class Child:
    """A running process with three pipes, and its descendants."""

    def __init__(
        self, process: "subprocess.Popen[bytes]", descendants: Descendants, most: Most = OF_COMMANDS
    ) -> None:
        """Begin to read what ``process`` writes."""
        if process.stdin is None or process.stdout is None or process.stderr is None:
            raise ValueError("a child needs three pipes")
        self._process, self._descendants = process, descendants
        self._streams = (process.stdin, process.stdout, process.stderr)
        self._fate = ""
        self._is_gone = False
        self._concealed: list[bytes] = []
        self._feed = Feed(process.stdin)
        self._lines = Lines(process.stdout, most)
        self._tail = Tail(process.stderr)
        atexit.register(self.kill)

    @property
    def pid(self) -> int:
        """The id of the process, and of its session where there are sessions."""
        return self._process.pid

    def conceal(self, folder: str) -> None:
        """Replace ``folder``, whose name differs from run to run, by "…" in all output.

        The output that is shown is then cut at the same place in every run.
        """
        if Path(folder).name:
            self._concealed.append(folder.encode())

    def send(self, line: bytes) -> None:
        """Write ``line`` to standard input as soon as the process reads it."""
        self._feed.put(line)

    def receive(self, limit_s: float) -> bytes:
        """Return the next line of standard output without its end.

        Raises DeviceHung if no line comes within ``limit_s``, DeviceError if no line can come.
        """
        limit = monotonic() + limit_s
        while (line := self._lines.take(max(0.0, min(STEP_S, limit - monotonic())))) is None:
            if self._lines.fault:
                raise DeviceError(self._lines.fault)
            if self._lines.ended or self._process.poll() is not None:
                return self._last()
            if monotonic() >= limit:
                raise DeviceHung(f"no answer within {limit_s:g} s{self._unfinished()}")
        return self._neutral(line)

    def finish(self, limit_s: float) -> tuple[bytes, ...]:
        """Close standard input, wait for the end, and return the remaining lines.

        Raises DeviceHung if it does not end within ``limit_s``, DeviceError for a faulty end.
        """
        self._feed.close()
        limit = monotonic() + limit_s
        while self._process.poll() is None and not self._lines.fault:
            if monotonic() >= limit:
                raise DeviceHung(f"still running after {limit_s:g} s")
            with suppress(subprocess.TimeoutExpired):
                self._process.wait(min(STEP_S, limit_s))
        fate = self._fate or _fate(self._process.returncode)
        self.kill()
        if self._lines.fault or fate != _fate(0):
            raise DeviceError(self._lines.fault or fate)
        return tuple(map(self._neutral, iter(partial(self._lines.take, 0.0), None)))

    def kill(self) -> None:
        """Kill the process and its descendants; harmless if they have ended."""
        if self._is_gone:
            return
        self._feed.close()
        self._descendants.end(self._process)
        threads = (self._feed.thread, self._lines.thread, self._tail.thread)
        for thread in threads:
            thread.join(GRACE_S)
        # A thread that still reads from a process that cannot be killed needs its pipe.
        if not any(thread.is_alive() for thread in threads):
            for stream in self._streams:
                stream.close()
        self._is_gone = True
        atexit.unregister(self.kill)

    def describe_stderr(self) -> str:
        """Return the last lines of standard error, to append to a fault; or an empty text."""
        self._tail.settle()
        shown = map(readable, self._neutral(self._tail.end).splitlines())
        lines = [line for line in shown if any(map(str.isalnum, line))]
        return f" ; stderr: {' | '.join(lines[-SHOWN_LINES:])}" if lines else ""

    def _last(self) -> bytes:
        """Return a line that the process wrote before its end; DeviceError without one.

        Other processes with its standard output are killed, so that no output is missed.
        """
        with suppress(subprocess.TimeoutExpired):
            self._process.wait(GRACE_S)
        self._fate = self._fate or _fate(self._process.returncode)
        self.kill()
        line = self._lines.take(0.0)
        if line is None:
            raise DeviceError(
                self._lines.fault or f"{self._fate} before it answered{self._unfinished()}"
            )
        return self._neutral(line)

    def _neutral(self, output: bytes) -> bytes:
        for folder in self._concealed:
            output = output.replace(folder, "…".encode())
        return output

    def _unfinished(self) -> str:
        rest = readable(self._neutral(self._lines.rest))
        return f", in the middle of a line: {rest}" if rest else ""


def readable(text: bytes | str, longest: int = SHOWN_LENGTH) -> str:
    """Return ``text`` on one line of at most ``longest`` printable characters."""
    known = text if isinstance(text, str) else text[: 4 * longest].decode("utf-8", "replace")
    words = "".join(c if c.isprintable() else " " for c in known[: 4 * longest]).split()
    line = " ".join(words)
    return line if len(line) <= longest else f"{line[: longest - 1]}…"


def _fate(status: int | None) -> str:
    if status is None:
        return "closed its standard output"
    if status >= 0:
        return f"exited with status {status}"
    try:
        return f"was killed by {signal.Signals(-status).name}"
    except ValueError:
        return f"was killed by signal {-status}"
