"""A case: the few numbers of a scenario and of a check that define a simulated test."""

import hashlib
import json
from collections.abc import Collection, Mapping
from dataclasses import dataclass, field, fields, replace
from math import isfinite
from reprlib import repr as shortened
from types import MappingProxyType
from typing import Any

from floatref.errors import InputError
from floatref_conformance.proving_ground.scenario import FIRST_DEFAULTS, Scenario

Number = float | int | str | bool
CHANNELS_BY_NEED = ("imu", "gnss", "response")
SECOND_DISTANCES: Mapping[str, str] = MappingProxyType(
    {"optical": "optical", "gnss-speed": "gnss", "wheel-speed": "can"}
)
"""The second source of distance that a capability stands for; of several the first is recorded."""
FROM_DEVICE = (*CHANNELS_BY_NEED, "encoder_per_side", "second_distance")
"""Fields of a scenario that follow from the device's capabilities, not from the case."""
DEFAULT = replace(Scenario(), **FIRST_DEFAULTS)
"""What a case file does not name, in every edition: a file keeps its meaning."""
LARGEST = 2**64
"""Largest whole number in a variation: larger ones may have no equal float."""


@dataclass(frozen=True)
class Case:
    """One test of a device by a check; two cases are equal if their numbers are equal.

    Attributes:
        check: id of the check.
        scenario: what is simulated.
        variation: further numbers of the check: which fault, where, how long.
        name: name within its check, for the user; a device never sees it.
    """

    check: str
    scenario: Scenario
    variation: Mapping[str, Number] = field(default_factory=dict)
    name: str = field(default="", compare=False)

    def __post_init__(self) -> None:
        """Make the variation immutable."""
        object.__setattr__(self, "variation", MappingProxyType(dict(self.variation)))

    def __hash__(self) -> int:
        """A variation cannot be hashed; it takes part only in the comparison."""
        return hash((self.check, self.scenario))

    @property
    def parameters(self) -> Mapping[str, Any]:
        """The numbers that define the case: those that differ from the defaults."""
        return {
            "scenario": _differences_from_default(self.scenario),
            "variation": dict(self.variation),
        }

    @property
    def digest(self) -> str:
        """Eight hexadecimal digits that identify the case."""
        text = json.dumps([self.check, self.parameters], sort_keys=True)
        return hashlib.sha256(text.encode()).hexdigest()[:8]

    @classmethod
    def of(cls, check: str, parameters: object, name: str = "") -> "Case":
        """Return the case with ``parameters``; InputError if they define no case."""
        if not isinstance(parameters, Mapping):
            raise InputError("a case is a JSON object with scenario and variation")
        variation = parameters.get("variation", {})
        if not isinstance(variation, Mapping):
            raise InputError("variation is not an object of numbers and names")
        for key, value in variation.items():
            if not _is_plain(value):
                raise InputError(f"variation {key} is {shortened(value)}; give a number or a name")
        return cls(check, _scenario_of(parameters.get("scenario", {})), variation, name)


def _scenario_of(numbers: object) -> Scenario:
    """Return the scenario of ``numbers`` of a case, else those of `DEFAULT`."""
    if not isinstance(numbers, Mapping):
        return Scenario.from_dict(numbers)
    return Scenario.from_dict({**FIRST_DEFAULTS, **numbers})


def record_for(capabilities: Collection[str]) -> dict[str, Any]:
    """Return the fields `FROM_DEVICE` of a recording for a device with ``capabilities``."""
    second = [source for need, source in SECOND_DISTANCES.items() if need in capabilities]
    return {
        **{name: name in capabilities for name in CHANNELS_BY_NEED},
        "encoder_per_side": "encoders" in capabilities,
        "second_distance": second[0] if second else "none",
    }


def _is_plain(value: object) -> bool:
    if isinstance(value, int):
        return abs(value) <= LARGEST
    return isinstance(value, str) or (isinstance(value, float) and isfinite(value))


def _differences_from_default(scenario: Scenario) -> dict[str, Any]:
    values = scenario.to_dict()
    return {
        f.name: values[f.name]
        for f in fields(scenario)
        if f.name not in FROM_DEVICE and getattr(scenario, f.name) != getattr(DEFAULT, f.name)
    }
