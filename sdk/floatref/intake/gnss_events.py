"""GNSS samples as events with their own times, at any rate."""

from math import ceil

import numpy as np

from floatref.screening.damage.damaged_samples import NONE, within
from floatref.values.arrays import IndexArray
from floatref.values.block import Event
from floatref.values.channels import ChannelId
from floatref.values.clock import StampedClock
from floatref.values.recording import Channel, Recording

PREFIX = "gnss_"
HEIGHT = "gnss_height"
QUALITY = "gnss_quality"


class GnssEvents:
    """The GNSS samples of a recording, in the order of their times."""

    def __init__(self, recording: Recording, stuck: IndexArray = NONE) -> None:
        """Take the channels whose names begin with ``gnss_``.

        ``stuck``, shape (k, 2), are first index and the one behind of heights to omit.
        """
        self._channels = [c for c in recording.channels if c.id.name.startswith(PREFIX)]
        self._stuck = stuck

    def between(self, begin_s: float, end_s: float) -> tuple[Event, ...]:
        """Return the events from ``begin_s`` up to, but without, ``end_s``.

        Samples of several channels at one time are one event; a missing sample is omitted.
        """
        found: dict[float, dict[ChannelId, float]] = {}
        for channel in self._channels:
            stuck = self._stuck if channel.id.name == HEIGHT else NONE
            for time, value in _samples(channel, begin_s, end_s, stuck):
                found.setdefault(time, {})[channel.id] = value
        return tuple(Event(time, values) for time, values in sorted(found.items()))


def _samples(
    channel: Channel, begin_s: float, end_s: float, stuck: IndexArray
) -> list[tuple[float, float]]:
    low, high = _range(channel, begin_s, end_s)
    times = channel.clock.times(high - low, low).tolist()
    values, mask = channel.values[low:high], within(stuck, low, high)
    if mask is not None:
        values = np.where(mask, np.nan, values)
    pairs = zip(times, values.tolist(), strict=True)
    # An unknown quality does not count as a fixed ambiguity.
    kept = channel.id.name == QUALITY
    return [(time, value) for time, value in pairs if kept or value == value]


def _range(channel: Channel, begin_s: float, end_s: float) -> tuple[int, int]:
    clock, count = channel.clock, channel.values.size
    if isinstance(clock, StampedClock):
        low, high = clock.times_s.searchsorted((begin_s, end_s))
        return int(low), int(high)
    low, high = (ceil((t - clock.start_s) * float(clock.rate)) for t in (begin_s, end_s))
    return min(max(low, 0), count), min(max(high, 0), count)
