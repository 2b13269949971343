"""What a device makes of the probes: a profile, or nothing."""

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from math import inf
from time import monotonic

from floatref.values.profile import Profile
from floatref.values.recording import Recording
from floatref_conformance.checks.interface import Taken
from floatref_conformance.devices.interface import Description, Device
from floatref_conformance.devices.protocol import RUN_PER_LENGTH, RUN_S
from floatref_conformance.errors import DeviceError, DeviceHung, DeviceSkipped
from floatref_conformance.judge.exercise import exercise
from floatref_conformance.resemblance.probes import Probe, probes_for

LEAST_S = 0.001
"""Time in s that a device is given at least: 0 is no limit for it."""


class ProbesTooLong(Exception):
    """The time for all probes together is over."""


@dataclass(frozen=True, eq=False)
class Answer:
    """What a device made of one probe.

    Attributes:
        probe: the recording that it got.
        taken: that recording as all sensors took it, and the true road.
        profile: the profile; None if it delivered no usable one.
        fault: why there is no profile, in one line.
    """

    probe: Probe
    taken: Taken
    profile: Profile | None
    fault: str = ""


def ask_probes(
    device: Device,
    description: Description,
    probes: Sequence[Probe] | None = None,
    longest_s: float = inf,
) -> Iterator[Answer]:
    """Yield the device's answer to each probe that shows something of it.

    A device that hangs gets no further probe. NoRoom if the disk is full, ProbesTooLong if they
    take longer than ``longest_s``, in s; a device without a limit in time ends its probe first.
    """
    ends_s = monotonic() + longest_s
    for probe in probes_for(description) if probes is None else probes:
        taken = probe.take(description)
        if monotonic() >= ends_s:
            raise ProbesTooLong
        try:
            # A wrong axis or a missing wheel path is a feature here, and no fault.
            with _ending_at(device, taken.recording, ends_s):
                profile = exercise(device, description, taken.recording, None)
            yield Answer(probe, taken, profile)
        except DeviceHung as fault:
            if monotonic() >= ends_s:
                raise ProbesTooLong from fault
            yield Answer(probe, taken, None, str(fault))
            return
        except (DeviceError, DeviceSkipped) as fault:
            yield Answer(probe, taken, None, str(fault))


@contextmanager
def _ending_at(device: Device, recording: Recording, ends_s: float) -> Iterator[None]:
    """Let a device that has a limit in time hang at ``ends_s`` at the latest, by `monotonic`."""
    if not hasattr(device, "timeout_s"):
        yield
        return
    before = device.timeout_s
    own_s = before or RUN_S + RUN_PER_LENGTH * recording.duration_s
    try:
        device.timeout_s = min(own_s, max(ends_s - monotonic(), LEAST_S))
        yield
    finally:
        device.timeout_s = before
