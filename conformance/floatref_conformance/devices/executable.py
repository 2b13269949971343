"""Devices that are programs, such as firmware on a PC or a gateway to a box."""

import os
import shlex
import shutil
import sys
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from floatref.errors import InputError
from floatref.files import read_recording
from floatref_conformance.devices.interface import DeviceKind
from floatref_conformance.devices.protocol import RUN_PER_LENGTH, RUN_S, START_S, STOP_S, Session
from floatref_conformance.errors import DeviceError


@dataclass(eq=False)
class ExecDevice:
    """A program that follows the protocol; after a fault it is restarted for the next run.

    Attributes:
        argv: the program and its arguments, started without a shell.
        folder: the folder in which it is started.
        timeout_s: time for `run` in s; None for 60 s plus twice the recording's length.
        start_s, stop_s: times for `start` and `stop`, in s.
        variables: names of variables of the environment that it gets beside the usual ones.
    """

    argv: tuple[str, ...]
    folder: Path
    timeout_s: float | None = None
    start_s: float = START_S
    stop_s: float = STOP_S
    variables: tuple[str, ...] = ()
    _session: Session | None = field(default=None, init=False, repr=False)
    _description: Mapping[str, Any] | None = field(default=None, init=False, repr=False)

    def describe(self) -> Mapping[str, Any]:
        """Return the program's description of itself; DeviceError without a usable one."""
        return self._start().device

    @property
    def live_argv(self) -> tuple[str, ...] | None:
        """The command line for a stream: the same one, if the program declares `streaming`.

        None if it does not. DeviceError without a usable description.
        """
        # Once described, a program that was stopped is not started again to be asked.
        about = self.describe() if self._description is None else self._description
        declared = about.get("streaming", False)
        if not isinstance(declared, bool):
            raise DeviceError(
                f"gives a description with streaming {declared!r}; give true or false"
            )
        return self.argv if declared else None

    def run(self, recording: Path, profile: Path) -> None:
        """Let the program process ``recording``; DeviceError, DeviceHung or DeviceSkipped."""
        self._start().run(recording, profile, limit_of(recording, self.timeout_s))

    def close(self) -> None:
        """Stop the program and all its processes; DeviceError if it does not stop properly."""
        session, self._session = self._session, None
        if session is not None:
            session.stop(self.stop_s)

    def _start(self) -> Session:
        if self._session is None or self._session.is_over:
            self._session = Session(self.argv, self.folder, self.start_s, self.variables)
            self._description = self._description or self._session.device
        if self._session.device != self._description:
            raise DeviceError("start: the description differs from that at the first start")
        return self._session


def limit_of(recording: Path, timeout_s: float | None) -> float:
    """Return the time in s that a program has for ``recording``: ``timeout_s`` if it is given."""
    return RUN_S + RUN_PER_LENGTH * length_s(recording) if timeout_s is None else timeout_s


def length_s(recording: Path) -> float:
    """Return the time in s from the first to the last sample of the longest channel."""
    spans = (channel.span_s for channel in read_recording(recording).channels)
    return max(end - begin for begin, end in spans)


def make(command_line: str) -> ExecDevice:
    """Return the device of ``command_line``; InputError if there is no such program."""
    spec = f"device exec:{command_line}"
    try:
        words = _words(command_line)
    except ValueError as error:
        raise InputError(f"{spec}: {error}; quote as in a POSIX shell") from error
    if not words or not words[0]:
        raise InputError(f"{spec}: no command; give the program and its arguments")
    program = shutil.which(words[0])
    if program is None:
        raise InputError(f"{spec}: {_missing(words[0])}")
    return ExecDevice((os.path.abspath(program), *words[1:]), Path.cwd())


def _words(command_line: str) -> list[str]:
    if sys.platform != "win32":
        return shlex.split(command_line)
    words = shlex.split(command_line, posix=False)
    return [w[1:-1] if len(w) > 1 and w[0] == w[-1] and w[0] in "'\"" else w for w in words]


def _missing(command: str) -> str:
    if os.path.isdir(command):
        return f"{command} is a folder; give the program in it"
    if os.path.isfile(command) and os.path.dirname(command):
        return f"{command} may not be executed; make it executable (chmod +x)"
    if os.path.isfile(command):
        return f"command {command} not found; for the file in this folder write ./{command}"
    return f"command {command} not found; check its name and the current folder"


EXEC = DeviceKind("exec", "COMMAND LINE", make)
