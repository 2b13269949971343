"""How many times faster than real time a whole run is simulated, on one core.

The peer is the state update of the vehicle alone, written with numpy matrix products on the
same drive (a part of it), in the same process.
"""

import statistics
import time
from collections.abc import Callable
from dataclasses import replace

import numpy as np

from floatref_conformance.proving_ground.scenario import scenario_of_run
from floatref_conformance.proving_ground.simulate import simulate
from floatref_conformance.proving_ground.vehicles.parameter_sets import LOADED_VAN
from floatref_conformance.proving_ground.vehicles.response import bilinear

RUNS = ("ref_72", "sg_10.7s_0.20g", "brk_49-23_0.18g_a")
OPTIONS: dict[str, dict[str, float | bool | str]] = {
    "crown, joints and patches": {"crown_mm": 50.0, "joint_mm": 5.0, "patch_mm": 5.0},
    "friction and progressive springs": {"friction_nm": 2000.0, "progression_per_m2": 50.0},
    "wander on a surface": {"wander_m": 0.1, "wander_within_m": 0.02},
    "line laser of 100 mm": {"laser_line_mm": 100.0},
    "radius, warming, latency": {"radius_percent": 1.0, "warming_percent": 0.3, "latency_ms": 3.0},
    "all encoders": {"encoder_per_side": True, "second_distance": "optical"},
}
"""What streets have, each on top of the first run; then all of them together."""
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
    drives = {f"{name}, two tracks, all channels": scenario_of_run(name) for name in RUNS}
    together: dict[str, float | bool | str] = {}
    for name, numbers in OPTIONS.items():
        drives[f"the first with {name}"] = replace(scenario_of_run(RUNS[0]), **numbers)
        together |= numbers
    drives["the first with all of these"] = replace(scenario_of_run(RUNS[0]), **together)
    for name, scenario in drives.items():
        count = simulate(scenario).motion.distance.size
        taken = seconds(lambda scenario=scenario: simulate(scenario))
        ns = taken / count * 1e9
        print(
            f"{name}: {ns:.0f} ns/sample, "
            f"{count / RATE_HZ / taken:.0f} x real time (aim 60), {ns / peer_ns:.2f} of the peer"
        )


if __name__ == "__main__":
    main()
