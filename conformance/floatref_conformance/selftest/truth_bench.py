"""A bench without a device: it answers with the truth, spoilt by a known error."""

from collections.abc import Callable
from dataclasses import dataclass, field

from floatref.values.profile import Profile
from floatref_conformance.bench import seen_by, taken_of
from floatref_conformance.checks.interface import Taken
from floatref_conformance.devices.interface import Description
from floatref_conformance.perfect import perfect
from floatref_conformance.proving_ground.scenario import Scenario

NOMINAL = Description("perfect", "1", "temporal", ())
Spoil = Callable[[Profile, Taken, str], Profile]
"""Puts an error into the perfect profile of a recording, which has its label within the case."""


def unspoilt(profile: Profile, taken: Taken, label: str) -> Profile:
    """Return ``profile``."""
    return profile


@dataclass
class Roads:
    """Recordings and their perfect profiles, made once for all errors that are put in."""

    taken: dict[Scenario, Taken] = field(default_factory=dict)

    def of(self, scenario: Scenario) -> Taken:
        """Return the recording of ``scenario``."""
        if scenario not in self.taken:
            self.taken[scenario] = taken_of(scenario)
        return self.taken[scenario]


@dataclass(frozen=True)
class TruthBench:
    """Answers every recording with its truth, filtered, and ``spoil`` applied to it."""

    roads: Roads
    spoil: Spoil = unspoilt
    description: Description = NOMINAL

    def simulate(self, scenario: Scenario) -> Taken:
        """Return the recording of ``scenario`` with the channels of the capabilities."""
        return self.roads.of(seen_by(self.description, scenario))

    def run(self, taken: Taken, label: str = "") -> Profile:
        """Return the spoilt truth."""
        return self.spoil(perfect(taken), taken, label)
