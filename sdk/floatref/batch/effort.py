"""What a file costs: time, processor time, bytes and memory."""

import os
import sys
from collections.abc import Iterable
from contextlib import suppress
from dataclasses import replace
from pathlib import Path
from time import perf_counter, process_time

from floatref.batch.job import Job
from floatref.batch.record import Effort, Record


class Watch:
    """Measures from when it is made."""

    def __init__(self) -> None:
        """Start to measure."""
        self._seconds, self._cpu_s = perf_counter(), _cpu_s()

    def told(self, record: Record, job: Job) -> Record:
        """Return ``record`` with its effort until now."""
        effort = Effort(
            seconds=perf_counter() - self._seconds,
            cpu_s=_cpu_s() - self._cpu_s,
            bytes_in=_bytes(map(Path, record.inputs)),
            bytes_out=_bytes(job.profile / name for name in record.outputs),
            peak_bytes=peak_bytes(),
        )
        return replace(record, effort=effort)


def peak_bytes() -> int:
    """Return the largest resident memory of this process until now; 0 where nobody counts it."""
    if sys.platform == "win32":
        return 0
    import resource

    largest = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    return largest if sys.platform == "darwin" else largest << 10


def _cpu_s() -> float:
    """Return the processor time in s of this process, and of those that it has started."""
    spent = os.times()
    return process_time() + spent.children_user + spent.children_system


def _bytes(paths: Iterable[Path]) -> int:
    total = 0
    for path in paths:
        with suppress(OSError):
            total += os.stat(path).st_size
    return total
