"""Measure a live stream of two wheel paths at 16 kHz: its rate, what it holds, and its pushes.

A simulated loop of ten minutes is driven again and again, see `live_loop`; pieces of 10 ms are
pushed. `--hours` pushes as fast as the stream takes the samples, and prints the multiple of real
time, by the clock and by the processor, and memory, threads, open files and gaps every quarter of
an hour. `--paced` pushes at real time, as a vehicle does, and prints how long the pushes took, and
how long without the pauses of the machine, see `machine_pauses`; with `--real-time` the thread that
pushes has a priority before all that have none. Run as

    python tests/benchmarks/bench_live.py --pipeline NAME --hours H [--push-ms MS]
    python tests/benchmarks/bench_live.py --pipeline NAME --paced [--minutes M] [--freeze]
        [--real-time]

`--apart` prints in place of that how far `process(as_live=True)` is from the whole run, for every
pipeline, on drives with stops.
"""

import argparse
import gc
import os
import resource
import threading
import time
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from kind_drives import KIND
from live_loop import PUSH_S, Loop, loop_for
from machine_pauses import measured_pauses
from numpy.typing import NDArray

import floatref
from floatref.engine.axis_place import Place
from floatref.engine.run import run
from floatref.live.as_live import run_as_live
from floatref.live.points import State
from floatref.measures import iri
from floatref_conformance.proving_ground.scenario import Scenario
from floatref_conformance.proving_ground.simulate import simulate

QUARTER_S = 900.0
PRIORITY = 5
"""Of a caller in real time."""
FAMILIES = {
    "no stop": {"manoeuvre": "constant"},
    "a stop of 5 s in each km": {"manoeuvre": "stop", "stops": 6, "stop_spacing_m": 1000.0},
    "a brake to 11 km/h": {"manoeuvre": "braking", "event_at_m": 3000.0},
}


@dataclass
class Seen:
    """What came out of a stream so far."""

    next: int | None = None
    final: int = 0
    gaps: int = 0
    missing: int = 0
    lines: set[str] = field(default_factory=set)

    def add(self, points: list) -> None:
        for each in (p for p in points if p.state is State.FINAL):
            self.gaps += self.next is not None and each.first != self.next
            self.next, self.final = each.first + len(each), self.final + len(each)
            self.missing += sum(int(np.isnan(t.elevation).sum()) for t in each.tracks)
            self.lines.update(line for line in each.events if "no elevation" in line)


def resident_mb() -> float:
    """Resident memory of this process in MB."""
    pages = int(Path("/proc/self/statm").read_text().split()[1])
    return pages * resource.getpagesize() / 1e6


def state_of(loop: Loop, seen: Seen) -> str:
    files = len(os.listdir("/proc/self/fd"))
    held = resident_mb()
    return (f"{held:6.0f} MB, {held - loop.megabytes:5.0f} without the loop, {files} open files, "
            f"{threading.active_count()} threads, {seen.final} final points, {seen.gaps} gaps, "
            f"{seen.missing} without elevation")  # fmt: skip


def start(given: argparse.Namespace, loop: Loop) -> floatref.LiveStream:
    """Start the stream, twice: the first time compiles, or loads, the kernels."""
    setup = loop.recording.setup
    begin = time.perf_counter()
    floatref.start_stream(setup, loop.clocks, given.pipeline).close()
    compiled = time.perf_counter()
    stream = floatref.start_stream(
        setup, loop.clocks, given.pipeline, provisional=not given.no_provisional
    )
    stream.push(next(loop.pushes(PUSH_S)))
    ready = time.perf_counter()
    stream.close()
    print(f"{given.pipeline}: first start in a process {compiled - begin:.2f} s, then start and "
          f"first push {ready - compiled:.4f} s")  # fmt: skip
    stream = floatref.start_stream(
        setup, loop.clocks, given.pipeline, provisional=not given.no_provisional
    )
    gc.collect()
    if given.freeze:
        gc.freeze()
    return stream


