"""Graded errors of `waveband`: wrong gain or phase of one wave at a time."""

from dataclasses import replace

import numpy as np

from floatref.values.arrays import FloatArray
from floatref.values.profile import Profile, ProfileTrack
from floatref_conformance.checks.distance.waveband import QUANTITIES, WavebandCheck
from floatref_conformance.checks.interface import Taken
from floatref_conformance.proving_ground.roads.sines import (
    BEYOND_M,
    CUT_OFF_M,
    LONGEST_FLAT_M,
    WAVELENGTHS_M,
)
from floatref_conformance.selftest import put_in
from floatref_conformance.selftest.grading import AddError, Graded, Put, Situation

OF_THE_FILTER = (QUANTITIES[0][0], QUANTITIES[2][0])
"""Quantities where the correct filter itself uses a part of the limit: at the longest wave of the
flat band, and beyond the cut-off."""
THIN = 20
"""Every THIN-th point is fitted: three points in the shortest wave."""
INSIDE_M = 106.0
"""Distance from both ends in m where the fit begins; the high-pass filter has settled there."""


def situations(check: WavebandCheck) -> tuple[Situation, ...]:
    """Return the simplest case of ``check``, with one wheel path."""
    simplest = check.simplest
    scenario = replace(simplest.scenario, tracks=("left",), rate_hz=4000.0, profile_interval_m=0.01)
    puts: tuple[Put, ...] = (
        lambda percent: _change_wave(float(WAVELENGTHS_M[12]), 1.0 + percent / 100.0),
        lambda decibel: _change_wave(CUT_OFF_M, 10.0 ** (decibel / 20.0)),
        lambda gain: _change_wave(BEYOND_M, gain, of_truth=True),
        put_in.move_features,
        lambda degrees: _change_wave(LONGEST_FLAT_M, np.exp(1j * np.deg2rad(degrees))),
    )
    graded = tuple(
        Graded((name,), put, is_error=name not in OF_THE_FILTER)
        for (name, _, _), put in zip(QUANTITIES, puts, strict=True)
    )
    return (Situation(check, replace(simplest, scenario=scenario), graded),)


def _change_wave(wavelength_m: float, gain: complex, of_truth: bool = False) -> AddError:
    """Return an error that multiplies one wave by ``gain``, relative to itself or to the truth."""

    def add_error(profile: Profile, taken: Taken, label: str) -> Profile:
        x, z = profile.distance_m, profile.tracks[0].elevation
        there = _wave(x, z, wavelength_m)
        wanted = gain * there
        if of_truth:
            true = _wave(taken.truth.distance_m, taken.truth.tracks[0].elevation, wavelength_m)
            wanted = gain * there * abs(true) / abs(there)
        turning = np.exp(2j * np.pi * x / wavelength_m)
        raised = z + np.real((wanted - there) * turning)
        return replace(profile, tracks=(ProfileTrack.of(profile.tracks[0].name, raised),))

    return add_error


def _wave(x: FloatArray, z: FloatArray, wavelength_m: float) -> complex:
    """Return the complex amplitude of the wave in m; all waves are fitted together."""
    inside = (x > INSIDE_M) & (x < x[-1] - INSIDE_M)
    phase = 2 * np.pi * np.outer(x[inside][::THIN], 1.0 / WAVELENGTHS_M)
    level = np.stack([np.ones(phase.shape[0]), x[inside][::THIN] / x[-1]], axis=1)
    columns = np.concatenate((np.cos(phase), np.sin(phase), level), axis=1)
    found = np.linalg.lstsq(columns, z[inside][::THIN], rcond=None)[0]
    place = int(np.argmin(np.abs(WAVELENGTHS_M - wavelength_m)))
    return complex(found[place], -found[place + WAVELENGTHS_M.size])
