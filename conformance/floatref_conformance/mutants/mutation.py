"""A mutation: one error before a sound pipeline, in its settings, or after it."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

from floatref.values.profile import Profile
from floatref.values.recording import Recording
from floatref_conformance.checks.catalogue import IDS
from floatref_conformance.classes import DeviceClass

RECOMMENDED = "temporal-adaptive-hpf-spatial-backward"
SPATIAL = "spatial-hpf-timer-distortion-reflection"
AUGMENTED = "kalman-smoother-reflection"
RESPONSE = "response-observer"

Before = Callable[[Recording], Recording]
"""Mutates a recording."""
After = Callable[[Profile, Recording], Profile]
"""Mutates the profile that was made of a recording."""


def keep_recording(recording: Recording) -> Recording:
    """Return ``recording``."""
    return recording


def keep_profile(profile: Profile, recording: Recording) -> Profile:
    """Return ``profile``."""
    return profile


def all_but(*ids: str) -> tuple[str, ...]:
    """Return the ids of all checks of the suite except ``ids``, in their order."""
    return tuple(id_ for id_ in IDS if id_ not in ids)


@dataclass(frozen=True)
class Mutation:
    """One error of a device.

    Attributes:
        name: of the device.
        wrong: description of the error, in one line.
        fails: ids of the checks that must fail it.
        before: mutates the recording that the pipeline gets.
        after: mutates the pipeline's profile; it also gets the original recording.
        pipeline: the sound pipeline of floatref.
        settings: of the pipeline.
        claims: the class by whose limits it is judged.
    """

    name: str
    wrong: str
    fails: tuple[str, ...]
    before: Before = keep_recording
    after: After = keep_profile
    pipeline: str = RECOMMENDED
    settings: Mapping[str, Any] = field(default_factory=dict)
    claims: DeviceClass = DeviceClass.NOMINAL
