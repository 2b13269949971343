"""Time every pipeline end to end on a recording in memory, one wheel path at 16 kHz.

Prints the median and how many times faster than the drive that is. Run as
``python tests/benchmarks/bench_pipelines.py [seconds of driving]``.
"""

import statistics
import sys
import time

import numpy as np

import floatref
from floatref.architectures.plugins import plugins

RATE_HZ, SPEED_MPS = 16_000.0, 20.0
ROUNDS = 7


def recording(seconds: float) -> floatref.Recording:
    """A drive at constant speed with noise on both sensors and counts of 0.3 mm."""
    rng = np.random.default_rng(0)
    times = np.arange(int(seconds * RATE_HZ)) / RATE_HZ
    clock = floatref.UniformClock.of(RATE_HZ)
    force = 9.80665 + 0.3 * rng.standard_normal(times.size)
    height = 0.3 + 0.01 * np.sin(9.0 * times) + 1e-4 * rng.standard_normal(times.size)
    distance = 0.0003 * np.floor(SPEED_MPS * times / 0.0003)
    return floatref.Recording(
        (
            floatref.Channel.of("vertical_specific_force", force, clock),
            floatref.Channel.of("height", height, clock),
            floatref.Channel.of("distance", distance, clock),
        )
    )


def median_seconds(run: floatref.Recording, pipeline: str) -> float:
    """Median of several runs after one warm-up, which compiles."""
    floatref.process(run, pipeline)
    taken = []
    for _ in range(ROUNDS):
        begin = time.perf_counter()
        floatref.process(run, pipeline)
        taken.append(time.perf_counter() - begin)
    return statistics.median(taken)


def main(seconds: float) -> None:
    """Print one line for each pipeline."""
    run = recording(seconds)
    print(f"{seconds:g} s of driving at {RATE_HZ / 1000:g} kHz, one wheel path")
    for name in plugins().pipelines():
        taken = median_seconds(run, name)
        print(f"  {name:40} {taken:7.3f} s   {seconds / taken:6.0f} x real time")


if __name__ == "__main__":
    main(float(sys.argv[1]) if len(sys.argv) > 1 else 120.0)
