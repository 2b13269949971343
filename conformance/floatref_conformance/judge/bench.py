"""The bench: recordings are simulated for a check, ahead of time if possible, and processed."""

import os
from collections.abc import Callable, Iterable, Mapping
from concurrent.futures import Future, ThreadPoolExecutor
from dataclasses import dataclass, field, replace
from itertools import islice, takewhile
from pathlib import Path
from typing import Any

import numpy as np

from floatref.values.profile import Profile
from floatref_conformance.checks.case import CHANNELS_BY_NEED, Case
from floatref_conformance.checks.interface import Taken
from floatref_conformance.devices.interface import Description, Device, visible
from floatref_conformance.errors import DeviceError
from floatref_conformance.judge.exercise import exercise
from floatref_conformance.judge.verdict import Pass
from floatref_conformance.proving_ground.cache import CachedSimulation, simulate_cached
from floatref_conformance.proving_ground.scenario import Scenario
from floatref_conformance.proving_ground.simulate import Simulation, simulate

AGE_NS = 10**10
"""Coarser than any disk's clock, so that a file written at once after it was made shows it."""


def make_taken(scenario: Scenario) -> Taken:
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
    make: Callable[[Scenario], Taken] = make_taken
    passes: list[Pass] = field(default_factory=list)

    def simulate(self, scenario: Scenario) -> Taken:
        """Return the recording of ``scenario`` with the channels that the device may have."""
        taken = self.make(restrict_channels(self.description, scenario))
        return replace(taken, recording=visible(taken.recording, self.description.channels))

    def run(self, taken: Taken, label: str = "") -> Profile:
        """Return what the device makes of ``taken.recording``, and keep it."""
        profile = exercise(GuardedDevice(self.device), self.description, taken.recording)
        self.passes.append(Pass(label, taken.truth, profile, taken.scenario))
        return profile

    @property
    def flagged_m(self) -> float:
        """Largest length in m of a wheel path that the device flagged invalid."""
        return max((flagged_m(done.result, done.truth) for done in self.passes), default=0.0)


@dataclass(frozen=True)
class GuardedDevice:
    """A device whose recording must be after a run what it was before.

    Attributes:
        device: what is run.
    """

    device: Device

    def describe(self) -> Mapping[str, Any]:
        """Return what the device says of itself."""
        return self.device.describe()

    def run(self, recording: Path, profile: Path) -> None:
        """Let the device run; DeviceError if it changed a file of ``recording``."""
        before = {path: _age(path) for path in sorted(recording.parent.iterdir())}
        self.device.run(recording, profile)
        for path, stamp in before.items():
            if not path.is_file() or _stamp(path) != stamp:
                raise DeviceError(f"changed its recording: {path.name} is not what it was")


def _stamp(path: Path) -> tuple[int, int, int]:
    """Return what changes with a file, without reading it: number, size, and time in ns."""
    status = path.stat()
    return status.st_ino, status.st_size, status.st_mtime_ns


def _age(path: Path) -> tuple[int, int, int]:
    """Make a file `AGE_NS` older and return its stamp."""
    time_ns = path.stat().st_mtime_ns - AGE_NS
    os.utime(path, ns=(time_ns, time_ns))
    return _stamp(path)


def restrict_channels(description: Description, scenario: Scenario) -> Scenario:
    """Return ``scenario`` recording the channels that the device declares, and no more."""
    recorded: dict[str, Any] = {n: n in description.capabilities for n in CHANNELS_BY_NEED}
    return replace(scenario, **recorded)


def flagged_m(profile: Profile, truth: Profile) -> float:
    """Return the largest length in m of a wheel path of ``truth`` that ``profile`` flags invalid.

    What is delivered beyond these wheel paths is not looked at.
    """
    asked = [track for track in profile.tracks if track.name in {t.name for t in truth.tracks}]
    lengths = (profile.interval_m * float(np.sum(~track.valid)) for track in asked)
    return max(lengths, default=0.0)


OUTSTANDING = 3
"""Recordings at most that are made and not asked for yet: without a cache they fill the memory."""


class Ahead:
    """Makes recordings in the order in which they were announced, one at a time.

    No more than `OUTSTANDING` are under way or waiting to be asked for. What is asked for before
    its turn is made at once by the one who asks, so that both work; what was announced before it
    is not waited for any more. The results are those of `make_taken`, whoever makes them.
    """

    def __init__(self, description: Description) -> None:
        """Make recordings with the channels that ``description`` allows."""
        self._description = description
        self._worker = ThreadPoolExecutor(1, "simulating-ahead")
        self._coming: dict[Scenario, Future[Taken] | None] = {}

    def announce(self, cases: Iterable[Case]) -> None:
        """Begin on what ``cases`` will ask for, as far as it is not on its way already."""
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
        return make_taken(scenario) if coming is None or at_once else coming.result()

    def close(self) -> None:
        """Drop what has not begun, and wait for what has."""
        self._worker.shutdown(cancel_futures=True)
        self._coming.clear()

    def _begin(self) -> None:
        """Have the first `OUTSTANDING` made, as far as they are not under way."""
        for scenario in list(islice(self._coming, OUTSTANDING)):
            if self._coming[scenario] is None:
                self._coming[scenario] = self._worker.submit(make_taken, scenario)

    def _drop(self, scenario: Scenario) -> None:
        coming = self._coming.pop(scenario)
        if coming is not None:
            coming.cancel()
