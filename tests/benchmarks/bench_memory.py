"""Measure the memory of ``floatref process`` on a long drive that is streamed from disk.

Two wheel paths at 16 kHz with a stop every two minutes and 50 km/h on average, written to a
temporary folder in pieces and processed by a fresh process. Prints its peak resident memory, the
size of the profile (9 bytes per point and wheel path), what is beyond that, and the time taken.
Run as ``python tests/benchmarks/bench_memory.py [--seconds 3600] [--pipeline temporal-basic]``,
with TMPDIR naming a folder with room for 2.3 GB per hour, and three times that for a pipeline
that goes over the run in time more than once.
"""

import argparse
import json
import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np
from timing import RUN

RATE_HZ, COUNT_M, MEAN_SPEED_MPS = 16_000, 0.0003, 50 / 3.6
CYCLE_S = (0.0, 85.0, 97.0, 105.0, 120.0)
"""Drive, brake, stand, and speed up again."""
SPEEDS = np.array([1.0, 1.0, 0.0, 0.0, 1.0])
PIECE = 1 << 20
POINT_BYTES = 9
QUANTITIES = (("vertical_specific_force", "m/s^2"), ("height", "m"))
TRACKS = ("left", "right")
LIMIT_MB = 300


def cruise_mps() -> float:
    """The speed between stops that gives the mean speed."""
    return MEAN_SPEED_MPS * CYCLE_S[-1] / float(np.trapezoid(SPEEDS, CYCLE_S))


def write_document(folder: Path) -> None:
    """Describe the sample files."""
    clock = {"rate_hz": RATE_HZ, "start_s": 0.0}
    channels = [{"name": "distance", "unit": "m", "file": "distance.f64", **clock}]
    for track in TRACKS:
        for name, unit in QUANTITIES:
            file = f"{track}.{name}.f64"
            channels.append({"name": name, "unit": unit, "track": track, "file": file, **clock})
    document = {"format": "floatref-recording/1", "channels": channels}
    (folder / "recording.json").write_text(json.dumps(document))


def write_samples(folder: Path, seconds: float) -> None:
    """Write all channels, a piece at a time."""
    rng, travelled = np.random.default_rng(0), 0.0
    count = round(seconds * RATE_HZ)
    for first in range(0, count, PIECE):
        times = np.arange(first, min(first + PIECE, count)) / RATE_HZ
        speed = cruise_mps() * np.interp(times % CYCLE_S[-1], CYCLE_S, SPEEDS)
        distance = travelled + np.cumsum(speed) / RATE_HZ
        travelled = float(distance[-1])
        append(folder / "distance.f64", COUNT_M * np.floor(distance / COUNT_M))
        for track in TRACKS:
            force, height = rng.standard_normal((2, times.size))
            append(folder / f"{track}.vertical_specific_force.f64", 9.80665 + 0.3 * force)
            append(folder / f"{track}.height.f64", 0.3 + 1e-4 * height)


def append(path: Path, samples: np.ndarray) -> None:
    with path.open("ab") as stream:
        stream.write(samples.astype("<f8").tobytes())


def processed(source: Path, out: Path, pipeline: str) -> dict:
    """Run the command, and return what it prints."""
    arguments = ["process", str(source), "--out", str(out), "--pipeline", pipeline, "--json"]
    done = subprocess.run([sys.executable, "-c", RUN, *arguments], stdout=subprocess.PIPE)
    if done.returncode:
        sys.exit(done.returncode)
    return json.loads(done.stdout)


def main() -> None:
    """Write the drive, process it and print one line for each figure."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seconds", type=float, default=3600.0)
    parser.add_argument("--pipeline", default="temporal-adaptive-hpf-spatial-backward")
    given = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="floatref-memory-") as name:
        folder = Path(name)
        (folder / "drive").mkdir()
        write_document(folder / "drive")
        write_samples(folder / "drive", given.seconds)
        begin = time.perf_counter()
        report = processed(folder / "drive", folder / "profile", given.pipeline)
        taken = time.perf_counter() - begin
    points = round(report["length_m"] / report["interval_m"]) + 1
    show(given, taken, points * POINT_BYTES * len(TRACKS))


def show(given: argparse.Namespace, taken: float, profile: int) -> None:
    """Print the figures; the only child was the command."""
    unit = 1 if sys.platform == "darwin" else 1024
    peak = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss * unit
    samples = round(given.seconds * RATE_HZ) * 8 * (1 + len(TRACKS) * len(QUANTITIES))
    print(f"{given.pipeline}: {given.seconds:g} s at {RATE_HZ / 1000:g} kHz, two wheel paths")
    print(f"  samples on disk {samples / 1e6:9.1f} MB")
    print(f"  peak resident   {peak / 1e6:9.1f} MB")
    print(f"  profile         {profile / 1e6:9.1f} MB")
    print(f"  beyond profile  {(peak - profile) / 1e6:9.1f} MB   (limit {LIMIT_MB})")
    print(f"  wall time       {taken:9.1f} s   ({given.seconds / taken:.0f} x real time)")


if __name__ == "__main__":
    main()
