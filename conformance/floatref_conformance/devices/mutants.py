"""Mutants: devices wrong on purpose, each with the checks that must fail it.

A mutant is a sound pipeline with one thing wrong, before it or after it, so that a check
that passes the pipeline and fails the mutant has seen just that.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, TypeVar

import numpy as np

import floatref
from floatref.errors import InputError
from floatref.files import read_recording, write_profile
from floatref.values.profile import Profile, ProfileTrack
from floatref.values.recording import Recording
from floatref_conformance.devices.interface import DeviceEntry, DeviceKind

T = TypeVar("T")


def _unchanged(value: T) -> T:
    return value


@dataclass(frozen=True)
class Mutant:
    """``wrong`` says what is wrong; ``fails`` names the checks that must fail it."""

    name: str
    wrong: str
    fails: tuple[str, ...]
    before: Callable[[Recording], Recording] = _unchanged
    after: Callable[[Profile], Profile] = _unchanged
    pipeline: str = "temporal-basic"

    def describe(self) -> Mapping[str, Any]:
        """Return the description of a temporal device with nominal channels."""
        return {
            "name": self.name,
            "version": floatref.__version__,
            "architecture": "temporal",
            "capabilities": [],
        }

    def run(self, recording: Path, profile: Path) -> None:
        """Spoil ``recording``, process it, spoil the profile and write it."""
        sound = floatref.process(self.before(read_recording(recording)), self.pipeline)
        write_profile(self.after(sound), profile)


def scaled(gain: float) -> Callable[[Profile], Profile]:
    """Return what multiplies every elevation of a profile by ``gain``."""

    def spoil(profile: Profile) -> Profile:
        tracks = tuple(
            ProfileTrack.of(t.name, gain * np.asarray(t.elevation), t.valid) for t in profile.tracks
        )
        return replace(profile, tracks=tracks)

    return spoil


MUTANTS = (
    Mutant("all-zeros", "delivers a flat profile", ("quiescent", "bounce"), after=scaled(0.0)),
)


def make(name: str) -> Mutant:
    """Return mutant ``name``; InputError if there is none."""
    for mutant in MUTANTS:
        if mutant.name == name:
            return mutant
    known = ", ".join(m.name for m in MUTANTS)
    raise InputError(f"device mutant:{name}: unknown mutant; known: {known}")


def entries() -> tuple[DeviceEntry, ...]:
    """Return one entry per mutant."""
    return tuple(DeviceEntry(m.name, m.wrong, m.fails) for m in MUTANTS)


MUTANT = DeviceKind("mutant", "NAME", make, entries)
