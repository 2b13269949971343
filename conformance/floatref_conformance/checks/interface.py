"""The interface of a check: it draws cases and measures the profiles of a device."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Protocol, runtime_checkable

from floatref.values.profile import Profile
from floatref.values.recording import Recording
from floatref_conformance.checks.case import Case
from floatref_conformance.checks.stretches import Stretches
from floatref_conformance.checks.verdict import Measurement
from floatref_conformance.classes import DeviceClass, Effort
from floatref_conformance.proving_ground.scenario import Scenario

if TYPE_CHECKING:
    from hypothesis.strategies import SearchStrategy


@dataclass(frozen=True, eq=False)
class Taken:
    """A simulated recording of the sensors, and the true road under the laser.

    Attributes:
        recording: the channels that the device may receive.
        truth: unfiltered elevation in m along the laser's path, one track per wheel path.
        scenario: the simulated scenario.
        healthy: whether no sensor is faulty; to refuse such a recording is a false alarm.
    """

    recording: Recording
    truth: Profile
    scenario: Scenario
    healthy: bool = True


class Bench(Protocol):
    """Simulates recordings for a check, and lets the device under test process them."""

    def simulate(self, scenario: Scenario) -> Taken:
        """Return the recording of ``scenario``, with the channels that the device may receive."""

    def run(self, taken: Taken, label: str = "") -> Profile:
        """Return the profile that the device makes of ``taken.recording``.

        Raises DeviceError if it delivers no usable profile, DeviceSkipped if it skips the
        recording. ``label`` identifies the recording in its case.
        """


class Check(Protocol):
    """A check. Every limit has a clause or a derivation; every check has a floor."""

    @property
    def id(self) -> str:
        """Name by which the check is selected."""

    @property
    def title(self) -> str:
        """The requirement, in one line."""

    @property
    def clause(self) -> str:
        """Standard and clause, or the derivation's name, that the limits come from."""

    @property
    def derivation(self) -> str:
        """How the cases are made, and the reasons of the limits."""

    @property
    def floor(self) -> str:
        """What the profile must contain, so that a flat profile fails."""

    @property
    def limits(self) -> Mapping[str, Mapping[DeviceClass, str]]:
        """For each measured quantity, the limit of each class with its unit, in words."""

    @property
    def needs(self) -> frozenset[str]:
        """The `devices.interface.NEEDS` that a device must meet for the check to apply."""

    @property
    def simplest(self) -> Case:
        """The simplest case: a failing case is simplified towards its numbers."""

    def cases(self, seed: int, effort: Effort) -> tuple[Case, ...]:
        """Return the cases with the manoeuvres of the edition; ``seed`` draws road and noise."""

    def strategy(self) -> "SearchStrategy[Case]":
        """Return the Hypothesis strategy of all possible cases of the check."""

    def list_scored(self, case: Case) -> Stretches:
        """Return the scored stretches of ``case``, which are shown in pictures.

        Raises InputError for numbers that make no drive.
        """

    def judge(self, case: Case, bench: Bench) -> tuple[Measurement, ...]:
        """Run ``case`` and measure it; DeviceError if a scored point is missing."""


@runtime_checkable
class Fitting(Protocol):
    """A check with cases that do not apply to a device without some sensor."""

    def fit(self, meets: Iterable[str]) -> Check:
        """Return the check without such cases, for a device that ``meets`` these `NEEDS`."""


def fit_check(check: Check, meets: Iterable[str]) -> Check:
    """Return ``check`` for a device that ``meets`` these `NEEDS`; most checks do not change."""
    return check.fit(meets) if isinstance(check, Fitting) else check
