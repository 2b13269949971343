"""Models by name, as a recording's setup gives them."""

from collections.abc import Mapping
from dataclasses import fields
from types import MappingProxyType

from floatref.errors import InputError
from floatref.values.display.similar_names import suggest
from floatref.values.vehicle_setup import VehicleSetup
from floatref.vehicle_response.models.half_car import HALF_CAR, HalfCar
from floatref.vehicle_response.models.model import VehicleModel
from floatref.vehicle_response.models.quarter_car import QUARTER_CAR, QuarterCar
from floatref.vehicle_response.models.trailer import TRAILER, Trailer

ParameterSet = QuarterCar | HalfCar | Trailer

MODELS: Mapping[str, type[ParameterSet]] = MappingProxyType(
    {QUARTER_CAR: QuarterCar, HALF_CAR: HalfCar, TRAILER: Trailer}
)
"""The class of parameters of every model by its name."""

MAY_BE_LEFT_OUT = frozenset({"tyre_ns_per_m"})
"""Parameters that are 0 unless they are given."""


def model_of(vehicle: VehicleSetup) -> VehicleModel:
    """Return the model that a recording's setup names, with its parameters.

    Without parameters a half car and a trailer have those of `ZHU_HALF_CAR` and `IMINE_TRAILER`.
    Raises InputError for a model or a parameter that is unknown, or one that is missing.
    """
    return parameters_of(vehicle).model()


def parameters_of(vehicle: VehicleSetup) -> ParameterSet:
    """Return the parameters that a recording's setup gives; InputError as `model_of`."""
    if vehicle.model not in MODELS:
        raise InputError(
            f"setup.vehicle.model: {vehicle.model!r} is unknown; "
            f"{suggest(vehicle.model, MODELS, 'known:')}"
        )
    parameters = MODELS[vehicle.model]
    names = [field.name for field in fields(parameters)]
    for name in vehicle.parameters:
        if name not in names:
            known = suggest(name, names, "known:")
            raise InputError(f"model {vehicle.model}: no parameter {name!r}; {known}")
    missing = [n for n in names if n not in vehicle.parameters and n not in MAY_BE_LEFT_OUT]
    # A mixture of the parameters of two vehicles is not a vehicle.
    if missing and (vehicle.parameters or parameters is QuarterCar):
        raise InputError(
            f"model {vehicle.model}: {', '.join(missing)} missing; give every parameter"
        )
    return parameters(**vehicle.parameters)
