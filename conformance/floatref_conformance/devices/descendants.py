"""The processes that come from a device, wherever they hide, and their end.

On Linux the judge adopts them while a device runs: whoever outlives its parent becomes a child
of the judge, however often it forked, and is found there. Elsewhere the device's process group
is ended, which a process can leave.
"""

import ctypes
import os
import secrets
import signal
import subprocess
import sys
import time
from collections.abc import Iterable
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from threading import Lock

from floatref_conformance.proving_ground.cache import FOLDER_VARIABLE

MARK = "FLOATREF_DEVICE"
"""Environment variable by which a device's processes are told from those of another device."""
PATIENCE_S = 10.0
"""How long processes that do not die, or fork as fast as they die, are hunted."""
PROC = Path("/proc")
PR_SET_CHILD_SUBREAPER = 36

_adopting = Lock()
_marks: set[bytes] = set()


@dataclass(frozen=True)
class Process:
    """A line of /proc: who it is, whose child, and in which session."""

    pid: int
    parent: int
    session: int


class Descendants:
    """What comes from one device, which is to be started with `environment`.

    Made before the device is started: children that the judge has by then are not the device's.
    A child that it gets later is, unless it shares the judge's session, which no process can
    enter, or bears another device's mark.
    """

    def __init__(self) -> None:
        """Begin to adopt orphans."""
        self._mark = f"{MARK}={secrets.token_hex(8)}".encode()
        self._others = frozenset(p.pid for p in processes() if p.parent == os.getpid())
        with _adopting:
            _marks.add(self._mark)
            _adopt(True)

    @property
    def environment(self) -> dict[str, str]:
        """The environment for the device: ours and its mark, but not where the cache is."""
        name, _, value = self._mark.decode().partition("=")
        ours = {n: v for n, v in os.environ.items() if n != FOLDER_VARIABLE}
        return {**ours, name: value}

    def end(self, device: "subprocess.Popen[bytes] | None") -> None:
        """Kill ``device`` and all that comes from it, and wait until they are gone."""
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
            left = self._remaining(device)
            if has_ended and not left:
                return
            for process in left:
                _kill(process, device.pid)
            time.sleep(0.002)

    def _remaining(self, device: "subprocess.Popen[bytes]") -> list[Process]:
        """Return the device's processes that are still there, dead ones that wait for us too."""
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
    """Return all processes that /proc tells of; none where there is no such folder."""
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


def _kill(process: Process, device: int) -> None:
    """Kill ``process``, and let it go if it is a child of ours that nobody else waits for."""
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
    """Have orphans come to this process, or no longer."""
    if sys.platform.startswith("linux"):
        with suppress(OSError, AttributeError):
            ctypes.CDLL(None).prctl(PR_SET_CHILD_SUBREAPER, int(wanted), 0, 0, 0)