def drive(given: argparse.Namespace) -> None:
    """Push as fast as the stream takes it."""
    loop = loop_for(given.pipeline)
    stream, seen, push_s = start(given, loop), Seen(), 1e-3 * given.push_ms
    seconds, said = 3600.0 * given.hours, QUARTER_S
    clocks = time.perf_counter, time.process_time, time.thread_time
    begin, pushed = [clock() for clock in clocks], 0.0
    for number, piece in enumerate(loop.pushes(seconds, push_s)):
        before = time.thread_time()
        stream.push(piece)
        pushed += time.thread_time() - before
        if number * push_s >= said:
            seen.add(stream.ready())
            print(f"  {number * push_s:7.0f} s: {state_of(loop, seen)}", flush=True)
            said += QUARTER_S
        elif number % 100 == 0:
            seen.add(stream.ready())
    seen.add(stream.finish())
    wall, own, caller = (clock() - at for clock, at in zip(clocks, begin, strict=True))
    print(f"  {seconds:7.0f} s: {state_of(loop, seen)}")
    for line in sorted(seen.lines):
        print(f"  {line}")
    thread = own - caller
    rates = {
        "real time by the clock": wall,
        "in processor time": own,
        "without the making of the samples": thread + pushed,
        "the thread's alone": thread,
    }
    figures = ", ".join(f"{seconds / taken:.0f} x {of_what}" for of_what, taken in rates.items())
    print(f"{given.pipeline}, pushes of {given.push_ms:g} ms: {figures}")


def pace(given: argparse.Namespace) -> None:
    """Push at real time, and print how long the pushes took."""
    loop = loop_for(given.pipeline)
    stream, seen = start(given, loop), Seen()
    if given.real_time:
        # The caller alone: a thread of the stream with the same priority keeps its processor for
        # as long as a kernel runs, and a caller on that processor waits.
        os.sched_setscheduler(0, os.SCHED_RR, os.sched_param(PRIORITY))
    with measured_pauses() as pauses:
        spans = np.array(list(paced_pushes(given, loop, stream, seen)))
    seen.add(stream.finish())
    print(f"{given.pipeline}, {given.minutes:g} minutes at real time: {state_of(loop, seen)}")
    taken = spans[:, 1] - spans[:, 0]
    show_pushes("push of 10 ms", taken)
    show_pushes("without pauses of the machine", taken - pauses.shares(*spans.T))
    lasted = 1e3 * np.array([end - begin for begin, end in pauses.spans] or [0.0])
    print(f"  the machine paused {len(pauses.spans)} times, at most {lasted.max():.1f} ms, and "
          f"{1e-3 * lasted.sum():.1f} s in all")  # fmt: skip


def paced_pushes(
    given: argparse.Namespace, loop: Loop, stream: floatref.LiveStream, seen: Seen
) -> Iterator[tuple[float, float]]:
    """Yield when each push began and ended."""
    begin = time.perf_counter()
    for number, piece in enumerate(loop.pushes(60.0 * given.minutes)):
        time.sleep(max(0.0, begin + number * PUSH_S - time.perf_counter()))
        before = time.perf_counter()
        stream.push(piece)
        yield before, time.perf_counter()
        if number % 50 == 25:
            seen.add(stream.ready())


def show_pushes(name: str, taken_s: NDArray[np.float64]) -> None:
    ms = 1e3 * taken_s
    p50, p99, p999 = np.quantile(ms, [0.5, 0.99, 0.999])
    print(f"  {name}: median {p50:.3f} ms, p99 {p99:.2f} ms, p99.9 {p999:.2f} ms, largest "
          f"{ms.max():.1f} ms, first {ms[0]:.3f} ms; above 50 ms: {(ms > 50.0).sum()} of "
          f"{ms.size}")  # fmt: skip


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
    parser.add_argument("--hours", type=float, default=0.25)
    parser.add_argument("--push-ms", type=float, default=1e3 * PUSH_S)
    parser.add_argument("--paced", action="store_true")
    parser.add_argument("--minutes", type=float, default=60.0)
    parser.add_argument("--real-time", action="store_true", help="a real-time caller")
    parser.add_argument("--freeze", action="store_true", help="gc.freeze() behind the start")
    parser.add_argument("--no-provisional", action="store_true")
    parser.add_argument("--apart", action="store_true")
    given = parser.parse_args()
    apart(given) if given.apart else pace(given) if given.paced else drive(given)


if __name__ == "__main__":
    main()
