"""Memory of a device's processes, from /proc: what is their own, in memory or swapped out.

Pages of files, such as libraries, do not count. Where there is no /proc it is not measured.
"""

from contextlib import suppress

from floatref_conformance.devices.descendants import PROC, processes

KEYS = (b"RssAnon:", b"RssShmem:", b"VmSwap:")
"""Lines of /proc/PID/status that count, in kB."""


def memory_of(pid: int) -> int | None:
    """Return the memory in bytes of process ``pid``, its session and its descendants.

    None if it is not known: the processes have ended, or the system has no /proc.
    """
    table = processes()
    ours = {pid} | {p.pid for p in table if p.session == pid}
    while more := {p.pid for p in table if p.parent in ours} - ours:
        ours |= more
    known = [size for each in ours if (size := _memory(each)) is not None]
    return sum(known) if known else None


def _memory(pid: int) -> int | None:
    """Return the memory of one process in bytes; None if it has ended."""
    kilobytes: list[int] = []
    with suppress(OSError):
        lines = (PROC / str(pid) / "status").read_bytes().splitlines()
        kilobytes = [int(line.split()[1]) for line in lines if line.startswith(KEYS)]
    return 1024 * sum(kilobytes) if kilobytes else None
