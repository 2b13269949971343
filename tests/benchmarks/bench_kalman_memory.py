"""Measure the memory of a smoother's pipeline on a long drive that is streamed from disk.

Two wheel paths at 16 kHz with a stop every two minutes and 50 km/h on average: one simulated
piece from stop to stop on a road that repeats itself, written again and again; with the channels
of an inertial unit and GNSS only where the pipeline takes them. Prints the peak resident memory of
``floatref process`` and the time it takes, and by how much the first minutes differ from what the
fixed-interval smoother, which waits for the last reading, makes of them. Run as
``python tests/benchmarks/bench_kalman_memory.py [--pipeline NAME] [--seconds 3600] [--compared
360]``, with TMPDIR naming a folder with room for 10 GB per hour (3 GB with nominal sensors).
"""

import argparse
import os
import subprocess
import sys
import tempfile
import time
from dataclasses import replace
from pathlib import Path
from unittest import mock

import numpy as np
from kind_drives import KIND
from timing import RUN

import floatref
from floatref.files import read_recording, write_recording
from floatref.values.clock import StampedClock
from floatref_conformance.proving_ground.roads.road import Road
from floatref_conformance.proving_ground.scenario import Scenario
from floatref_conformance.proving_ground.simulate import simulate
from floatref_conformance.proving_ground.staging import drive_of, road_of

LIMITS_MB = {"kalman-smoother-reflection": 1000, "road-prior-smoother": 350 + 335}
"""Peak memory of an hour by pipeline; of the second 350 beyond the profile and its 1-sigma."""
PIPELINE = "kalman-smoother-reflection"
NOMINAL = "road-prior-smoother"
CYCLE_S, CYCLE_M, DWELL_S, SPEED_KMH = 120.0, 6000 / 3.6, 10.0, 59.0
"""From stop to stop at 50 km/h on average, standing included, and the speed that takes."""
FIRST_STOP_M, BLEND_M, AROUND_M = 450.0, 300.0, 40.0
GROWING = ("gnss_height", "gnss_latitude", "gnss_longitude")
BEGIN_S = 4.0
"""A piece begins so long after the first standstill, when the springs have come to rest."""
AGREEMENT_M = 1e-5


def past_two_stops(pipeline: str) -> Scenario:
    """Return a drive that takes `CYCLE_S` from one stop to the next."""
    return Scenario(
        manoeuvre="stop",
        speed_kmh=SPEED_KMH,
        final_speed_kmh=SPEED_KMH,
        event_at_m=FIRST_STOP_M,
        stops=2,
        stop_spacing_m=CYCLE_M,
        dwell_s=DWELL_S,
        length_m=FIRST_STOP_M + CYCLE_M + 300.0,
        imu=pipeline != NOMINAL,
        gnss=pipeline != NOMINAL,
        **KIND,
    )


def standstills(drive: Scenario) -> list[float]:
    """Return when each stop begins, in s."""
    times = np.arange(0.0, drive_of(drive).duration_s, 1e-3)
    still = drive_of(drive).motion(times).speed == 0.0
    return [float(time_s) for time_s in times[1:][np.diff(still.astype(int)) > 0]]


def repeating(road: Road) -> Road:
    """Return ``road`` with the surroundings of the first stop again at the second."""
    x = road.distance_m
    again = FIRST_STOP_M + CYCLE_M - AROUND_M
    weight = 0.5 - 0.5 * np.cos(np.pi * np.clip((x - again) / BLEND_M + 1.0, 0.0, 1.0))
    return road.with_elevation(
        {name: z + weight * (road.at(name, x - CYCLE_M) - z) for name, z in road.elevation.items()}
    )


def piece(pipeline: str) -> floatref.Recording:
    """Return `CYCLE_S` of driving from stop to stop."""
    drive = past_two_stops(pipeline)
    run = simulate(drive, repeating(road_of(drive, drive_of(drive).length_m))).recording
    begin = round(standstills(drive)[0] + BEGIN_S)
    return replace(run, channels=tuple(cut(channel, begin) for channel in run.channels))


def cut(channel: floatref.Channel, begin: float) -> floatref.Channel:
    """Return `CYCLE_S` of a channel from ``begin`` in s on, which becomes time 0."""
    times = channel.times_s
    first, last = np.searchsorted(times, (begin - 1e-6, begin + CYCLE_S - 1e-6))
    clock = channel.clock
    if isinstance(clock, StampedClock):
        clock = StampedClock.of(times[first:last] - begin)
    return floatref.Channel(channel.id, channel.values[first:last], clock)


