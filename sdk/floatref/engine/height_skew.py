"""Heights that are later than their accelerometer, where a stop shows by how much, are moved."""

from collections.abc import Mapping
from dataclasses import dataclass, replace

from floatref.measures.clocks.sensor_skew import is_certain, skew_at_stops, skew_warning
from floatref.stages.conditioning import SPECIFIC_FORCE
from floatref.stages.signals import DISTANCE, HEIGHT
from floatref.values.channels import ChannelId
from floatref.values.clock import Clock, StampedClock
from floatref.values.recording import Channel, Recording


@dataclass(frozen=True)
class Aligned:
    """A recording whose heights have the accelerometers' time.

    Attributes:
        recording: with other clocks of the heights that were later or earlier.
        later_s: by how much each of those was later, by wheel path.
        warnings: one line for each.
    """

    recording: Recording
    later_s: Mapping[str, float]
    warnings: tuple[str, ...]


def align_heights(recording: Recording) -> Aligned:
    """Return ``recording`` with the heights moved whose skew is certain, see `is_certain`.

    Only stops are looked at. A height that is shared has the skew of its first wheel path.
    """
    later_s: dict[str, float] = {}
    lines: list[str] = []
    moved: dict[ChannelId, Channel] = {}
    for track in recording.tracks:
        found = [recording.find(name, track) for name in (SPECIFIC_FORCE, HEIGHT, DISTANCE)]
        force, height, distance = found
        if force is None or height is None or distance is None or height.id in moved:
            continue
        skew = skew_at_stops(force, height, distance)
        if is_certain(skew):
            later_s[track] = skew.skew_s
            moved[height.id] = replace(height, clock=_earlier(height.clock, skew.skew_s))
            lines.append(f"{skew_warning(skew, force, height)}; here the height was moved by that")
    channels = tuple(moved.get(channel.id, channel) for channel in recording.channels)
    aligned = replace(recording, channels=channels) if moved else recording
    return Aligned(aligned, later_s, tuple(lines))


def _earlier(clock: Clock, by_s: float) -> Clock:
    if isinstance(clock, StampedClock):
        return StampedClock(clock.times_s - by_s)
    return replace(clock, start_s=clock.start_s - by_s)
