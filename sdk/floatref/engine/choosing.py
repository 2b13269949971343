"""`auto`: the pipeline that measures most of what a recording holds, and why it is that one.

The order is that of docs/families.md: which pipeline bears most, of those
whose sensors were recorded. A pipeline for which a channel is absent, or whose reference is of no
use, is not among the choices.
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from floatref.builtin_pipelines.signal_flows import NEEDS
from floatref.errors import InputError
from floatref.interfaces.pipeline import Pipeline
from floatref.screening.gnss_readings import fixed_readings
from floatref.values.needs import nominal_needs
from floatref.values.recording import Recording

AUTO = "auto"
BEST = (
    ("kalman-smoother-reflection", "inertial unit and GNSS are recorded"),
    ("road-prior-smoother", "an accelerometer, a height sensor and the encoder are recorded"),
    ("response-joint-input-state", "sensors of the vehicle's response are recorded"),
)
"""Pipelines from the one that bears most, and what of the sensors decides for each."""


@dataclass(frozen=True)
class Choice:
    """A pipeline that the recording has all channels for.

    Attributes:
        pipeline: its name.
        reason: what decides for it.
    """

    pipeline: str
    reason: str


def choices_for(recording: Recording, known: Mapping[str, Pipeline]) -> tuple[Choice, ...]:
    """Return the pipelines that ``recording`` has the channels for, the best first.

    Raises InputError, which names an absent channel, where no pipeline can be taken.
    """
    found = tuple(usable(recording, known))
    if not found:
        # It names the channel of a profiler that is absent.
        nominal_needs(recording).channels(recording)
    return found


def usable(recording: Recording, known: Mapping[str, Pipeline]) -> Iterator[Choice]:
    """Yield the pipelines of `choices_for`; it is empty where no pipeline can be taken."""
    for name, reason in BEST:
        able = name in known and has_channels(recording, known[name])
        if able and not lost_reference(recording, known[name]):
            yield Choice(name, reason)


def passed_over(recording: Recording, known: Mapping[str, Pipeline]) -> Iterator[str]:
    """Yield a line for each pipeline of `BEST` that is no choice for its reference alone."""
    for name, _ in BEST:
        if name in known and has_channels(recording, known[name]):
            lost = lost_reference(recording, known[name])
            if lost:
                yield f"pipeline {name}: not taken; {lost}; check the corrections of the receiver"


def lost_reference(recording: Recording, pipeline: Pipeline) -> str:
    """Return why the GNSS heights that ``pipeline`` reads are of no use, or "" if they are.

    ``recording`` has all channels of ``pipeline``.
    """
    if not pipeline.readings or fixed_readings(recording).any():
        return ""
    return "no reading of gnss_height is RTK fixed"


def has_channels(recording: Recording, pipeline: Pipeline) -> bool:
    """Return whether every channel that ``pipeline`` reads is there, for every wheel path."""
    return not missing_for(recording, pipeline)


def missing_for(recording: Recording, pipeline: Pipeline) -> str:
    """Return what ``pipeline`` needs and ``recording`` lacks, a channel or the vehicle, or ""."""
    try:
        needs = NEEDS[pipeline.architecture](recording)
        needs.channels(recording)
    except InputError as error:
        return str(error).partition(": missing")[0].removeprefix("channel ")
    for track in needs.tracks:
        for name in (*pipeline.channels, *pipeline.readings):
            if recording.find(name, track) is None:
                return name
    return ""
