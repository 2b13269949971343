"""Time every class of `floatref.retrofit` per chunk against the bare loop of a pipeline's stage.

160 samples are 10 ms at 16 kHz. The peer of each is the same class on one long chunk, which is all
loop; what is left is the price of a call. Prints medians in µs per chunk and the share of real
time. Run as ``python tests/benchmarks/bench_retrofit.py [chunk]``.
"""

import statistics
import sys
import time
from collections.abc import Callable

import numpy as np

import floatref

RATE_HZ, ROUNDS, LONG = 16_000.0, 300, 1_600_000
STEP_M = 15.0 / RATE_HZ
"""What 15 m/s travel in a sample."""


def high_pass(stage: floatref.HighPass, x: np.ndarray) -> None:
    """Do the three forward calls."""
    stage.acceleration(x)
    stage.velocity(x)
    stage.height(x)


def adaptive(stage: floatref.AdaptiveHighPass, x: np.ndarray, speed: np.ndarray) -> None:
    """Do the three forward calls."""
    stage.acceleration(x, speed)
    stage.velocity(x, speed)
    stage.height(x, speed)


def travel_on(stage: floatref.TravelSpeed, distance: np.ndarray) -> None:
    """Give the chunk, then move it on by its length: a distance that goes back is refused."""
    stage.of(distance)
    distance += distance[-1] + STEP_M - distance[0]


def calls(x: np.ndarray, speed: np.ndarray) -> dict[str, Callable[[], object]]:
    """Return what each class does for one chunk."""
    travel, distance = floatref.TravelSpeed(RATE_HZ), STEP_M * np.arange(x.size)
    fixed = floatref.HighPass(RATE_HZ)
    varying, matched = floatref.AdaptiveHighPass(RATE_HZ), floatref.MatchedHighPass(RATE_HZ)
    control, limit = floatref.LocalSuppression(RATE_HZ), floatref.TimerDistortion(0.025)
    reflection, steps = floatref.HeightReflection(), np.full(x.size, 0.002)
    return {
        "TravelSpeed": lambda: travel_on(travel, distance),
        "HighPass, three calls": lambda: high_pass(fixed, x),
        "AdaptiveHighPass, three calls": lambda: adaptive(varying, x, speed),
        "MatchedHighPass": lambda: matched.reference_height(x, x, speed),
        "LocalSuppression": lambda: control.velocity(x, speed),
        "TimerDistortion": lambda: limit.time_step(steps),
        "HeightReflection": lambda: reflection.reference_height(x, steps, steps, x),
    }


def median_us(call: Callable[[], object], rounds: int) -> float:
    """Return the median of ``rounds`` calls in µs, after one to warm up."""
    call()
    taken = []
    for _ in range(rounds):
        begin = time.perf_counter()
        call()
        taken.append(time.perf_counter() - begin)
    return 1e6 * statistics.median(taken)


def main(chunk: int) -> None:
    """Print a line for each class."""
    rng = np.random.default_rng(0)
    x, speed = rng.standard_normal(LONG), np.abs(rng.standard_normal(LONG))
    short, long = calls(x[:chunk], speed[:chunk]), calls(x, speed)
    print(f"chunks of {chunk} samples, {1e3 * chunk / RATE_HZ:g} ms at {RATE_HZ:g} Hz")
    for name, call in short.items():
        taken = median_us(call, ROUNDS)
        loop = median_us(long[name], 3) * chunk / LONG
        share = taken / (1e6 * chunk / RATE_HZ)
        print(f"  {name:30s} {taken:7.1f} us, loop alone {loop:6.2f} us, {share:6.2%} of real time")


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 160)
