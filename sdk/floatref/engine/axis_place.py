"""Where a recording that is part of a longer one lies on that one's axis of distance.

A part has the encoder's distance, from which slip was taken off since its own first sample alone. A
`Place` moves it to where the parts before it ended, and puts its points on whole multiples of the
interval, so that the points of all parts are those of one profile.
"""

from dataclasses import dataclass, replace
from math import ceil

import numpy as np

from floatref.stages.signals import DISTANCE
from floatref.values.arrays import FloatArray
from floatref.values.clock import LATEST_S, UniformClock
from floatref.values.recording import Channel, Recording

FIRST_REACH = 64
"""Samples around a time among which known ones are looked for first."""
NEAREST = 5
"""Samples around a time of which one or two may be wrong."""
WRONG_M = 0.5
"""A correction at one sample that differs from that around it by more, in m, is of that sample."""
TIE = 1e-9
"""Share of an interval by which a distance may be beyond a point and still count as on it."""


@dataclass(frozen=True)
class Place:
    """The place of a part.

    Attributes:
        at_s: a time in s within the part.
        offset_m: distance along the axis at that time, minus the encoder's, in m.
    """

    at_s: float
    offset_m: float = 0.0

    def move(self, recorded: Recording, corrected: Recording) -> Recording:
        """Return ``corrected`` with every distance moved to its place.

        ``recorded`` is the same recording before its distances were corrected.
        """
        moved_m = self.offset_m - offset_at(recorded, corrected, self.at_s)
        if moved_m == 0.0:
            return corrected
        channels = tuple(
            replace(c, values=c.values + moved_m) if c.id.name == DISTANCE else c
            for c in corrected.channels
        )
        return replace(corrected, channels=channels)


def first_point(distance_m: float, interval_m: float) -> float:
    """Return the first multiple of ``interval_m`` that is not before ``distance_m``, in m."""
    return point_number(distance_m, interval_m) * interval_m


def point_number(distance_m: float, interval_m: float) -> int:
    """Return the number of that point, counted from the origin of the axis."""
    return ceil(distance_m / interval_m - TIE)


def offset_at(recorded: Recording, corrected: Recording, at_s: float) -> float:
    """Return by how many m the distance of ``corrected`` is ahead of the encoder's at a time.

    It is exactly zero where nothing was corrected. A wrong sample of the encoder there, which was
    corrected, does not move the axis: the samples around it decide.
    """
    offset = distance_at(corrected, at_s) - distance_at(recorded, at_s)
    if offset == 0.0:
        return offset
    times, _ = nearest_samples(recorded, at_s)
    around = [distance_at(corrected, t) - distance_at(recorded, t) for t in times.tolist()]
    usual = float(np.median(around)) if around else offset
    return offset if abs(offset - usual) <= WRONG_M else usual


def nearest_samples(recording: Recording, at_s: float) -> tuple[FloatArray, FloatArray]:
    """Return times in s and distances in m of the `NEAREST` known samples around a time."""
    channel: Channel = recording.channel(DISTANCE, recording.tracks[0])
    times, values = _around(channel, at_s)
    at = max(min(at_s, LATEST_S), -LATEST_S)
    nearest = np.argsort(np.abs(times - at), kind="stable")[:NEAREST]
    return times[nearest], values[nearest]


def distance_at(recording: Recording, at_s: float) -> float:
    """Return the distance in m at a time in s, linear between known samples; NaN without any."""
    channel: Channel = recording.channel(DISTANCE, recording.tracks[0])
    times, values = _around(channel, at_s)
    if not times.size:
        return float("nan")
    return float(np.interp(at_s, times, values))


def _around(channel: Channel, at_s: float) -> tuple[FloatArray, FloatArray]:
    """Return known samples, on either side of ``at_s`` at least one if there are any."""
    size, clock = channel.values.size, channel.clock
    if isinstance(clock, UniformClock):
        middle = (max(min(at_s, LATEST_S), -LATEST_S) - clock.start_s) * float(clock.rate)
    else:
        middle = float(np.searchsorted(clock.times_s, at_s))
    number, reach = round(min(max(middle, 0.0), size)), FIRST_REACH
    while True:
        low, high = max(0, number - reach), min(size, number + reach)
        values = channel.values[low:high]
        known = ~np.isnan(values)
        times = clock.times(high - low, low)[known]
        before, behind = bool((times <= at_s).any()), bool((times > at_s).any())
        if (before or low == 0) and (behind or high == size):
            return times, values[known]
        reach *= 16