def write_drive(folder: Path, seconds: float, pipeline: str) -> None:
    """Write the piece, and then lengthen every file by it to ``seconds``."""
    one = piece(pipeline)
    write_recording(one, folder, overwrite=True)
    lengthen(folder, seconds)


def lengthen(folder: Path, seconds: float) -> None:
    """Write the samples of the piece in ``folder`` again and again, the distance going on."""
    for file in folder.glob("*.f64"):
        samples = np.fromfile(file, "<f8")
        gain = gained(file.name, samples)
        with file.open("ab") as stream:
            for number in range(1, round(seconds / CYCLE_S)):
                (samples + number * gain).astype("<f8").tofile(stream)


def gained(name: str, samples: np.ndarray) -> float:
    """Return by how much a file's samples grow from piece to piece.

    The GNSS height grows by what its error has gained between the two stops.
    """
    if ".time" in name:
        return CYCLE_S
    if name.startswith("distance"):
        return float(samples[-1] - samples[0])
    if name.startswith(GROWING):
        around = int(3.0 * samples.size / CYCLE_S)
        return float(samples[-around:].mean() - samples[:around].mean())
    return 0.0


def processed(source: Path, out: Path, pipeline: str) -> tuple[float, float]:
    """Run the command; return its peak resident memory in MB and its wall time in s."""
    arguments = ["process", str(source), "--out", str(out), "--pipeline", pipeline, "--json"]
    begin = time.perf_counter()
    child = subprocess.Popen([sys.executable, "-c", RUN, *arguments], stdout=subprocess.DEVNULL)
    _, status, used = os.wait4(child.pid, 0)
    if status:
        sys.exit(1)
    peak = used.ru_maxrss * (1 if sys.platform == "darwin" else 1024)
    return peak / 1e6, time.perf_counter() - begin


def compare(folder: Path, pipeline: str) -> None:
    """Print how far the drive in ``folder`` is from the result of the fixed interval."""
    recording = read_recording(folder)
    ours = floatref.process(recording, pipeline)
    with mock.patch("floatref.estimators.smoothing.backlog.Backlog._ready", return_value=0):
        whole = floatref.process(recording, pipeline)
    for a, b in zip(ours.tracks, whole.tracks, strict=True):
        apart = np.abs(a.elevation - b.elevation).max()
        print(f"  {a.name:6} furthest from the fixed interval {apart * 1e6:8.3f} µm")


def main() -> None:
    """Write the drive, process it, and compare its first part; each in a process of its own."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--pipeline", choices=list(LIMITS_MB), default=PIPELINE)
    parser.add_argument("--seconds", type=float, default=3600.0)
    parser.add_argument("--compared", type=float, default=360.0)
    parser.add_argument("--write", type=Path, help=argparse.SUPPRESS)
    parser.add_argument("--compare", type=Path, help=argparse.SUPPRESS)
    given = parser.parse_args()
    if given.write:
        write_drive(given.write, given.seconds, given.pipeline)
    elif given.compare:
        compare(given.compare, given.pipeline)
    else:
        with tempfile.TemporaryDirectory(prefix="floatref-kalman-") as name:
            report(Path(name), given)


def report(folder: Path, given: argparse.Namespace) -> None:
    """Print one line for each figure."""
    again = [sys.executable, __file__, "--pipeline", given.pipeline]
    for name, seconds in (("drive", given.seconds), ("part", given.compared)):
        subprocess.run(
            [*again, "--write", str(folder / name), "--seconds", str(seconds)], check=True
        )
    peak, taken = processed(folder / "drive", folder / "profile", given.pipeline)
    size = sum(file.stat().st_size for file in (folder / "drive").glob("*.f64"))
    print(f"{given.pipeline}: {given.seconds:g} s at 16 kHz, two wheel paths, stop by stop")
    print(f"  samples on disk {size / 1e6:9.1f} MB")
    made = sum(file.stat().st_size for file in (folder / "profile").glob("*.[fu]*")) / 1e6
    print(f"  peak resident   {peak:9.1f} MB   (limit {LIMITS_MB[given.pipeline]})")
    print(f"  profile, 1-σ    {made:9.1f} MB")
    print(f"  beyond profile  {peak - made:9.1f} MB")
    print(f"  wall time       {taken:9.1f} s    ({given.seconds / taken:.0f} x real time)")
    print(f"first {given.compared:g} s, elevation (limit {AGREEMENT_M * 1e6:g} µm)", flush=True)
    subprocess.run([*again, "--compare", str(folder / "part")], check=True)


if __name__ == "__main__":
    main()
