"""The machine on which a benchmark runs: what it is, and how busy others keep it.

The load average of a minute counts the benchmark itself. `Others` counts what the kernel says that
all processors did, without what this process and the processes that it started have used.
"""

import os
import platform
import resource
import subprocess
import time
from importlib.metadata import version
from pathlib import Path

ROOT = Path(__file__).parents[2]
IDLE = 0.5
"""Load average of a minute above which a machine is not idle, before anything is started."""
BUSY = 0.1
"""Processors that others may keep busy while a benchmark runs."""
PACKAGES = ("numpy", "scipy", "numba")


def where() -> dict[str, str | int]:
    """Return the processor and its count, the versions, and the date."""
    lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
    model = [line.partition(":")[2].strip() for line in lines if line.startswith("model name")]
    return {
        "taken": time.strftime("%Y-%m-%d", time.gmtime()),
        "processor": model[0] if model else platform.processor(),
        "cores": os.cpu_count() or 1,
        "python": platform.python_version(),
        **{name: version(name) for name in PACKAGES},
    }


def commit() -> str:
    """Return the commit of the tree, with a plus where files differ from it."""
    command = ["git", "describe", "--always", "--abbrev=8", "--dirty=+"]
    return subprocess.run(
        command, cwd=ROOT, capture_output=True, text=True, check=True
    ).stdout.strip()


def load() -> float:
    """Return the load average of the last minute."""
    return round(os.getloadavg()[0], 2)


class Others:
    """How many processors others keep busy, from its making on."""

    def __init__(self) -> None:
        """Start."""
        self._begun = time.perf_counter(), busy_s() - own_s()

    def processors(self) -> float:
        """Return the mean until now; what the kernel rounds may leave it a little below zero."""
        passed = time.perf_counter() - self._begun[0]
        return max(busy_s() - own_s() - self._begun[1], 0.0) / max(passed, 1e-9)


def busy_s() -> float:
    """Return for how long all processors have worked since the start of the system, in s.

    Time that a host took from a virtual machine (steal) counts: somebody else had it.
    """
    first = Path("/proc/stat").read_text(encoding="utf-8").split("\n", 1)[0]
    user, nice, system, _, _, irq, soft, steal = map(int, first.split()[1:9])
    return (user + nice + system + irq + soft + steal) / os.sysconf("SC_CLK_TCK")


def own_s() -> float:
    """Return what this process and those that it started and that have ended used, in s."""
    used = [resource.getrusage(w) for w in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)]
    return sum(each.ru_utime + each.ru_stime for each in used)
