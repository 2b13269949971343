"""Graded errors of `waveband`: one wave at a time is passed wrongly."""

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
"""What the filter itself, as it is to be, does to the longest wave of the flat band and beyond the
cut-off is a part of the limit."""
THIN = 20
"""One of so many points is enough: three in the shortest wave."""
INSIDE_M = 106.0
"""The waves are looked for so far from both ends, where the high-pass filter has run in."""


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
    """Return what passes one wave ``gain`` times as it is, or as large as in the truth."""

    def spoil(profile: Profile, taken: Taken, label: str) -> Profile:
        x, z = profile.distance_m, profile.tracks[0].elevation
        there = _wave(x, z, wavelength_m)
        wanted = gain * there
        if of_truth:
            true = _wave(taken.truth.distance_m, taken.truth.tracks[0].elevation, wavelength_m)
            wanted = gain * there * abs(true) / abs(there)
        turning = np.exp(2j * np.pi * x / wavelength_m)
        raised = z + np.real((wanted - there) * turning)
        return replace(profile, tracks=(ProfileTrack.of(profile.tracks[0].name, raised),))

    return spoil


def _wave(x: FloatArray, z: FloatArray, wavelength_m: float) -> complex:
    """Return the complex amplitude in m of the wave, all others fitted with it."""
    inside = (x > INSIDE_M) & (x < x[-1] - INSIDE_M)
    phase = 2 * np.pi * np.outer(x[inside][::THIN], 1.0 / WAVELENGTHS_M)
    level = np.stack([np.ones(phase.shape[0]), x[inside][::THIN] / x[-1]], axis=1)
    columns = np.concatenate((np.cos(phase), np.sin(phase), level), axis=1)
    found = np.linalg.lstsq(columns, z[inside][::THIN], rcond=None)[0]
    place = int(np.argmin(np.abs(WAVELENGTHS_M - wavelength_m)))
    return complex(found[place], -found[place + WAVELENGTHS_M.size])
