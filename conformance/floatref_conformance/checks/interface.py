"""What a check is: it draws cases from a seed and measures the profiles that come back."""

from collections.abc import Mapping
from typing import Any, Protocol

from floatref.values.profile import Profile
from floatref.values.recording import Recording
from floatref_conformance.classes import DeviceClass, Effort
from floatref_conformance.verdict import Measurement


class Truth(Protocol):
    """A recording as the sensors made it, and the road that was under the laser."""

    @property
    def recording(self) -> Recording:
        """All channels that were simulated."""

    @property
    def truth(self) -> Profile:
        """Unfiltered elevation in m along the laser's path, one track per wheel path."""


class Case(Protocol):
    """One recording to be made: a few rounded numbers and a noise seed."""

    @property
    def name(self) -> str:
        """Name within its check, for the user; a device never sees it."""

    @property
    def parameters(self) -> Mapping[str, Any]:
        """The numbers that make the case again, ready for JSON."""

    def simulate(self) -> Truth:
        """Return the recording and its truth; the same numbers make the same recording."""


class Check(Protocol):
    """A check. Every limit has a clause or a derivation, and every check a floor."""

    @property
    def id(self) -> str:
        """Name by which the check is selected."""

    @property
    def title(self) -> str:
        """What is asked, in one line."""

    @property
    def clause(self) -> str:
        """Standard and clause, or the derivation's name, that the limit comes from."""

    @property
    def derivation(self) -> str:
        """How the cases are made and why the limits are what they are."""

    @property
    def floor(self) -> str:
        """What must be in the profile, so that one that shows nothing fails."""

    @property
    def limits(self) -> Mapping[str, Mapping[DeviceClass, str]]:
        """For each measured quantity, the limit of each class with its unit."""

    @property
    def needs(self) -> frozenset[str]:
        """Capabilities without which the check is not applicable."""

    def cases(self, seed: int, effort: Effort) -> tuple[Case, ...]:
        """Return the cases that ``seed`` draws; ``effort`` sets how many."""

    def judge(self, case: Case, profile: Profile, simulated: Truth) -> tuple[Measurement, ...]:
        """Measure ``profile``; DeviceError if it lacks a point that counts."""
