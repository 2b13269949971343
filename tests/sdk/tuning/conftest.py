"""Short simulated runs over one road: at high speed, with a stop, and in a crawl."""

from collections.abc import Callable
from functools import cache
from typing import Any

import pytest

from floatref_conformance.proving_ground import Scenario, simulate
from floatref_conformance.proving_ground.simulate import Simulation

ROAD: dict[str, Any] = {
    "road_seed": 3,
    "rate_hz": 1000.0,
    "length_m": 160.0,
    "profile_interval_m": 0.05,
}
DRIVES: dict[str, dict[str, Any]] = {
    "fast": {},
    "stop": {
        "manoeuvre": "stop",
        "speed_kmh": 50.0,
        "deceleration_g": 0.33,
        "dwell_s": 1.2,
        "event_at_m": 90.0,
        "final_speed_kmh": 25.0,
    },
}


@cache
def _driven(name: str, **changes: Any) -> Simulation:
    seed = list(DRIVES).index(name)
    return simulate(Scenario.from_dict({**ROAD, "seed": seed, **DRIVES[name], **changes}))


@pytest.fixture
def driven() -> Callable[..., Simulation]:
    """Return what simulates the drive of a name, with some of its numbers changed."""
    return _driven


@pytest.fixture
def given() -> dict[str, float]:
    """Return settings with which 160 m of road are enough, and a walk that is far too large."""
    return {"cutoff_wavelength_m": 30.0, "acceleration_walk": 0.5}
