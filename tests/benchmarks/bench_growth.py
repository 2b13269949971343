"""Measure how time and memory of `floatref process` grow with the length and with the wheel paths.

One drive of two minutes from stop to stop, that of `bench_kalman_memory`, is written again and
again until it is long enough, or its left wheel path under other names. Each run is a process of
its own. Prints seconds of the processor and by the clock, and the peak of memory beyond the
profile, and the exponent of the time in the length behind the start. What is written after each
run is kept if a later one fails. Run as

    python tests/benchmarks/write_figures.py --only growth

which writes the table and the plot of docs/performance-growth.md, or alone with ``[--hours 12]
[--paths 8] [--json growth.json] [--plot growth.png]``. TMPDIR names a folder with room for 6 GB per
hour: 2.3 GB of the recording, the only one at a time, and what the pipeline keeps to read again.
With ``--along 1`` the long runs have one wheel path and take 60 % of it.
"""

import argparse
import os
import shutil
import subprocess
import sys
import tempfile
import time
from dataclasses import replace
from pathlib import Path
from types import MappingProxyType

import numpy as np
from bench_kalman_memory import CYCLE_S, lengthen, piece
from growth_runs import COLUMNS, Found, Run, as_json, plot, row, summary
from machine import Others, commit, load, where
from timing import RUN

import floatref

PIPELINES = ("temporal-adaptive-hpf-spatial-backward", "road-prior-smoother")
MINUTES = (1, 2, 4, 8, 16, 30, 60, 120, 240, 480, 720)
PATHS = (1, 2, 4, 8)
PATHS_MINUTES = 8
NEEDED = ("vertical_specific_force", "height")


def with_paths(recording: floatref.Recording, count: int) -> floatref.Recording:
    """Return ``recording`` with its left wheel path under ``count`` names, and its encoder.

    Each sensor has a little noise of its own: equal samples are refused. Each path has the place of
    the left one: without it the fit of a stop ends at no vehicle, and takes all its passes.
    """
    draw = np.random.default_rng(0)
    channels = [recording.channel("distance", "left")]
    for name in NEEDED:
        own = recording.channel(name, "left")
        channels += [
            replace(
                own,
                id=floatref.ChannelId(name, f"path{k}"),
                values=own.values + 1e-5 * draw.standard_normal(own.values.size),
            )
            for k in range(count)
        ]
    setup = recording.setup
    tracks = {f"path{k}": setup.tracks["left"] for k in range(count)}
    return replace(
        recording, channels=tuple(channels), setup=replace(setup, tracks=MappingProxyType(tracks))
    )


def write_pieces(folder: Path) -> None:
    """Write the drive of two minutes with each number of wheel paths into ``folder``."""
    one = piece("road-prior-smoother")
    for count in sorted({2, *PATHS}):
        floatref.write_recording(with_paths(one, count), folder / str(count))


def measure(folder: Path, paths: int, seconds: float, pipeline: str) -> Run:
    """Return what `floatref process` takes for ``seconds`` of the drive, with ``paths``."""
    drive, out = folder / "drive", folder / "profile"
    shutil.copytree(folder / str(paths), drive)
    lengthen(drive, seconds)
    shorten(drive, min(seconds / CYCLE_S, 1.0))
    # What is still to be written would be written meanwhile.
    os.sync()
    words = ["process", str(drive), "--out", str(out), "--pipeline", pipeline, "--json"]
    begin, others = time.perf_counter(), Others()
    child = subprocess.Popen([sys.executable, "-c", RUN, *words], stdout=subprocess.DEVNULL)
    _, status, used = os.wait4(child.pid, 0)
    clock_s, busy = time.perf_counter() - begin, others.processors()
    if status:
        sys.exit(1)
    sizes = [sum(f.stat().st_size for f in of.glob("*.[fu]*")) / 1e6 for of in (out, drive)]
    for done in (drive, out):
        shutil.rmtree(done)
    processor_s = used.ru_utime + used.ru_stime
    return Run(seconds, paths, processor_s, clock_s, used.ru_maxrss * 1024 / 1e6, *sizes, busy)


def shorten(drive: Path, share: float) -> None:
    """Leave the first ``share`` of every file in ``drive``."""
    for file in drive.glob("*.f64"):
        os.truncate(file, 8 * round(share * file.stat().st_size / 8))


def main() -> None:
    """Measure, print and plot."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--pipeline", choices=floatref.pipelines(), action="append")
    parser.add_argument("--hours", type=float, default=12.0)
    parser.add_argument("--paths", type=int, default=max(PATHS))
    parser.add_argument("--along", type=int, default=2, choices=PATHS, help="paths of long runs")
    parser.add_argument("--json", type=Path)
    parser.add_argument("--plot", type=Path)
    parser.add_argument("--write", type=Path, help=argparse.SUPPRESS)
    given = parser.parse_args()
    if given.write:
        write_pieces(given.write)
        return
    found: Found = {"lengths": {}, "paths": {}}
    machine = {**where(), "commit": commit(), "load": load()}
    print(f"| {' | '.join(COLUMNS)} |\n|{'---|' * len(COLUMNS)}")
    with tempfile.TemporaryDirectory(prefix="floatref-growth-") as name:
        # A process whose parent is large counts as large itself: another one simulates.
        subprocess.run([sys.executable, __file__, "--write", name], check=True)
        for kind, pipeline, paths, seconds in plan(given):
            if not found[kind].get(pipeline):
                measure(Path(name), paths, CYCLE_S, pipeline)  # Compiles.
            found[kind].setdefault(pipeline, []).append(
                measure(Path(name), paths, seconds, pipeline)
            )
            print(f"| {' | '.join(row(pipeline, found[kind][pipeline][-1]))} |", flush=True)
            if given.json:
                given.json.write_text(as_json(machine, found), encoding="utf-8")
    for pipeline, runs in found["lengths"].items():
        print(summary(pipeline, runs))
    if given.plot:
        plot(found, given.plot)


def plan(given: argparse.Namespace) -> list[tuple[str, str, int, float]]:
    """Return what is varied, the pipeline, the wheel paths and the length in s of each run."""
    runs = []
    for pipeline in given.pipeline or PIPELINES:
        minutes = [m for m in MINUTES if m <= 60.0 * given.hours]
        runs += [("lengths", pipeline, given.along, 60.0 * m) for m in minutes]
        counts = [c for c in PATHS if c <= given.paths]
        runs += [("paths", pipeline, c, 60.0 * PATHS_MINUTES) for c in counts]
    return runs


if __name__ == "__main__":
    main()
