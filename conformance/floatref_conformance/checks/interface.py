"""What a check is: it draws cases and measures the profiles that a device makes of them."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Protocol, runtime_checkable

from floatref.values.profile import Profile
from floatref.values.recording import Recording
from floatref_conformance.checks.case import Case
from floatref_conformance.checks.stretches import Stretches
from floatref_conformance.classes import DeviceClass, Effort
from floatref_conformance.judge.verdict import Measurement
from floatref_conformance.proving_ground.scenario import Scenario

if TYPE_CHECKING:
    from hypothesis.strategies import SearchStrategy


@dataclass(frozen=True, eq=False)
class Taken:
    """A recording as the sensors made it, and the road that was under the laser.

    Attributes:
        recording: what the device is given, of it the channels that it may have.
        truth: unfiltered elevation in m along the laser's path, one track per wheel path.
        scenario: what was simulated.
    """

    recording: Recording
    truth: Profile
    scenario: Scenario


class Bench(Protocol):
    """Where a check has its recordings made, and processed by the device under test."""

    def simulate(self, scenario: Scenario) -> Taken:
        """Return the recording of ``scenario``, with the channels that the device may have."""

    def run(self, taken: Taken, label: str = "") -> Profile:
        """Return the profile that the device makes of ``taken.recording``.

        Raises DeviceError if it delivers none that can be used, DeviceSkipped if it does not
        take the recording. ``label`` names the recording among those of one case.
        """


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
        """For each measured quantity, the limit of each class with its unit, in words."""

    @property
    def needs(self) -> frozenset[str]:
        """What of `devices.interface.NEEDS` a device must have for the check to apply to it."""

    @property
    def simplest(self) -> Case:
        """The simplest case of all: a failing one is made simpler by taking its numbers."""

    def cases(self, seed: int, effort: Effort) -> tuple[Case, ...]:
        """Return the cases whose manoeuvres the edition fixes; ``seed`` draws road and noise."""

    def strategy(self) -> "SearchStrategy[Case]":
        """Return the Hypothesis strategy of all cases that the check may ask for."""

    def scored(self, case: Case) -> Stretches:
        """Return the stretches whose points count in ``case``, to be shown in pictures.

        Raises InputError for numbers that make no drive.
        """

    def judge(self, case: Case, bench: Bench) -> tuple[Measurement, ...]:
        """Have ``case`` processed and measure it; DeviceError if a point that counts lacks."""


@runtime_checkable
class Fitting(Protocol):
    """A check with cases that say nothing of a device without some sensor."""

    def fitted(self, meets: Iterable[str]) -> Check:
        """Return the check without such cases for a device that has ``meets`` of `NEEDS`."""


def fit_check(check: Check, meets: Iterable[str]) -> Check:
    """Return ``check`` with the cases for a device that ``meets`` so much: most have one kind."""
    return check.fitted(meets) if isinstance(check, Fitting) else check
