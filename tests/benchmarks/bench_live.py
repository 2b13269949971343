"""Measure a live stream at 16 kHz: how long a push takes, how fast it is, and what it holds.

A simulated loop of ten minutes is made continuous: it comes again and again, with the distance and
the time going on. Two wheel paths are pushed in pieces of 10 ms. `--paced` pushes at real time, as
a vehicle does, and prints the times of the pushes; without it the stream is pushed as fast as it
takes the samples, which gives the multiple of real time and the memory. Run as

    python tests/benchmarks/bench_live.py [--pipeline NAME] [--seconds S] [--paced] [--provisional]

`--apart` prints in place of that how far `process(as_live=True)` is from the whole run, for every
pipeline, on drives with stops.
"""

import argparse
import gc
import os
import resource
import threading
import time
import warnings
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np
from kind_drives import KIND

import floatref
from floatref.engine.axis_place import Place
from floatref.engine.run import run
from floatref.live.as_live import run_as_live
from floatref.live.points import State
from floatref.measures import iri
from floatref_conformance.proving_ground.scenario import Scenario
from floatref_conformance.proving_ground.simulate import simulate

RATE_HZ, PUSH_S, LOOP_S = 16_000, 0.01, 600.0
QUARTER_S = 900.0
LOOP = Scenario(manoeuvre="stop", stops=6, event_at_m=1200.0, stop_spacing_m=1500.0, dwell_s=5.0,
                final_speed_kmh=72.0, length_m=12_000.0, response=False, **KIND)  # fmt: skip
FAMILIES = {
    "no stop": {"manoeuvre": "constant"},
    "a stop of 5 s in each km": {"manoeuvre": "stop", "stops": 6, "stop_spacing_m": 1000.0},
    "a brake to 11 km/h": {"manoeuvre": "braking", "event_at_m": 3000.0},
}
CHANNELS = ("vertical_specific_force", "height", "distance")


def loop_of() -> floatref.Recording:
    """Return the loop with the nominal channels, cut to whole pieces of `PUSH_S`."""
    made = simulate(LOOP).recording
    return replace(made, channels=tuple(c for c in made.channels if c.id.name in CHANNELS))


def pushes(recording: floatref.Recording, seconds: float) -> Iterator[dict]:
    """Yield pieces of `PUSH_S`, the loop again and again; the distance goes on."""
    piece = round(PUSH_S * RATE_HZ)
    nominal = recording.channels
    count = min(c.values.size for c in nominal) // piece
    distance = recording.channel("distance").values
    step = float(np.nanmean(np.diff(distance[-1000:])))
    length = float(np.nanmax(distance[: count * piece])) - float(distance[0]) + step
    for number in range(round(seconds / PUSH_S)):
        lap, at = divmod(number, count)
        part = slice(at * piece, (at + 1) * piece)
        yield {
            c.id: c.values[part] + (lap * length if c.id.name == "distance" else 0.0)
            for c in nominal
        }


def resident_mb() -> float:
    """Resident memory of this process in MB."""
    pages = int(Path("/proc/self/statm").read_text().split()[1])
    return pages * resource.getpagesize() / 1e6


def state_of(stream: floatref.LiveStream) -> str:
    files = len(os.listdir("/proc/self/fd"))
    return f"{resident_mb():6.0f} MB, {files} open files, {threading.active_count()} threads"


def drive(given: argparse.Namespace) -> None:
    recording = loop_of()
    clocks = {c.id: float(RATE_HZ) for c in recording.channels}
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        floatref.process(recording, given.pipeline)  # Compiles.
    taken, points, said = [], 0, QUARTER_S
    begin, own = time.perf_counter(), time.process_time()
    stream = floatref.start_stream(
        recording.setup, clocks, given.pipeline, provisional=given.provisional
    )
    print(f"first push after {time.perf_counter() - begin:.3f} s; {stream.latency}")
    gc.collect()
    for number, piece in enumerate(pushes(recording, given.seconds)):
        if given.paced:
            time.sleep(max(0.0, begin + number * PUSH_S - time.perf_counter()))
        before = time.perf_counter()
        stream.push(piece)
        taken.append(time.perf_counter() - before)
        points += sum(len(p) for p in stream.ready() if p.state is State.FINAL)
        if number * PUSH_S >= said:
            print(f"  {number * PUSH_S:7.0f} s: {state_of(stream)}, {points} final", flush=True)
            said += QUARTER_S
    points += sum(len(p) for p in stream.finish() if p.state is State.FINAL)
    report(given, np.array(taken), time.perf_counter() - begin, time.process_time() - own, points)


def report(
    given: argparse.Namespace, taken: np.ndarray, wall_s: float, own_s: float, points: int
) -> None:
    print(f"{given.pipeline}, {given.seconds:.0f} s, {points} final points of a wheel path")
    p50, p999 = np.quantile(taken, [0.5, 0.999])
    print(f"  push of 10 ms: median {1e3 * p50:.3f} ms, p99.9 {1e3 * p999:.2f} ms, "
          f"largest {1e3 * taken.max():.1f} ms")  # fmt: skip
    print(f"  {given.seconds / wall_s:.0f} x real time, {given.seconds / own_s:.0f} x on one core")


def apart(given: argparse.Namespace) -> None:
    """Print how far windows are from the whole run, in mm and m/km, for every pipeline."""
    print("| pipeline | drive | valid points, rms | largest | IRI of the run | IRI as live |")
    print("|---|---|---|---|---|---|")
    for name, own in FAMILIES.items():
        scenario = Scenario(length_m=7000.0, rate_hz=1000.0, seed=2, **{**KIND, **own})
        recording = simulate(scenario).recording
        for pipeline in floatref.pipelines():
            compare(name, pipeline, recording)


def compare(name: str, pipeline: str, recording: floatref.Recording) -> None:
    live, whole = run_as_live(recording, pipeline), run(recording, pipeline, place=Place(-np.inf))
    one, two = live.profile.tracks[0], whole.profile.tracks[0]
    size = min(one.elevation.size, two.elevation.size)
    valid = one.valid[:size] & two.valid[:size]
    off = 1e3 * (one.elevation[:size] - two.elevation[:size])[valid]
    rough = [iri(np.nan_to_num(t.elevation[:size][valid]), whole.profile.interval_m)
             for t in (two, one)]  # fmt: skip
    print(
        f"| `{pipeline}` | {name} | {np.sqrt(np.mean(off**2)):.3f} mm | {np.abs(off).max():.2f} mm "
        f"| {rough[0]:.4f} | {rough[1]:.4f} |",
        flush=True,
    )


def main() -> None:
    """Measure one pipeline, or compare all."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--pipeline", default="road-prior-smoother")
    parser.add_argument("--seconds", type=float, default=600.0)
    parser.add_argument("--paced", action="store_true")
    parser.add_argument("--provisional", action="store_true")
    parser.add_argument("--apart", action="store_true")
    given = parser.parse_args()
    apart(given) if given.apart else drive(given)


if __name__ == "__main__":
    main()
