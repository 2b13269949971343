"""The bench simulates the recordings of a check, in advance if possible, and runs the device."""

import os
from collections.abc import Callable, Iterable, Mapping
from concurrent.futures import Future, ThreadPoolExecutor
from dataclasses import dataclass, field, replace
from itertools import islice, takewhile
from pathlib import Path
from typing import Any

import numpy as np

from floatref.values.profile import Profile
from floatref_conformance.checks.case import Case, record_for
from floatref_conformance.checks.interface import Taken
from floatref_conformance.checks.nees import PathNees, nees_of
from floatref_conformance.checks.scoring import filter_truth
from floatref_conformance.checks.verdict import Pass
from floatref_conformance.devices.interface import Description, Device, visible
from floatref_conformance.editions.edition import Edition, find_edition
from floatref_conformance.errors import DeviceError, DeviceRefused
from floatref_conformance.judge.exercise import Delivery, early_end_m, exercise
from floatref_conformance.proving_ground.cache import CachedSimulation, simulate_cached
from floatref_conformance.proving_ground.scenario import Scenario
from floatref_conformance.proving_ground.simulate import Simulation, simulate
from floatref_conformance.worker_pool import wait_for

AGE_NS = 10**10
"""Age given to a file, in ns: longer than any disk's time step, so that a write is detected."""


def make_taken(scenario: Scenario) -> Taken:
    """Return the recording and truth of ``scenario``, from the cache if possible.

    Without a writable cache folder the recording is simulated, which takes longer.
    """
    made: CachedSimulation | Simulation
    try:
        made = simulate_cached(scenario)
    except (OSError, ImportError):
        made = simulate(scenario)
    return Taken(made.recording, made.truth, scenario)


@dataclass(eq=False)
class DeviceBench:
    """The work of one case for a device that has described itself.

    Attributes:
        device, description: what is judged.
        make: simulates a scenario.
        edition: says where a profile may end.
        early_m: the largest length in m by which a profile has ended before its recording.
        passes: recordings that the device has processed, in order.
        false_alarms: number of healthy recordings for which it has answered an error.
    """

    device: Device
    description: Description
    make: Callable[[Scenario], Taken] = make_taken
    edition: Edition = field(default_factory=find_edition)
    early_m: float = 0.0
    passes: list[Pass] = field(default_factory=list)
    false_alarms: int = 0

    def simulate(self, scenario: Scenario) -> Taken:
        """Return the recording of ``scenario`` with the channels that the device may receive."""
        taken = self.make(restrict_channels(self.description, scenario))
        return replace(taken, recording=visible(taken.recording, self.description.channels))

    def run(self, taken: Taken, label: str = "") -> Profile:
        """Return the profile that the device makes of ``taken.recording``, and store it."""
        true_end_m = taken.truth.length_m if self.edition.true_axis else None
        delivery = Delivery(self.edition.early_end_m, true_end_m)
        guarded = GuardedDevice(self.device)
        try:
            profile = exercise(guarded, self.description, taken.recording, delivery)
        except DeviceRefused:
            self.false_alarms += taken.healthy
            raise
        self.early_m = max(self.early_m, early_end_m(profile, taken.recording, true_end_m))
        self.passes.append(Pass(label, taken.truth, profile, taken.scenario))
        return profile

    @property
    def flagged_m(self) -> float:
        """Largest length in m of a wheel path that the device flagged invalid."""
        return max((flagged_m(done.result, done.truth) for done in self.passes), default=0.0)

    @property
    def nees(self) -> tuple[PathNees, ...]:
        """The mean NEES of every wheel path with a 1-sigma, recording by recording."""
        stated = [p for p in self.passes if any(t.sigma is not None for t in p.result.tracks)]
        return tuple(n for p in stated for n in nees_of(filter_truth(p.truth), p.result))


@dataclass(frozen=True)
class GuardedDevice:
    """A device that must not change its recording during a run.

    Attributes:
        device: the one that is run.
    """

    device: Device

    def describe(self) -> Mapping[str, Any]:
        """Return the device's description of itself."""
        return self.device.describe()

    def run(self, recording: Path, profile: Path) -> None:
        """Let the device run; DeviceError if it changed a file of ``recording``."""
        before = {path: _age(path) for path in sorted(recording.parent.iterdir())}
        self.device.run(recording, profile)
        for path, stamp in before.items():
            if not path.is_file() or _stamp(path) != stamp:
                raise DeviceError(f"changed its recording: {path.name} differs after the run")


def _stamp(path: Path) -> tuple[int, int, int]:
    """Return inode, size and time in ns: one of them changes if the file is written."""
    status = path.stat()
    return status.st_ino, status.st_size, status.st_mtime_ns


def _age(path: Path) -> tuple[int, int, int]:
    """Make a file `AGE_NS` older and return its stamp."""
    time_ns = path.stat().st_mtime_ns - AGE_NS
    os.utime(path, ns=(time_ns, time_ns))
    return _stamp(path)


def restrict_channels(description: Description, scenario: Scenario) -> Scenario:
    """Return ``scenario`` with only the channels that the device declares."""
    return replace(scenario, **record_for(description.capabilities))


def flagged_m(profile: Profile, truth: Profile) -> float:
    """Return the largest length in m of a wheel path of ``truth`` that ``profile`` flags invalid.

    Other wheel paths in ``profile`` are ignored.
    """
    asked = [track for track in profile.tracks if track.name in {t.name for t in truth.tracks}]
    lengths = (profile.interval_m * float(np.sum(~track.valid)) for track in asked)
    return max(lengths, default=0.0)


OUTSTANDING = 3
"""Largest number of recordings simulated in advance; without a cache they are held in memory."""


class Ahead:
    """Simulates recordings in the background, one at a time, in the order of announcement.

    At most `OUTSTANDING` recordings are in progress or ready. A recording that is requested before
    its turn is simulated by the caller at once, in parallel; those announced before it are
    dropped. The results are those of `make_taken`, whoever makes them.
    """

    def __init__(self, description: Description) -> None:
        """Simulate recordings with the channels that ``description`` allows."""
        self._description = description
        self._worker = ThreadPoolExecutor(1, "simulating-ahead")
        self._coming: dict[Scenario, Future[Taken] | None] = {}

    def announce(self, cases: Iterable[Case]) -> None:
        """Start to simulate the scenarios of ``cases``, except those already announced."""
        for case in cases:
            self._coming.setdefault(restrict_channels(self._description, case.scenario), None)
        self._begin()

    def __call__(self, scenario: Scenario) -> Taken:
        """Return the recording and truth of ``scenario``."""
        if scenario not in self._coming:
            return make_taken(scenario)
        for passed in list(takewhile(lambda other: other != scenario, self._coming)):
            self._drop(passed)
        coming = self._coming.pop(scenario)
        at_once = coming is None or coming.cancel()
        self._begin()
        return (
            make_taken(scenario) if coming is None or at_once else wait_for(coming, "a simulation")
        )

    def close(self) -> None:
        """Drop the simulations that have not begun, and wait for the one in progress."""
        self._worker.shutdown(cancel_futures=True)
        self._coming.clear()

    def _begin(self) -> None:
        """Start the first `OUTSTANDING` simulations that have not begun."""
        for scenario in list(islice(self._coming, OUTSTANDING)):
            if self._coming[scenario] is None:
                self._coming[scenario] = self._worker.submit(make_taken, scenario)

    def _drop(self, scenario: Scenario) -> None:
        coming = self._coming.pop(scenario)
        if coming is not None:
            coming.cancel()
