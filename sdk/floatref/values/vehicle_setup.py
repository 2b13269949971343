"""The vehicle that carries the sensors: the name of its model and the parameters."""

from collections.abc import Mapping
from dataclasses import dataclass
from math import isfinite
from types import MappingProxyType
from typing import Any

from floatref.errors import InputError

FARTHEST_M = 100.0
"""No wheel is farther from the vehicle point, in m."""


@dataclass(frozen=True)
class VehicleSetup:
    """A named model of the vehicle, for estimating the road from its response.

    Attributes:
        model: its name; `floatref.vehicle_response.model_of` makes the model.
        parameters: its parameters by name, in SI units.
        x_m: the model's own point ahead of the vehicle point, in m: the wheel of a quarter car,
            the centre of the body of a model with more.
    """

    model: str
    parameters: Mapping[str, float]
    x_m: float = 0.0

    def __post_init__(self) -> None:
        """Refuse a number that is not finite; make the parameters read-only."""
        if not self.model:
            raise InputError("setup.vehicle.model is empty; name the model of the vehicle")
        numbers: dict[str, Any] = {**self.parameters, "x_m": self.x_m}
        for name, value in numbers.items():
            if isinstance(value, bool) or not isinstance(value, int | float) or not isfinite(value):
                raise InputError(f"setup.vehicle: {name} is {value!r}; give a finite number")
        if abs(self.x_m) > FARTHEST_M:
            raise InputError(f"setup.vehicle: x_m is {self.x_m:g}; give it in m, within 100 m")
        frozen = {name: float(value) for name, value in self.parameters.items()}
        object.__setattr__(self, "parameters", MappingProxyType(frozen))
