"""Channels beside the nominal ones, made to last as long as these.

A slow sensor's last sample comes up to one of its steps before the end of the run. So short a
stretch keeps the nearest sample; a longer one counts as missing, and is flagged.
"""

from math import ceil

import numpy as np

from floatref.errors import InputError
from floatref.values.arrays import FloatArray
from floatref.values.clock import StampedClock, UniformClock
from floatref.values.recording import Channel

SHORT = 2
"""So many steps before its first or behind its last sample, a channel keeps that one."""
LEAST = 0.5
"""Part of the run that a channel has to cover."""


def covering(channel: Channel, begin_s: float, end_s: float) -> Channel:
    """Return ``channel`` with samples from ``begin_s`` to ``end_s`` at least.

    Raises InputError if it covers less than half of that time.
    """
    first, last = channel.span_s
    _check(channel, min(last, end_s) - max(first, begin_s), (begin_s, end_s))
    step = 1.0 / channel.mean_rate_hz if channel.values.size > 1 else end_s - begin_s
    before = max(0, ceil((first - begin_s) / step - 1e-3))
    behind = max(0, ceil((end_s - last) / step - 1e-3))
    if before == 0 and behind == 0:
        return channel
    values = np.concatenate(
        (_edge(channel.values[0], before), channel.values, _edge(channel.values[-1], behind))
    )
    if isinstance(channel.clock, UniformClock):
        start_s = channel.clock.start_s - before / float(channel.clock.rate)
        return Channel(channel.id, values, UniformClock(channel.clock.rate, start_s))
    early = first - step * np.arange(before, 0, -1)
    late = last + step * np.arange(1, behind + 1)
    times = np.concatenate((early, channel.clock.times_s, late))
    return Channel(channel.id, values, StampedClock.of(times))


def _edge(value: float, count: int) -> FloatArray:
    return np.full(count, value if count <= SHORT else np.nan)


def _check(channel: Channel, covered_s: float, run: tuple[float, float]) -> None:
    begin_s, end_s = run
    if covered_s < LEAST * (end_s - begin_s):
        first, last = channel.span_s
        raise InputError(
            f"channel {channel.id}: samples from {first:.9g} to {last:.9g} s, the run is from "
            f"{begin_s:.9g} to {end_s:.9g} s; check start_s, and give all channels one time base"
        )
