"""One mistake: what is wrong before a sound pipeline, in its settings, or after it."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

from floatref.values.profile import Profile
from floatref.values.recording import Recording
from floatref_conformance.checks.catalogue import IDS

RECOMMENDED = "temporal-adaptive-hpf-spatial-backward"
SPATIAL = "spatial-hpf-timer-distortion-reflection"
AUGMENTED = "kalman-smoother-reflection"
RESPONSE = "response-observer"

Before = Callable[[Recording], Recording]
"""Spoils a recording."""
After = Callable[[Profile, Recording], Profile]
"""Spoils the profile that was made of a recording."""


def keep_recording(recording: Recording) -> Recording:
    """Return ``recording``."""
    return recording


def keep_profile(profile: Profile, recording: Recording) -> Profile:
    """Return ``profile``."""
    return profile


def all_but(*ids: str) -> tuple[str, ...]:
    """Return the ids of all checks of the suite but ``ids``, in their order."""
    return tuple(id_ for id_ in IDS if id_ not in ids)


@dataclass(frozen=True)
class Mutation:
    """One thing that is wrong with a device.

    Attributes:
        name: of the device.
        wrong: what is wrong, in one line.
        fails: ids of the checks that must fail it.
        before: spoils what the pipeline is given.
        after: spoils what it makes of that; it is shown what was recorded, unspoilt.
        pipeline: of floatref.
        settings: of the pipeline.
    """

    name: str
    wrong: str
    fails: tuple[str, ...]
    before: Before = keep_recording
    after: After = keep_profile
    pipeline: str = RECOMMENDED
    settings: Mapping[str, Any] = field(default_factory=dict)
