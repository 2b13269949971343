"""What a device makes of the probes: a profile, or nothing."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from floatref.values.profile import Profile
from floatref_conformance.checks.interface import Taken
from floatref_conformance.devices.interface import Description, Device
from floatref_conformance.errors import DeviceError, DeviceHung, DeviceSkipped
from floatref_conformance.judge.exercise import exercise
from floatref_conformance.resemblance.probes import Probe, probes_for


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
    device: Device, description: Description, probes: Sequence[Probe] | None = None
) -> Iterator[Answer]:
    """Yield the device's answer to each probe that shows something of it.

    A device that hangs gets no further probe. NoRoom if the disk is full.
    """
    for probe in probes_for(description) if probes is None else probes:
        taken = probe.take(description)
        try:
            # A wrong axis or a missing wheel path is a feature here, and no fault.
            profile = exercise(device, description, taken.recording, None)
            yield Answer(probe, taken, profile)
        except DeviceHung as fault:
            yield Answer(probe, taken, None, str(fault))
            return
        except (DeviceError, DeviceSkipped) as fault:
            yield Answer(probe, taken, None, str(fault))
