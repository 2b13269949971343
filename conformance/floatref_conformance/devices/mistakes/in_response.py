"""The vehicle known wrongly, by which its response is taken for the road."""

from collections.abc import Callable
from dataclasses import replace

from floatref.values.recording import Recording
from floatref.values.vehicle_setup import VehicleSetup
from floatref_conformance.devices.mistakes.mistake import RESPONSE, Before, Mistake

STIFF = 100.0
"""A tyre so many times as stiff hardly deflects."""
LIGHT = 0.5
"""Share of its parameters that the vehicle of another fleet has."""


def _knowing(change: Callable[[VehicleSetup], VehicleSetup]) -> Before:
    """Return what changes the vehicle that a recording knows of."""

    def spoil(recording: Recording) -> Recording:
        vehicle = recording.setup.vehicle
        if vehicle is None:
            return recording
        return replace(recording, setup=replace(recording.setup, vehicle=change(vehicle)))

    return spoil


def _stiff(vehicle: VehicleSetup) -> VehicleSetup:
    tyre = STIFF * vehicle.parameters["tyre_n_per_m"]
    return replace(vehicle, parameters={**vehicle.parameters, "tyre_n_per_m": tyre})


def _unsprung_halved(vehicle: VehicleSetup) -> VehicleSetup:
    wheel = LIGHT * vehicle.parameters["unsprung_kg"]
    return replace(vehicle, parameters={**vehicle.parameters, "unsprung_kg": wheel})


def _at_the_origin(vehicle: VehicleSetup) -> VehicleSetup:
    return replace(vehicle, x_m=0.0)


IN_RESPONSE = (
    Mistake(
        "tyre-forgotten",
        "takes the path of the wheel for the road: the tyre does not deflect",
        ("constant-speed", "invariance"),
        _knowing(_stiff),
        pipeline=RESPONSE,
    ),
    Mistake(
        "wheel-place-forgotten",
        "takes the wheel to be at the point that all offsets are from",
        ("distance", "invariance"),
        _knowing(_at_the_origin),
        pipeline=RESPONSE,
    ),
    Mistake(
        "wheel-mass-halved",
        "takes half the mass of wheel and axle",
        ("constant-speed", "invariance"),
        _knowing(_unsprung_halved),
        pipeline=RESPONSE,
    ),
)
"""What is wrong with what is known of the vehicle."""
