"""Missing or wrong stages, and wrong parameters of the vehicle."""

from collections.abc import Callable
from dataclasses import replace

from floatref.values.channels import STANDARD_GRAVITY
from floatref.values.profile import Profile
from floatref.values.recording import Recording
from floatref.values.vehicle_setup import VehicleSetup
from floatref_conformance.mutants.engine import (
    Elevations,
    Signals,
    in_time,
    over_distance,
    replace_elevations,
)
from floatref_conformance.mutants.mutation import (
    RESPONSE,
    SPATIAL,
    After,
    Before,
    Mutation,
    all_but,
)


def _keep(signals: Signals) -> Signals:
    return signals


def _use_engine(elevations: Elevations, change: Callable[[Signals], Signals] = _keep) -> After:
    """Return a mutation with the engine's elevations of signals that ``change`` has changed."""

    def mutate(profile: Profile, recording: Recording) -> Profile:
        return replace_elevations(
            recording, profile, lambda signals, sound: elevations(change(signals), sound)
        )

    return mutate


def _keep_gravity(signals: Signals) -> Signals:
    return replace(signals, acceleration=signals.acceleration + STANDARD_GRAVITY)


def _height_in_mm(signals: Signals) -> Signals:
    return replace(signals, height=1000.0 * signals.height)


IN_PROCESSING = (
    Mutation(
        "gravity-kept",
        "does not subtract gravity from the acceleration",
        (
            "constant-speed",
            "coasting",
            "throttle",
            "braking",
            "stop",
            "waveband",
            "faults",
        ),
        after=_use_engine(in_time(), _keep_gravity),
    ),
    Mutation(
        "height-in-mm",
        "takes heights in mm for m",
        all_but("low-speed"),
        after=_use_engine(in_time(), _height_in_mm),
    ),
    Mutation(
        "tilt-ignored",
        "does not suppress the acceleration that tilt adds under braking",
        ("braking", "near-stop", "stop", "invariance"),
        pipeline="temporal-basic",
    ),
    Mutation(
        "reverse-pass-missing",
        "leaves out the pass that removes the filter's delay",
        ("waveband", "faults"),
        after=_use_engine(in_time(backward=False)),
    ),
    Mutation(
        "cut-off-long",
        "filters at a cut-off wavelength 10 % too long",
        ("waveband",),
        settings={"cutoff_wavelength_m": 1.1 * 105.91},
    ),
    Mutation(
        "cut-off-short",
        "filters at a cut-off wavelength 10 % too short",
        ("waveband",),
        settings={"cutoff_wavelength_m": 0.9 * 105.91},
    ),
    Mutation(
        "carry-leaking",
        "keeps 0.9 of an integral from one block of 4096 samples to the next",
        all_but("quiescent", "low-speed", "coasting"),
        after=_use_engine(in_time(carry=0.9)),
    ),
    Mutation(
        "reflection-sign",
        "reflects the height sensor with the wrong sign",
        ("stop", "faults"),
        after=_use_engine(over_distance(reflection=-1.0)),
        pipeline=SPATIAL,
    ),
    Mutation(
        "stop-uncontained",
        "integrates over distance through a stop without a limit of time",
        ("throttle", "braking", "near-stop", "stop", "dead-start", "invariance", "faults"),
        pipeline="spatial-basic",
    ),
)
"""Mutations with an internal error."""


STIFF = 100.0
"""Factor of the tyre's stiffness; such a tyre hardly deflects."""
LIGHT = 0.5
"""Factor of a parameter of the vehicle."""


def _change_vehicle(change: Callable[[VehicleSetup], VehicleSetup]) -> Before:
    """Return a mutation that changes the vehicle in the setup of a recording."""

    def mutate(recording: Recording) -> Recording:
        vehicle = recording.setup.vehicle
        if vehicle is None:
            return recording
        return replace(recording, setup=replace(recording.setup, vehicle=change(vehicle)))

    return mutate


def _stiffen_tyre(vehicle: VehicleSetup) -> VehicleSetup:
    tyre = STIFF * vehicle.parameters["tyre_n_per_m"]
    return replace(vehicle, parameters={**vehicle.parameters, "tyre_n_per_m": tyre})


def _halve_unsprung(vehicle: VehicleSetup) -> VehicleSetup:
    wheel = LIGHT * vehicle.parameters["unsprung_kg"]
    return replace(vehicle, parameters={**vehicle.parameters, "unsprung_kg": wheel})


def _move_to_origin(vehicle: VehicleSetup) -> VehicleSetup:
    return replace(vehicle, x_m=0.0)


IN_RESPONSE = (
    Mutation(
        "tyre-forgotten",
        "takes the path of the wheel for the road: the tyre does not deflect",
        ("constant-speed", "invariance"),
        _change_vehicle(_stiffen_tyre),
        pipeline=RESPONSE,
    ),
    Mutation(
        "wheel-place-forgotten",
        "takes the wheel to be at the origin of all offsets",
        ("distance", "invariance"),
        _change_vehicle(_move_to_origin),
        pipeline=RESPONSE,
    ),
    Mutation(
        "wheel-mass-halved",
        "takes half the mass of wheel and axle",
        ("constant-speed", "invariance"),
        _change_vehicle(_halve_unsprung),
        pipeline=RESPONSE,
    ),
)
"""Mutations of the vehicle's parameters."""
