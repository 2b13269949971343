"""The noise of one channel at rest: its sound stretch, and the coefficients of its noise there."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np

from floatref.errors import InputError
from floatref.measures.allan.deviation import FEWEST, AllanDeviation, allan_deviation
from floatref.measures.allan.noise_fit import FEWEST_TIMES, NoiseFit, fit_noise
from floatref.values.arrays import FloatArray, IndexArray
from floatref.values.channels import ChannelId
from floatref.values.clock import StampedClock
from floatref.values.recording import Channel
from floatref.values.scanning import chunks, median_step

UNEVEN = 0.25
"""A step of time may differ from the usual one by this share of it."""


@dataclass(frozen=True)
class Stretch:
    """``count`` samples from ``first`` on, ``interval_s`` apart, without a missing sample.

    ``left_out`` samples of the channel are not in it. A reading is repeated in ``held`` samples on
    average, 1 for a sensor as fast as its channel, and in ``longest_held`` at most.
    """

    first: int
    count: int
    interval_s: float
    left_out: int
    held: float
    longest_held: int


@dataclass(frozen=True, eq=False)
class ChannelNoise:
    """Allan deviation and noise coefficients of a channel at rest, over its sound stretch.

    ``begin_s`` and ``end_s`` are the times of the first and the last sample in s.
    """

    id: ChannelId
    unit: str
    begin_s: float
    end_s: float
    stretch: Stretch
    allan: AllanDeviation
    fit: NoiseFit


def channel_noise(
    channel: Channel,
    between_s: tuple[float, float] | None = None,
    progress: Callable[[float], None] | None = None,
) -> ChannelNoise:
    """Return the noise of ``channel`` over its longest stretch without gaps.

    The curve (6.53) is fitted to the cluster times in ``between_s``, in s; by default to all but
    the shortest ones of a band-limited sensor. ``progress`` is called with the share that is done.
    Raises InputError naming the channel if it has no stretch of 64 samples at even times, never
    changes, or has fewer than 8 cluster times in ``between_s``.
    """
    stretch = sound_stretch(channel)
    values = channel.values[stretch.first : stretch.first + stretch.count]
    begin, end = channel.clock.times(2, stretch.first, max(stretch.count - 1, 1))
    try:
        allan = allan_deviation(values, stretch.interval_s, progress)
        fit = fit_noise(_part(allan, *(between_s or (allan.settled_s, np.inf))))
    except InputError as error:
        raise InputError(f"channel {channel.id}: {error}") from error
    return ChannelNoise(channel.id, channel.unit, float(begin), float(end), stretch, allan, fit)


def _part(allan: AllanDeviation, shortest_s: float, longest_s: float) -> AllanDeviation:
    """Return the cluster times to fit; InputError unless they are enough."""
    part = allan.between(shortest_s, longest_s)
    if part.clusters.size < FEWEST_TIMES:
        first_s, last_s = allan.cluster_s[[0, -1]]
        raise InputError(
            f"{part.clusters.size} cluster times from {shortest_s:g} s to {longest_s:g} s, a fit "
            f"takes {FEWEST_TIMES}; there are some from {first_s:.3g} s to {last_s:.3g} s"
        )
    return part


def sound_stretch(channel: Channel) -> Stretch:
    """Return the longest stretch of ``channel`` with even times and no sample missing.

    Raises InputError naming the channel if it has fewer than 64 samples.
    """
    broken = np.unique(np.concatenate([[-1], *_broken(channel), [channel.values.size - 1]]))
    lengths = np.diff(broken)
    longest = int(lengths.argmax())
    first, count = int(broken[longest]) + 1, int(lengths[longest])
    if count < FEWEST:
        raise InputError(
            f"channel {channel.id}: of {channel.values.size} samples no {FEWEST} in a row are "
            "there at even times; record for longer, or give rate_hz in place of time stamps if "
            "the sensor's clock is even"
        )
    begin, end = channel.clock.times(2, first, count - 1)
    changes, longest_held = _holds(channel.values[first : first + count])
    return Stretch(
        first,
        count,
        float(end - begin) / (count - 1),
        channel.values.size - count,
        count / (1 + changes),
        longest_held,
    )


def _broken(channel: Channel) -> Iterator[IndexArray]:
    """Yield the samples after which the next one is missing or comes at an uneven time."""
    for first, chunk in chunks(channel.values, overlap=1):
        known = ~np.isnan(chunk)
        yield first + np.flatnonzero(~(known[:-1] & known[1:]))
    if isinstance(channel.clock, StampedClock):
        usual = median_step(channel.clock.times_s)
        for first, chunk in chunks(channel.clock.times_s, overlap=1):
            yield first + np.flatnonzero(np.abs(np.diff(chunk) - usual) > UNEVEN * usual)


def _holds(values: FloatArray) -> tuple[int, int]:
    """Return how often ``values`` change, and how many in a row are the same at most."""
    changes, longest, since = 0, 1, 0
    for first, chunk in chunks(values, overlap=1):
        changed = first + 1 + np.flatnonzero(np.diff(chunk))
        if changed.size:
            longest = max(longest, int(np.diff(changed, prepend=since).max()))
            since = int(changed[-1])
        changes += changed.size
    return changes, max(longest, values.size - since)
