"""Time the start of the commands as whole processes, beside a bare Python.

Prints medians in seconds. Run as ``python tests/benchmarks/bench_startup.py``.
"""

import statistics
import subprocess
import sys
import sysconfig
import time
from pathlib import Path

ROUNDS = 11
SCRIPTS = Path(sysconfig.get_path("scripts"))
COMMANDS = {
    "python -c pass": [sys.executable, "-c", "pass"],
    "floatref --help": [str(SCRIPTS / "floatref"), "--help"],
    "conformance --help": [str(SCRIPTS / "conformance"), "--help"],
    "import floatref": [sys.executable, "-c", "import floatref"],
    "import numba, scipy.signal": [sys.executable, "-c", "import numba, scipy.signal"],
}


def median_seconds(command: list[str]) -> float:
    """Median of several runs after one warm-up."""
    taken = []
    for _ in range(ROUNDS + 1):
        begin = time.perf_counter()
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
        taken.append(time.perf_counter() - begin)
    return statistics.median(taken[1:])


if __name__ == "__main__":
    for name, command in COMMANDS.items():
        print(f"  {name:28} {median_seconds(command):6.3f} s")
