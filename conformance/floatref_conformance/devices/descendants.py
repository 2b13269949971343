"""Find and kill all processes that a device has started.

On Linux the judge adopts them while a device runs: a process that outlives its parent becomes a
child of the judge, even after several forks, and is found there. On other systems the device's
process group is killed, which a process can leave.
"""

import ctypes
import os
import re
import secrets
import signal
import subprocess
import sys
import time
from collections.abc import Iterable
from contextlib import suppress
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from threading import Lock

from floatref.files.owners import is_abandoned, owner_mark
from floatref_conformance.devices.environment import environment_of

MARK = "FLOATREF_DEVICE"
"""Environment variable that identifies the device to which a process belongs."""
MARKED = re.compile(MARK.encode() + rb"=(?P<owner>[0-9a-f]{8}-[0-9]+-[0-9]+)-[0-9a-f]+")
"""That variable, with the mark of the judge that started the device."""
PATIENCE_S = 10.0
"""Time in s to kill processes that do not end, or that fork as fast as they end."""
PROC = Path("/proc")
PR_SET_CHILD_SUBREAPER = 36

_adopting = Lock()
_marks: set[bytes] = set()


@dataclass(frozen=True)
class Process:
    """A process in /proc: its id, the id of its parent, and its session."""

    pid: int
    parent: int
    session: int


class Descendants:
    """The processes of one device, which has to be started with `environment`.

    Create the object before the device starts: children that the judge has at that time do not
    belong to the device. A later child belongs to it, unless it is in the judge's session, which
    no process can enter, or has the mark of another device.
    """

    def __init__(self, variables: Iterable[str] = ()) -> None:
        """Begin to adopt orphans; kill what judges that were killed have left running."""
        _kill_abandoned()
        self._variables = tuple(variables)
        self._mark = f"{MARK}={owner_mark()}-{secrets.token_hex(8)}".encode()
        self._others = frozenset(p.pid for p in processes() if p.parent == os.getpid())
        with _adopting:
            _marks.add(self._mark)
            _adopt(True)

    @property
    def environment(self) -> dict[str, str]:
        """The environment for the device: what it is allowed, its ``variables``, and the mark."""
        name, _, value = self._mark.decode().partition("=")
        return {**environment_of(self._variables), name: value}

    def end(self, device: "subprocess.Popen[bytes] | None") -> None:
        """Kill ``device`` and its descendants, and wait until they have ended."""
        try:
            if device is not None:
                self._end(device)
        finally:
            with _adopting:
                _marks.discard(self._mark)
                _adopt(bool(_marks))

    def _end(self, device: "subprocess.Popen[bytes]") -> None:
        if device.poll() is None:
            _kill_group(device)
        limit = time.monotonic() + PATIENCE_S
        while time.monotonic() < limit:
            has_ended = device.poll() is not None
            remaining = self._find_remaining(device)
            if has_ended and not remaining:
                return
            for process in remaining:
                _kill(process, device.pid)
            time.sleep(0.002)

    def _find_remaining(self, device: "subprocess.Popen[bytes]") -> list[Process]:
        """Return the device's processes that still exist, also ended ones to be waited for."""
        table = processes()
        running = {device.pid} if device.returncode is None else set()
        ours = running | {p.pid for p in table if self._is_orphan(p) and p.pid != device.pid}
        while more := {p.pid for p in table if p.parent in ours} - ours:
            ours |= more
        return [p for p in table if p.pid in ours]

    def _is_orphan(self, process: Process) -> bool:
        if process.parent != os.getpid() or process.pid in self._others:
            return False
        return process.session != os.getsid(0) and not _has_mark(process, _marks - {self._mark})


def processes() -> list[Process]:
    """Return all processes in /proc; empty where this folder does not exist."""
    if not sys.platform.startswith("linux") or not PROC.is_dir():
        return []
    found = []
    for entry in os.listdir(PROC):
        if entry.isdigit():
            with suppress(OSError):
                # The name of the program, in brackets, may itself hold brackets and spaces.
                _, _, rest = (PROC / entry / "stat").read_bytes().rpartition(b")")
                _, parent, _, session = rest.split()[:4]
                found.append(Process(int(entry), int(parent), int(session)))
    return found


def _has_mark(process: Process, marks: Iterable[bytes]) -> bool:
    with suppress(OSError):
        return not set(marks).isdisjoint(
            (PROC / f"{process.pid}/environ").read_bytes().split(b"\0")
        )
    return False


@cache
def _kill_abandoned() -> None:
    """Kill processes of devices whose judge does not run any more, once in a process.

    A device ends with its judge; what it has started itself, or left before, may not.
    """
    for process in processes():
        with suppress(OSError):
            words = (PROC / f"{process.pid}/environ").read_bytes().split(b"\0")
            found = next(filter(None, map(MARKED.fullmatch, words)), None)
            if found and is_abandoned(found["owner"].decode("ascii")):
                os.kill(process.pid, signal.SIGKILL)


def _kill(process: Process, device: int) -> None:
    """Kill ``process``, and wait for it if it is an adopted child of this process."""
    with suppress(ProcessLookupError, PermissionError):
        os.kill(process.pid, signal.SIGKILL)
    if process.parent == os.getpid() and process.pid != device:
        with suppress(ChildProcessError):
            os.waitpid(process.pid, os.WNOHANG)


def _kill_group(device: "subprocess.Popen[bytes]") -> None:
    if sys.platform == "win32":
        command = ["taskkill", "/F", "/T", "/PID", str(device.pid)]
        subprocess.run(command, capture_output=True, check=False)
        device.kill()
    else:
        with suppress(ProcessLookupError, PermissionError):
            os.killpg(device.pid, signal.SIGKILL)


def _adopt(wanted: bool) -> None:
    """Make this process adopt orphans, or stop adopting them."""
    if sys.platform.startswith("linux"):
        with suppress(OSError, AttributeError):
            ctypes.CDLL(None).prctl(PR_SET_CHILD_SUBREAPER, int(wanted), 0, 0, 0)
