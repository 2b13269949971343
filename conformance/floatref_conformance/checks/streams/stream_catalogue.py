"""The five checks of devices that stream, in the order of their list, and their drives."""

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from floatref_conformance.checks.streams.chunks import ChunksCheck
from floatref_conformance.checks.streams.final_points import FinalCheck
from floatref_conformance.checks.streams.latency import LatencyCheck
from floatref_conformance.checks.streams.memory import MemoryCheck
from floatref_conformance.checks.streams.order import OrderCheck
from floatref_conformance.checks.streams.stream_check import StreamCase, StreamCheck
from floatref_conformance.classes import Effort
from floatref_conformance.proving_ground.scenario import Scenario

STREAM_CHECKS: Mapping[str, StreamCheck] = {
    check.id: check
    for check in (OrderCheck(), FinalCheck(), LatencyCheck(), MemoryCheck(), ChunksCheck())
}
"""By their ids."""
LENGTH_M = 4500.0
"""Of a drive: nearly two of the longest latency of floatref's own streams, 2382 m."""
DWELL_S = 45.0
LONG_LENGTH_M, LONG_KMH, LONG_REPEATS = 2000.0, 36.0, 9
"""Of the long run: half an hour."""


def drives(seed: int, effort: Effort) -> tuple[StreamCase, ...]:
    """Return the drives of ``seed``: at constant speed and with a stop."""
    count = {Effort.QUICK: 1, Effort.CERTIFICATION: 3}[effort]
    return tuple(case for k in range(count) for case in (_constant(seed, k), _stop(seed, k)))


def long_drive(seed: int) -> StreamCase:
    """Return the drive that is repeated in the long run of ``seed``."""
    scenario = _scenario(seed, "constant", LONG_KMH, LONG_LENGTH_M)
    scenario = replace(scenario, tracks=("left",))
    return StreamCase("long", scenario, repeats=LONG_REPEATS)


def _constant(seed: int, number: int) -> StreamCase:
    rng = np.random.default_rng((seed, number, 0))
    scenario = _scenario(seed + 1000 * number, "constant", float(np.round(rng.uniform(65, 100))))
    scenario = replace(scenario, tracks=("left",))
    return StreamCase(f"constant-{number + 1}", scenario, steady=True)


def _stop(seed: int, number: int) -> StreamCase:
    rng = np.random.default_rng((seed, number, 1))
    kmh, at_m = np.round(rng.uniform(60, 80)), np.round(rng.uniform(800, 2500))
    drive = {"event_at_m": float(at_m), "dwell_s": DWELL_S, "final_speed_kmh": float(kmh)}
    scenario = _scenario(seed + 1000 * number, "stop", float(kmh), **drive)
    return StreamCase(f"stop-{number + 1}", scenario)


def _scenario(
    seed: int, manoeuvre: str, kmh: float, length_m: float = LENGTH_M, **drive: float
) -> Scenario:
    return Scenario(
        seed=seed,
        manoeuvre=manoeuvre,
        speed_kmh=kmh,
        length_m=length_m,
        rate_hz=1000.0,
        profile_interval_m=0.25,
        laser_ahead_m=0.0,
        **drive,  # type: ignore[arg-type]  # numbers of the drive alone
    )
