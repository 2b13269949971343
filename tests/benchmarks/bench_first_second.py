"""Time whole processes from their start, with nothing compiled and with everything.

`floatref process` runs on three minutes of driving with a stop, two wheel paths at 16 kHz, and on
half of it; what the line through both leaves for no driving at all is the start-up. `--verdict`
adds the README's first command, `conformance run --seed 0`, as it runs after installation: nothing
compiled, nothing simulated. Prints seconds by the clock and of the processor, medians of three runs
where everything is compiled. Run as ``python tests/benchmarks/bench_first_second.py [--verdict]``.
"""

import argparse
import os
import shutil
import statistics
import sys
import tempfile
from collections.abc import Mapping
from pathlib import Path

from bench_growth import shorten
from kind_drives import KIND
from timing import RUN, seconds_of

import floatref
from floatref_conformance.proving_ground.scenario import Scenario
from floatref_conformance.proving_ground.simulate import simulate

PIPELINES = (
    "road-prior-smoother",
    "temporal-adaptive-hpf-spatial-backward",
    "kalman-smoother-reflection",
)
COMPILED = 3
"""Runs with everything compiled."""
DRIVE = Scenario(manoeuvre="stop", speed_kmh=72.0, length_m=3300.0, **KIND)
Taken = tuple[float, float]
"""Seconds by the clock, and of the processor."""


def process(drive: Path, pipeline: str, environment: Mapping[str, str]) -> Taken:
    """Return what `floatref process` takes for ``drive``."""
    words = ["process", str(drive), "--out", f"{drive}-profile", "--overwrite", "--json"]
    command = [sys.executable, "-c", RUN, *words, "--pipeline", pipeline]
    return seconds_of(command, dict(environment))


def middle(runs: list[Taken]) -> Taken:
    """Return the median of each clock."""
    wall, processor = (statistics.median(column) for column in zip(*runs, strict=True))
    return wall, processor


def show(what: str, taken: Taken) -> None:
    print(f"  {what:64} {taken[0]:6.2f} s, {taken[1]:6.2f} s of the processor", flush=True)


def report(pipeline: str, folder: Path) -> None:
    """Print what a pipeline takes cold, compiled, and before it reads a sample."""
    environment = {**os.environ, "NUMBA_CACHE_DIR": str(folder / f"cache-{pipeline}")}
    show(f"{pipeline}, nothing compiled", process(folder / "whole", pipeline, environment))
    whole, half = (
        middle([process(folder / name, pipeline, environment) for _ in range(COMPILED)])
        for name in ("whole", "half")
    )
    show(f"{pipeline}, compiled", whole)
    show(f"{pipeline}, start-up", (2.0 * half[0] - whole[0], 2.0 * half[1] - whole[1]))


def report_verdict(folder: Path) -> None:
    """Print what the first command after installation takes."""
    caches = {"NUMBA_CACHE_DIR": str(folder / "kernels"), "FLOATREF_CACHE": str(folder / "judge")}
    command = [sys.executable, "-m", "floatref_conformance", "run", "--seed", "0"]
    # A verdict of FAIL is exit code 1.
    taken = seconds_of(command, {**os.environ, **caches}, codes=(0, 1))
    show("conformance run --seed 0", taken)


def main() -> None:
    """Report on every pipeline, or on the judge."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--verdict", action="store_true")
    given = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="floatref-first-") as name:
        folder = Path(name)
        if given.verdict:
            report_verdict(folder)
            return
        recording = simulate(DRIVE).recording
        begin_s, end_s = recording.channel("distance").span_s
        print(f"{end_s - begin_s:.0f} s of driving, two wheel paths at 16 kHz")
        floatref.write_recording(recording, folder / "whole")
        shutil.copytree(folder / "whole", folder / "half")
        shorten(folder / "half", 0.5)
        for pipeline in PIPELINES:
            report(pipeline, folder)


if __name__ == "__main__":
    main()
