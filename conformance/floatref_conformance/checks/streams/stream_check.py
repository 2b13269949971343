"""The interface of a check of streams: it measures what a device gave out in several runs."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Protocol

from floatref.values.profile import Profile
from floatref.values.recording import Recording
from floatref_conformance.checks.verdict import Measurement
from floatref_conformance.classes import DeviceClass, Limits
from floatref_conformance.devices.streams.transcript import Transcript
from floatref_conformance.proving_ground.scenario import Scenario

ROUNDING_M = 1e-12
"""Limit in m of a difference that must be 0: less than a bit of any elevation."""


@dataclass(frozen=True)
class StreamCase:
    """A drive that is streamed.

    Attributes:
        name: within its check.
        scenario: what is simulated.
        repeats: how often the drive is repeated, one behind another, in a long run.
        steady: whether the drive has no event, so that the IRI of its points can be compared.
    """

    name: str
    scenario: Scenario
    repeats: int = 1
    steady: bool = False


class Runs(Protocol):
    """The runs of one case on one device; each is made once, when it is first asked for."""

    @property
    def case(self) -> StreamCase:
        """The drive."""

    @property
    def recording(self) -> Recording:
        """Its samples, with the channels that the device may receive."""

    @property
    def truth(self) -> Profile:
        """The true road, unfiltered."""

    @property
    def moment_s(self) -> float:
        """Recorded time up to which the samples of `plain` and `changed` are the same."""

    @property
    def plain(self) -> Transcript:
        """What came of the drive in even pieces."""

    @property
    def recut(self) -> Transcript:
        """What came of the same samples in other pieces, and of the channels by turns."""

    @property
    def changed(self) -> Transcript:
        """What came of samples that are the same up to `moment_s`, and others after it."""

    @property
    def long(self) -> Transcript:
        """What came of a run of many repeats, with the memory of the processes."""


class StreamCheck(Protocol):
    """A check of devices that stream. Every limit has a derivation, every check a floor."""

    @property
    def id(self) -> str:
        """Name by which the check is selected."""

    @property
    def title(self) -> str:
        """The requirement, in one line."""

    @property
    def clause(self) -> str:
        """The name of the derivation that the limits come from."""

    @property
    def derivation(self) -> str:
        """How the runs are made, and the reasons of the limits."""

    @property
    def floor(self) -> str:
        """What the points must contain, so that a device that gives out nothing fails."""

    @property
    def limits(self) -> Mapping[str, str]:
        """For each measured quantity its limit with its unit, in words; for every class."""

    @property
    def is_long(self) -> bool:
        """Whether it judges the long run instead of the drives."""

    def judge(self, runs: Runs) -> tuple[Measurement, ...]:
        """Measure ``runs``; DeviceError if the device gave out too little to be judged."""


def measurement(quantity: str, track: str, value: float, unit: str, limit: float) -> Measurement:
    """Return a value whose ``limit`` is that of every class."""
    limits: Limits = dict.fromkeys(DeviceClass, limit)
    return Measurement(quantity, track, value, unit, limits)


def bits(transcript: Transcript) -> float:
    """Return the limit in m of a difference that must be 0, as the device rounds its numbers."""
    return max(ROUNDING_M, transcript.started.tolerance_m)
