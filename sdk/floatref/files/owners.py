"""Names of unfinished files that tell who makes them, so that a killed one's can be removed.

A name holds a mark of the machine, the process and when that started, as
`.floatref-1a2b3c4d-4711-98765-d41d8cd98f00.erd`. What is marked by a process of this machine that
does not run any more is left behind. Marks of other machines, which may share the folder, are never
judged, and neither are those made where there is no /proc.
"""

import os
import re
import secrets
import shutil
from contextlib import suppress
from functools import cache
from hashlib import sha256
from pathlib import Path

PREFIX = ".floatref-"
"""How the names of unfinished files and folders beside their targets begin."""
PROC = Path("/proc")
NAME = re.compile(r"\.?floatref-(?P<mark>[0-9a-f]{8}-[0-9]+-[0-9]+)-")
UNKNOWN = "0"
"""The time of a start where the system does not tell it."""

_swept: set[tuple[int, str]] = set()


def owner_mark() -> str:
    """Return the mark of this process: its machine, its number and when it started."""
    pid = os.getpid()
    return f"{_machine()}-{pid}-{_start_of(pid) or UNKNOWN}"


def own_name(prefix: str = PREFIX, suffix: str = "") -> str:
    """Return a new name that begins with ``prefix`` and has the mark of this process."""
    return f"{prefix}{owner_mark()}-{secrets.token_hex(6)}{suffix}"


def is_abandoned(mark: str) -> bool:
    """Return whether ``mark`` is that of a process of this machine that does not run any more."""
    machine, pid, start = mark.split("-")
    if machine != _machine() or start == UNKNOWN or not _start_of(os.getpid()):
        return False
    found = _start_of(int(pid))
    return found is not None and found != start


def sweep_once(folder: Path) -> None:
    """Remove what killed processes left in ``folder``, the first time that this process asks."""
    key = (os.getpid(), str(folder))
    if key in _swept:
        return
    _swept.add(key)
    with suppress(OSError), os.scandir(folder) as entries:
        for entry in entries:
            found = NAME.match(entry.name)
            if found and is_abandoned(found["mark"]) and _is_ours(entry):
                _remove(entry)


def _is_ours(entry: "os.DirEntry[str]") -> bool:
    """Return whether ``entry`` is of this user: the processes of others may be out of sight."""
    return entry.stat(follow_symlinks=False).st_uid == os.getuid()


def _remove(entry: "os.DirEntry[str]") -> None:
    with suppress(OSError):
        if entry.is_dir(follow_symlinks=False):
            shutil.rmtree(entry.path, ignore_errors=True)
        else:
            os.unlink(entry.path)


def _start_of(pid: int) -> str | None:
    """Return when process ``pid`` started, in ticks since the system did; "" if it does not run.

    One that has ended and waits for its parent does not run. None if the system does not say, as
    where this process may open no more files: then nothing is known of ``pid``.
    """
    try:
        # The name of the program, in brackets, may itself hold brackets and spaces.
        _, _, rest = (PROC / str(pid) / "stat").read_bytes().rpartition(b")")
        fields = rest.split()
        return "" if fields[0] in (b"Z", b"X") else fields[19].decode("ascii")
    except (FileNotFoundError, ProcessLookupError):
        return ""
    except (OSError, IndexError):
        return None


@cache
def _machine() -> str:
    """Return eight digits of this machine, its present start, and this table of processes."""
    parts = [os.uname().nodename] if hasattr(os, "uname") else []
    with suppress(OSError):
        parts.append((PROC / "sys/kernel/random/boot_id").read_text(encoding="ascii"))
        parts.append(os.readlink(PROC / "self/ns/pid"))
    return sha256("\n".join(parts).encode()).hexdigest()[:8]
