"""Mutants: devices wrong on purpose, each with the checks that must fail it.

A mutant is a sound pipeline with one thing wrong, before it or after it, so that a check
that passes the pipeline and fails the mutant has seen just that.
"""

from collections.abc import Callable, Mapping
from copy import deepcopy
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, TypeVar

import numpy as np

import floatref
from floatref.errors import InputError
from floatref.files import read_recording, write_profile
from floatref.values.arrays import FloatArray
from floatref.values.channels import STANDARD_GRAVITY
from floatref.values.profile import Profile, ProfileTrack
from floatref.values.recording import Channel, Recording
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


def swapped(profile: Profile) -> Profile:
    """Return ``profile`` with its elevations under the names of other wheel paths."""
    others = (*profile.tracks[1:], profile.tracks[0])
    pairs = zip(profile.tracks, others, strict=True)
    tracks = tuple(ProfileTrack.of(t.name, other.elevation, other.valid) for t, other in pairs)
    return replace(profile, tracks=tracks)


class Previous:
    """Delivers the profile before; the first is itself."""

    def __init__(self) -> None:
        """Begin with no profile."""
        self.last: Profile | None = None

    def __call__(self, profile: Profile) -> Profile:
        """Return what was last given, and keep ``profile``."""
        delivered, self.last = self.last or profile, profile
        return delivered


def changed(name: str, change: Callable[[Channel], FloatArray]) -> Callable[[Recording], Recording]:
    """Return what puts ``change`` of it in place of every channel ``name`` of a recording."""

    def spoil(recording: Recording) -> Recording:
        channels = tuple(
            Channel.of(c.id.name, change(c), c.clock, c.id.track) if c.id.name == name else c
            for c in recording.channels
        )
        return replace(recording, channels=channels)

    return spoil


def at_rest(channel: Channel) -> FloatArray:
    """Return 1 g for every sample."""
    return np.full(channel.values.size, STANDARD_GRAVITY)


def held(channel: Channel) -> FloatArray:
    """Return the first sample for every sample."""
    return np.full(channel.values.size, channel.values[0])


def mirrored(channel: Channel) -> FloatArray:
    """Return the samples with the sign of every change turned."""
    return np.asarray(2.0 * channel.values[0] - channel.values)


def late(delay_s: float) -> Callable[[Channel], FloatArray]:
    """Return what makes a channel ``delay_s`` late; the first sample is held before it."""

    def delay(channel: Channel) -> FloatArray:
        times = channel.times_s
        return np.interp(times - delay_s, times, channel.values)

    return delay


BOTH = ("quiescent", "bounce")
FORCE = "vertical_specific_force"
MUTANTS = (
    Mutant("all-zeros", "delivers a flat profile", BOTH, after=scaled(0.0)),
    Mutant("scaled", "delivers 0.8 of the profile", BOTH, after=scaled(0.8)),
    Mutant("previous-result", "delivers the profile of the case before", BOTH, after=Previous()),
    Mutant("swapped-tracks", "delivers left as right, right as left", BOTH, after=swapped),
    Mutant(
        "laser-sign", "takes a longer range for a higher road", BOTH, changed("height", mirrored)
    ),
    Mutant("height-only", "ignores the accelerometer", ("bounce",), changed(FORCE, at_rest)),
    Mutant("accelerometer-only", "ignores the laser", BOTH, changed("height", held)),
    Mutant("late-laser", "reads the laser 5 ms late", BOTH, changed("height", late(0.005))),
)


def make(name: str) -> Mutant:
    """Return mutant ``name``, which remembers nothing yet; InputError if there is none."""
    for mutant in MUTANTS:
        if mutant.name == name:
            return deepcopy(mutant)
    known = ", ".join(m.name for m in MUTANTS)
    raise InputError(f"device mutant:{name}: unknown mutant; known: {known}")


def entries() -> tuple[DeviceEntry, ...]:
    """Return one entry per mutant."""
    return tuple(DeviceEntry(m.name, m.wrong, m.fails) for m in MUTANTS)


MUTANT = DeviceKind("mutant", "NAME", make, entries)
