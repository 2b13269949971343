"""The drives of `distance`: encoders that are wrong, that slip, and that stand still."""

from collections.abc import Mapping
from math import ceil
from typing import Any

from floatref.values.channels import STANDARD_GRAVITY
from floatref_conformance.checks.features import BESIDE_EVENT_M, END_M, FEATURE_M
from floatref_conformance.proving_ground.runs import KMH
from floatref_conformance.proving_ground.scenario import Scenario

FEATURES = 4
"""So many features lie ahead of an event, and behind it."""
DRIVES: tuple[Mapping[str, Any], ...] = (
    {
        "manoeuvre": "stop",
        "speed_kmh": 72.0,
        "deceleration_g": 0.3,
        "slip_percent_per_g": 3.0,
    },
    {"manoeuvre": "constant", "speed_kmh": 72.0, "encoder_error_percent": 1.0},
    {
        "manoeuvre": "braking",
        "speed_kmh": 80.0,
        "event_speed_kmh": 30.0,
        "deceleration_g": 0.4,
        "encoder_error_percent": -1.0,
        "slip_percent_per_g": 3.0,
    },
    {
        "manoeuvre": "stop",
        "speed_kmh": 50.0,
        "deceleration_g": 0.15,
        "dwell_s": 15.0,
        "final_speed_kmh": 40.0,
        "encoder_error_percent": -0.5,
        "slip_percent_per_g": 1.0,
    },
)
"""The drives of the cases, in turn."""


def scenario_of(numbers: Mapping[str, Any]) -> Scenario:
    """Return the scenario of ``numbers``, its event and its end clear of the features."""
    wanted = Scenario(**numbers)
    braking_m = (wanted.speed_kmh * KMH) ** 2 / (2 * STANDARD_GRAVITY * wanted.deceleration_g)
    room_m = BESIDE_EVENT_M + FEATURES * FEATURE_M + END_M
    event_m = max(room_m, BESIDE_EVENT_M + 10.0 * ceil(0.13 * braking_m))
    return Scenario(**{**numbers, "event_at_m": event_m, "length_m": event_m + room_m})


def event_of(scenario: Scenario) -> float | None:
    """Return the true distance of the stop or the release in m; None without an event."""
    return None if scenario.manoeuvre == "constant" else scenario.event_at_m
