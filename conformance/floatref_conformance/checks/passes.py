"""Two passes over one road, made of one case."""

from collections.abc import Mapping
from dataclasses import replace
from types import MappingProxyType
from typing import Any

from floatref.errors import InputError
from floatref.values.profile import Profile
from floatref_conformance.checks.case import Case
from floatref_conformance.proving_ground.scenario import Scenario
from floatref_conformance.proving_ground.vehicles import vehicle_called

CHANGES: Mapping[str, str] = MappingProxyType(
    {"second_seed": "seed", "second_speed_kmh": "speed_kmh", "second_vehicle": "vehicle"}
)
"""What a case's variation says of the second pass, and the number of the scenario that it is."""


def passes_of(case: Case) -> tuple[Scenario, Scenario]:
    """Return both passes of ``case``; what its variation does not name is as in the first.

    Raises InputError, naming what it is, for what makes no second pass.
    """
    first = case.scenario
    second = replace(first, road_seed=first.seed if first.road_seed < 0 else first.road_seed)
    for name, value in case.variation.items():
        if name not in CHANGES:
            raise InputError(f"variation {name}: unknown; known: {', '.join(CHANGES)}")
        change: dict[str, Any] = {CHANGES[name]: value}
        try:
            second = replace(second, **change)
        except InputError as error:
            raise InputError(f"variation {name}: {error}") from error
    return first, second


def on_road(profile: Profile, scenario: Scenario) -> Profile:
    """Return ``profile`` on the road's axis: the lasers lie ahead of the vehicle's own point."""
    ahead_m = vehicle_called(scenario.vehicle).sensor_x_m
    return replace(profile, start_m=profile.start_m + ahead_m)
