"""Stages that are missing or wrong."""

from collections.abc import Callable
from dataclasses import replace

from floatref.values.channels import STANDARD_GRAVITY
from floatref.values.profile import Profile
from floatref.values.recording import Recording
from floatref_conformance.devices.mistakes.mistake import SPATIAL, After, Mistake, all_but
from floatref_conformance.devices.mutant_engine import (
    Elevations,
    Signals,
    in_time,
    over_distance,
    remade,
)


def _as_read(signals: Signals) -> Signals:
    return signals


def _by(elevations: Elevations, change: Callable[[Signals], Signals] = _as_read) -> After:
    """Return what puts the engine's elevations in place, of signals spoilt by ``change``."""

    def spoil(profile: Profile, recording: Recording) -> Profile:
        return remade(recording, profile, lambda signals, sound: elevations(change(signals), sound))

    return spoil


def _gravity_kept(signals: Signals) -> Signals:
    return replace(signals, acceleration=signals.acceleration + STANDARD_GRAVITY)


def _height_in_mm(signals: Signals) -> Signals:
    return replace(signals, height=1000.0 * signals.height)


IN_PROCESSING = (
    Mistake(
        "gravity-kept",
        "does not take gravity from the acceleration",
        (
            "constant-speed",
            "coasting",
            "throttle",
            "braking",
            "near-stop",
            "stop",
            "waveband",
            "faults",
        ),
        after=_by(in_time(), _gravity_kept),
    ),
    Mistake(
        "height-in-mm",
        "takes heights in mm for m",
        all_but("low-speed"),
        after=_by(in_time(), _height_in_mm),
    ),
    Mistake(
        "tilt-ignored",
        "does nothing against what tilt under braking adds to the acceleration",
        ("throttle", "braking", "near-stop", "stop", "invariance"),
        pipeline="temporal-basic",
    ),
    Mistake(
        "reverse-pass-missing",
        "leaves out the pass that takes the filter's delay out",
        ("waveband", "faults"),
        after=_by(in_time(backward=False)),
    ),
    Mistake(
        "cut-off-long",
        "filters 10 % too far up in wavelength",
        ("waveband",),
        settings={"cutoff_wavelength_m": 1.1 * 105.91},
    ),
    Mistake(
        "cut-off-short",
        "filters 10 % too far down in wavelength",
        ("waveband",),
        settings={"cutoff_wavelength_m": 0.9 * 105.91},
    ),
    Mistake(
        "carry-leaking",
        "keeps 0.9 of an integral from one block of 4096 samples to the next",
        all_but("quiescent", "low-speed", "coasting"),
        after=_by(in_time(carry=0.9)),
    ),
    Mistake(
        "reflection-sign",
        "reflects the height sensor with the wrong sign",
        ("stop", "faults"),
        after=_by(over_distance(reflection=-1.0)),
        pipeline=SPATIAL,
    ),
    Mistake(
        "stop-uncontained",
        "integrates over distance through a stop as if it took no time limit",
        ("throttle", "braking", "near-stop", "stop", "dead-start", "invariance", "faults"),
        pipeline="spatial-basic",
    ),
)
"""What is wrong inside."""
