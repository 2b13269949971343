"""How many times faster than real time a whole run is simulated, on one core.

The peer is the state update of the vehicle alone, written with numpy matrix products on the
same drive (a part of it), in the same process.
"""

import statistics
import time
from collections.abc import Callable

import numpy as np

from floatref_conformance.proving_ground.scenario import scenario_of_run
from floatref_conformance.proving_ground.simulate import simulate
from floatref_conformance.proving_ground.vehicles.parameter_sets import LOADED_VAN
from floatref_conformance.proving_ground.vehicles.response import bilinear

RUNS = ("ref_72", "sg_10.7s_0.20g", "brk_49-23_0.18g_a")
RATE_HZ = 16000.0
PEER_SAMPLES = 40_000


def seconds(work: Callable[[], object], repeats: int = 5) -> float:
    """Return the median time of ``work`` in s, after two runs that warm up."""
    work(), work()
    times = []
    for _ in range(repeats):
        start = time.perf_counter()
        work()
        times.append(time.perf_counter() - start)
    return statistics.median(times)


def plain_update() -> None:
    """Step the vehicle alone by matrix products."""
    update, _ = bilinear(LOADED_VAN, 1 / RATE_HZ)
    transposed, vector = np.ascontiguousarray(update.T), np.zeros(22)
    for _ in range(PEER_SAMPLES):
        vector[:16] = transposed @ vector


def main() -> None:
    """Print the medians, and their ratio to the peer."""
    peer_ns = seconds(plain_update) / PEER_SAMPLES * 1e9
    print(f"numpy, vehicle alone: {peer_ns:.0f} ns/sample")
    for name in RUNS:
        scenario = scenario_of_run(name)
        count = simulate(scenario).motion.distance.size
        taken = seconds(lambda scenario=scenario: simulate(scenario))
        ns = taken / count * 1e9
        print(
            f"{name}, two tracks, all channels: {ns:.0f} ns/sample, "
            f"{count / RATE_HZ / taken:.0f} x real time (aim 60), {ns / peer_ns:.2f} of the peer"
        )


if __name__ == "__main__":
    main()
