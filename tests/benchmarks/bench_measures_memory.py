"""Measure the peak memory of the commands that measure a profile, on an hour of road.

Writes 72 km of two wheel paths with 1-σ, a stop every 2.4 km whose points are not valid, at 25 mm
and at 5.08 mm, to a temporary folder in pieces; the reference of `compare` is the same road,
measured again. Each command runs in a fresh process. Prints its time and peak resident memory, as
the system counts it for a process that has ended, and VmHWM of ``/proc`` where there is one, read
while it runs. Run as ``python tests/benchmarks/bench_measures_memory.py [--length 72000]
[--only "65 m apart"]``, with TMPDIR naming a folder with room for 1.2 GB.
"""

import argparse
import json
import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np
from bench_memory import append
from timing import RUN

INTERVALS_M = (0.025, 0.00508)
TRACKS = ("left", "right")
STOP_EVERY_M, STOP_M = 2400.0, 15.0
SLOPE = 0.002
"""Standard deviation of the slope over 1 m, white along the road: about 2 m/km of IRI."""
PERIOD_M = 400.0
SIGMA_M = 0.0005
PIECE = 1 << 20
LIMIT_MB = 600
COMMANDS = {
    "iri": ["iri"],
    "iri by segment": ["iri", "--segment", "100"],
    "roughness": ["roughness"],
    "straightedge": ["straightedge"],
}


OFFSETS_M = {"compare": 0.0, "between points": 0.0017, "65 m apart": 65.0013}
"""By how much the profile lies farther along than the reference of `compare`."""


def write_profile(folder: Path, length_m: float, interval_m: float, error_m: float = 0.0) -> Path:
    """Write two wheel paths with an error of measurement, and the document that lists them."""
    folder.mkdir()
    count = round(length_m / interval_m) + 1
    errors = np.random.default_rng(9)
    for seed, name in enumerate(TRACKS):
        road, level = np.random.default_rng(seed), 0.0
        for first in range(0, count, PIECE):
            places = interval_m * np.arange(first, min(first + PIECE, count))
            steps = SLOPE * np.sqrt(interval_m) * road.standard_normal(places.size)
            rough = level + np.cumsum(steps)
            level = float(rough[-1])
            z = rough + 0.5 * np.sin(2.0 * np.pi * places / PERIOD_M)
            append(folder / f"{name}.f64", z + error_m * errors.standard_normal(places.size))
            append(folder / f"{name}.sigma.f64", np.full(places.size, SIGMA_M))
            valid = places % STOP_EVERY_M > STOP_M
            with (folder / f"{name}.valid.u8").open("ab") as stream:
                stream.write(valid.astype(np.uint8).tobytes())
    write_document(folder, interval_m)
    return folder


def write_document(folder: Path, interval_m: float, start_m: float = 0.0) -> None:
    """Describe the files of the profile, whose first point is at ``start_m``."""
    tracks = [
        {
            "name": name,
            "elevation_file": f"{name}.f64",
            "valid_file": f"{name}.valid.u8",
            "sigma_file": f"{name}.sigma.f64",
        }
        for name in TRACKS
    ]
    document = {"format": "floatref-profile/1", "interval_m": interval_m, "start_m": start_m}
    document["tracks"] = tracks
    (folder / "profile.json").write_text(json.dumps(document))


def main() -> None:
    """Write both profiles, run every command, and print one line for each."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--length", type=float, default=72_000.0)
    parser.add_argument("--only", choices=[*COMMANDS, *OFFSETS_M], help="Run one of them.")
    given = parser.parse_args()
    print(f"{given.length:g} m, two wheel paths with 1-sigma (limit {LIMIT_MB} MB)")
    for interval_m in INTERVALS_M:
        with tempfile.TemporaryDirectory(prefix="floatref-measures-") as name:
            profile = write_profile(Path(name) / "run", given.length, interval_m)
            again = write_profile(Path(name) / "again", given.length, interval_m, 1e-4)
            for what, words in COMMANDS.items():
                if given.only in (None, what):
                    show(interval_m, what, *words, str(profile))
            for what, start_m in OFFSETS_M.items():
                write_document(profile, interval_m, start_m)
                if given.only in (None, what):
                    show(interval_m, what, "compare", str(again), str(profile))


def show(interval_m: float, what: str, *words: str) -> None:
    """Run a command and print its time and peak memory."""
    seconds, peak_mb, sampled_mb = measure(*words, "--json")
    peaks = f"{peak_mb:8.1f} MB, VmHWM {sampled_mb:8.1f} MB"
    print(f"{1000.0 * interval_m:6g} mm  {what:14} {seconds:7.1f} s {peaks}", flush=True)


def measure(*words: str) -> tuple[float, float, float]:
    """Run a command; return its seconds, its peak resident memory, and that read while it ran."""
    begin, sampled_mb = time.perf_counter(), 0.0
    command = [sys.executable, "-c", RUN, *words]
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL)
    while True:
        ended, status, usage = os.wait4(process.pid, os.WNOHANG)
        if ended:
            break
        sampled_mb = max(sampled_mb, high_water_mb(process.pid))
        time.sleep(0.01)
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode:
        raise SystemExit(f"{' '.join(words)}: exit code {process.returncode}")
    unit = 1 if sys.platform == "darwin" else 1024
    return time.perf_counter() - begin, usage.ru_maxrss * unit / 1e6, sampled_mb


def high_water_mb(pid: int) -> float:
    """Return VmHWM of a process in MB; 0 without ``/proc``, or once it has ended."""
    try:
        lines = Path(f"/proc/{pid}/status").read_text().splitlines()
    except OSError:
        return 0.0
    return next((int(x.split()[1]) * 1024 / 1e6 for x in lines if x.startswith("VmHWM")), 0.0)


if __name__ == "__main__":
    main()
