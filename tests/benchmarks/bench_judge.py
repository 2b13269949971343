"""`conformance run` on a built-in device: compiled code cached, recordings not.

`python tests/benchmarks/bench_judge.py [certification]`
"""

import json
import os
import subprocess
import sys
import sysconfig
import tempfile
import time
from pathlib import Path

CONFORMANCE = Path(sysconfig.get_path("scripts")) / "conformance"
DEVICES = (
    "builtin:temporal-adaptive-hpf-spatial-backward",
    "builtin:spatial-hpf-timer-distortion-reflection",
)


def judged(device: str, *options: str) -> tuple[float, str, int]:
    """Return wall time in s, verdict and number of cases of one run."""
    with tempfile.TemporaryDirectory() as folder:
        environment = {**os.environ, "FLOATREF_CACHE": f"{folder}/cache"}
        command = [str(CONFORMANCE), "run", "--device", device, "--report", folder, *options]
        started = time.perf_counter()
        subprocess.run(command, stdout=subprocess.DEVNULL, env=environment, check=False)
        seconds = time.perf_counter() - started
        report = json.loads(Path(folder, "report.json").read_text(encoding="utf-8"))
    return seconds, report["verdict"], sum(check["cases"] for check in report["checks"])


def main() -> None:
    """Print wall time, verdict and number of cases for each device."""
    effort = sys.argv[1] if len(sys.argv) > 1 else "quick"
    judged(DEVICES[0], "--check", "quiescent")
    for device in DEVICES:
        seconds, verdict, cases = judged(device, "--effort", effort)
        print(f"{device}, {effort}: {seconds:.0f} s, {cases} cases, {verdict}", flush=True)


if __name__ == "__main__":
    main()
