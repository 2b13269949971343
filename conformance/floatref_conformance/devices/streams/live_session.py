"""One run of a device that streams, in a process of its own: samples in, points out.

The judge does not wait for the answer to each piece: up to `WINDOW` may be unanswered, as with a
device behind a slow line. What a device writes before `synced` is of the samples before that
`sync`, and so all times are recorded time, whatever the speed of the machine.
"""

from collections import deque
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from math import inf
from pathlib import Path
from typing import Any

from floatref_conformance.devices.pipes import Most
from floatref_conformance.devices.process import Child, readable, start
from floatref_conformance.devices.protocol import STOP_S, parse_line
from floatref_conformance.devices.streams.answers import (
    Started,
    kind_of,
    read_number,
    read_points,
    read_started,
)
from floatref_conformance.devices.streams.pieces import Piece
from floatref_conformance.devices.streams.questions import write, write_samples
from floatref_conformance.devices.streams.resident_memory import memory_of
from floatref_conformance.devices.streams.transcript import Given, Transcript
from floatref_conformance.errors import DeviceError, DeviceRefused

WINDOW = 20
"""Pieces that a device may leave unanswered while more are pushed."""
MOST = Most(line=8 << 20, unread=64 << 20, total=4 << 30)
"""What a device may write in a run: an hour of points."""


@dataclass(frozen=True)
class LiveCommand:
    """How a device is started for a run of a stream.

    Attributes:
        argv: the program and its arguments, started without a shell.
        folder: the folder in which it is started.
        limit_s: time in s for an answer, whatever the device does.
        variables: names of variables of the environment that it gets beside the usual ones.
    """

    argv: Sequence[str]
    folder: Path
    limit_s: float
    variables: tuple[str, ...] = ()


class LiveSession:
    """A started stream; any fault ends its process.

    Attributes:
        transcript: what has come back.
    """

    def __init__(self, command: LiveCommand, hello: Mapping[str, Any]) -> None:
        """Start a process and a stream in it; DeviceError in one line, or DeviceHung."""
        self._limit_s = command.limit_s
        self._asked: deque[tuple[int, float]] = deque()
        self._number = 0
        self._has_finished = False
        self._child: Child = start(command.argv, command.folder, command.variables, MOST)
        with self._step():
            self._child.send(write(hello))
            self.transcript = Transcript(self._read_started())

    def push(self, piece: Piece) -> None:
        """Push ``piece``, and wait until no more than `WINDOW` pieces are unanswered."""
        with self._step():
            self._child.send(write_samples(piece.samples))
            self._number += 1
            self._asked.append((self._number, piece.until_s))
            self._child.send(write({"kind": "sync", "number": self._number}))
            while len(self._asked) > WINDOW:
                self._take()

    def look_at_memory(self, at_s: float) -> None:
        """Note the memory of the device's processes, if it is known, at a recorded time."""
        size = memory_of(self._child.pid)
        if size is not None:
            self.transcript.memory_bytes.append((at_s, size))

    def finish(self) -> Transcript:
        """End the run, and return all that came back."""
        with self._step():
            self._child.send(write({"kind": "finish"}))
            while not self._has_finished:
                self._take()
            for line in self._child.finish(STOP_S + self._limit_s):
                raise DeviceError(f"wrote after finished: {readable(line)}")
        return self.transcript

    def kill(self) -> None:
        """End the process at once; harmless if it has ended."""
        self._child.kill()

    def _read_started(self) -> Started:
        answer = self._receive()
        if kind_of(answer) != "started":
            raise DeviceError(f"answered {answer['kind']} to hello, expected started")
        return read_started(answer)

    def _take(self) -> None:
        """Take one answer; one that waits for a sync in vain is a fault."""
        answer = self._receive()
        kind = kind_of(answer)
        if kind == "points":
            until_s = self._asked[0][1] if self._asked else inf
            self.transcript.given.append(Given(read_points(answer), until_s))
        elif kind == "synced":
            self._check_synced(read_number(answer))
        elif kind == "finished":
            if self._asked:
                raise DeviceError("answered finished before it answered every sync")
            self._has_finished = True
        elif kind != "event":
            raise DeviceError(f"answered {kind} during a run")

    def _check_synced(self, number: int) -> None:
        expected = self._asked.popleft()[0] if self._asked else None
        if number != expected:
            raise DeviceError(f"answered sync {number}, expected {expected}")

    def _receive(self) -> Mapping[str, Any]:
        answer = parse_line(self._child.receive(self._limit_s))
        if answer.get("kind") == "refused":
            raise DeviceRefused(f"refused: {readable(str(answer.get('text')), 500)}")
        return answer

    @contextmanager
    def _step(self) -> Iterator[None]:
        """On a fault, kill the device, and add its standard error to the fault."""
        try:
            yield
        except BaseException as fault:
            self._child.kill()
            if isinstance(fault, DeviceError):
                shown = self._child.describe_stderr()
                raise type(fault)(f"stream: {fault}{shown}") from fault
            raise
