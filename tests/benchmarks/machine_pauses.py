"""Find when the machine itself stood still, by a process that does nothing but sleep.

On a virtual machine with a quota of processor time all its processes stop together until the next
period begins. A pause that this process has seen is none of the program that is measured. It has
the highest priority where the system lets it.
"""

import json
import os
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

NAP_S = 1e-3
LATE_S = 3e-3
"""Naps that end later than this count as a pause; the system's own timer is late by 0.1 ms."""
PRIORITY = 50


@dataclass
class Pauses:
    """Pauses in s of `time.perf_counter`, which on Linux all processes share: shape (n, 2)."""

    spans: list[tuple[float, float]] = field(default_factory=list)

    def shares(self, begins: NDArray[np.float64], ends: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return how many seconds of each span the machine stood still: shape (n,)."""
        paused = np.zeros(begins.size)
        for begin, end in self.spans:
            paused += np.clip(np.minimum(ends, end) - np.maximum(begins, begin), 0.0, None)
        return paused


@contextmanager
def measured_pauses() -> Iterator[Pauses]:
    """Yield what is filled with the pauses when the block ends."""
    pauses = Pauses()
    pipes = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE}
    with subprocess.Popen([sys.executable, __file__], **pipes) as process:
        try:
            yield pauses
        finally:
            said, _ = process.communicate()
            pauses.spans += [(begin, end) for begin, end in json.loads(said)]


def watch() -> None:
    """Sleep until the standard input is closed, then print the pauses as JSON."""
    with suppress(OSError, AttributeError):
        os.sched_setscheduler(0, os.SCHED_FIFO, os.sched_param(PRIORITY))
    os.set_blocking(sys.stdin.fileno(), False)
    spans, before = [], time.perf_counter()
    while True:
        time.sleep(NAP_S)
        now = time.perf_counter()
        if now - before > NAP_S + LATE_S:
            spans.append((before, now))
        before = now
        with suppress(BlockingIOError):
            if not os.read(sys.stdin.fileno(), 1):
                break
    print(json.dumps(spans))


if __name__ == "__main__":
    watch()
