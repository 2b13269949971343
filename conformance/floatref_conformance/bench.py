"""The bench: recordings are simulated for a check and processed by the device under test."""

from collections.abc import Callable
from dataclasses import dataclass, field, replace

import numpy as np

from floatref.values.profile import Profile
from floatref_conformance.checks.interface import Taken
from floatref_conformance.devices.interface import Description, Device
from floatref_conformance.exercise import exercise
from floatref_conformance.proving_ground.cache import CachedSimulation, simulate_cached
from floatref_conformance.proving_ground.scenario import Scenario
from floatref_conformance.proving_ground.simulate import Simulation, simulate
from floatref_conformance.verdict import Pass


def taken_of(scenario: Scenario) -> Taken:
    """Return the recording and truth of ``scenario``, from the cache if it can be.

    A folder that cannot be written, or no package to find one, costs time and nothing else.
    """
    made: CachedSimulation | Simulation
    try:
        made = simulate_cached(scenario)
    except (OSError, ImportError):
        made = simulate(scenario)
    return Taken(made.recording, made.truth, scenario)


@dataclass(eq=False)
class DeviceBench:
    """One case's worth of work for a device that has described itself.

    Attributes:
        device, description: what is judged.
        make: how a scenario becomes a recording.
        passes: what the device has processed, in order.
    """

    device: Device
    description: Description
    make: Callable[[Scenario], Taken] = taken_of
    passes: list[Pass] = field(default_factory=list)

    def simulate(self, scenario: Scenario) -> Taken:
        """Return the recording of ``scenario`` with the channels of the device's capabilities."""
        return self.make(seen_by(self.description, scenario))

    def run(self, taken: Taken, label: str = "") -> Profile:
        """Return what the device makes of ``taken.recording``, and keep it."""
        profile = exercise(self.device, self.description, taken.recording)
        self.passes.append(Pass(label, taken.truth, profile, taken.scenario))
        return profile

    @property
    def flagged_m(self) -> float:
        """Largest length in m of a wheel path that the device flagged invalid."""
        return max((flagged_m(done.result) for done in self.passes), default=0.0)


def seen_by(description: Description, scenario: Scenario) -> Scenario:
    """Return ``scenario`` recording the channels that the device declares, and no more."""
    has = description.capabilities
    return replace(scenario, imu="imu" in has, gnss="gnss" in has)


def flagged_m(profile: Profile) -> float:
    """Return the largest length in m of a wheel path in ``profile`` that is flagged invalid."""
    return max(profile.interval_m * float(np.sum(~track.valid)) for track in profile.tracks)
