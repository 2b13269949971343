"""Time every pipeline end to end on a recording in memory, one wheel path at 16 kHz.

Those without a height sensor get the response of a quarter car at 1 kHz; those that need an
inertial unit are left to `bench_kalman.py`. Prints the first call, which compiles what is not
cached, the median of others, and how many times faster than the drive that is. Run as
``python tests/benchmarks/bench_pipelines.py [seconds of driving] [pipelines]``.
"""

import statistics
import sys
import time

import numpy as np

import floatref
from floatref.engine.plugins import plugins

RATE_HZ, RESPONSE_HZ, SPEED_MPS = 16_000.0, 1000.0, 20.0
CORNER = floatref.VehicleSetup(
    "quarter-car",
    {
        "sprung_kg": 700.0,
        "unsprung_kg": 75.0,
        "suspension_n_per_m": 45e3,
        "suspension_ns_per_m": 3300.0,
        "tyre_n_per_m": 320e3,
    },
)
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


def response(seconds: float) -> floatref.Recording:
    """The same drive by the front corner's accelerometers, deflection and encoder."""
    rng = np.random.default_rng(1)
    times = np.arange(int(seconds * RESPONSE_HZ)) / RESPONSE_HZ
    clock = floatref.UniformClock.of(RESPONSE_HZ)
    sizes = {"unsprung_specific_force": 10.0, "sprung_specific_force": 0.5}
    channels = [
        floatref.Channel.of(name, 9.80665 + size * rng.standard_normal(times.size), clock)
        for name, size in sizes.items()
    ]
    deflection = 0.01 * np.sin(9.0 * times) + 1e-4 * rng.standard_normal(times.size)
    distance = 0.0003 * np.floor(SPEED_MPS * times / 0.0003)
    channels.append(floatref.Channel.of("suspension_deflection", deflection, clock))
    channels.append(floatref.Channel.of("distance", distance, clock))
    return floatref.Recording(tuple(channels), floatref.Setup(vehicle=CORNER))


def seconds_taken(run: floatref.Recording, pipeline: str) -> tuple[float, float]:
    """The first call, and the median of several after it."""
    taken = []
    for _ in range(1 + ROUNDS):
        begin = time.perf_counter()
        floatref.process(run, pipeline)
        taken.append(time.perf_counter() - begin)
    return taken[0], statistics.median(taken[1:])


def main(seconds: float, names: list[str]) -> None:
    """Print one line for each pipeline."""
    known = plugins().pipelines()
    runs = {(): recording(seconds), ("response",): response(seconds)}
    print(f"{seconds:g} s of driving at {RATE_HZ / 1000:g} kHz, one wheel path")
    for name in names or known:
        run = runs.get(known[name].capabilities)
        if run is not None:
            first, taken = seconds_taken(run, name)
            print(
                f"  {name:40} {taken:7.3f} s   {seconds / taken:6.0f} x real time   "
                f"first {first:.1f} s"
            )


if __name__ == "__main__":
    main(float(sys.argv[1]) if len(sys.argv) > 1 else 120.0, sys.argv[2:])
