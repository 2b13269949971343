"""Graded errors of the stationary checks."""

from dataclasses import replace

import numpy as np

from floatref.measures import iri
from floatref.values.arrays import FloatArray
from floatref.values.profile import Profile
from floatref_conformance.checks.interface import Taken
from floatref_conformance.checks.stationary.parked_checks import StationaryCheck
from floatref_conformance.checks.stationary.plate import PLATE_M
from floatref_conformance.selftest import put_in
from floatref_conformance.selftest.grading import AddError, Graded, Situation

WAVE_M = 12.0
SETTLED_M = 2000.0


def situations(check: StationaryCheck) -> tuple[Situation, ...]:
    """Return the simplest case of ``check``, with one wheel path."""
    simplest = check.simplest
    scenario = replace(simplest.scenario, tracks=("left",), rate_hz=4000.0, sensors=0.0)
    graded = (
        Graded(("IRI",), lambda m_per_km: _add_wave(m_per_km, check.end_m)),
        Graded(("plate height error",), lambda mm: put_in.make_higher(-mm / (1000.0 * PLATE_M))),
        Graded(("plate displacement",), _move_plate),
    )
    return (Situation(check, replace(simplest, scenario=scenario), graded),)


def _add_wave(m_per_km: float, end_m: float) -> AddError:
    """Return an error that adds a wave with an IRI of ``m_per_km``, up to ``end_m``."""
    wave = _wave(np.arange(0.0, SETTLED_M, 0.05))
    height_m = m_per_km / iri(wave, 0.05)
    fade = put_in.between(0.0, end_m)
    return put_in.add_shape(lambda x: height_m * _wave(x) * fade(x))


def _wave(x: FloatArray) -> FloatArray:
    return np.sin(2 * np.pi * x / WAVE_M)


def _move_plate(length_m: float) -> AddError:
    """Return an error that moves the plate by ``length_m`` plus the tolerated half interval."""

    def move(profile: Profile, taken: Taken, label: str) -> Profile:
        return put_in.move_features(length_m + profile.interval_m / 2)(profile, taken, label)

    return move
