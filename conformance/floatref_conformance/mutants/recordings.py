"""Mutations of a recording before it is processed."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from floatref.values.arrays import FloatArray
from floatref.values.channels import STANDARD_GRAVITY
from floatref.values.recording import Channel, Recording
from floatref_conformance.mutants.mutation import Before

FORCE, HEIGHT, DISTANCE = "vertical_specific_force", "height", "distance"
JITTER = 0.0005
Change = Callable[[Channel], FloatArray]


def change_channel(name: str, change: Change) -> Before:
    """Return a mutation that applies ``change`` to every channel ``name``."""

    def mutate(recording: Recording) -> Recording:
        return _each(recording, lambda c: _replace_values(c, change(c)) if c.id.name == name else c)

    return mutate


def replace_by_rest(channel: Channel) -> FloatArray:
    """Return 1 g for every sample, with a tiny ripple: constant samples would be refused."""
    return _ripple(STANDARD_GRAVITY, channel)


def hold_first(channel: Channel) -> FloatArray:
    """Return the first sample for all, with a tiny ripple: constant ones would be detected."""
    return _ripple(float(channel.values[0]), channel)


def _ripple(level: float, channel: Channel) -> FloatArray:
    values = np.full(channel.values.size, level)
    values[1::2] += 1e-13
    return values


def mirror(channel: Channel) -> FloatArray:
    """Return the samples with the sign of every change inverted."""
    return np.asarray(2.0 * channel.values[0] - channel.values)


def invert_acceleration(channel: Channel) -> FloatArray:
    """Return the accelerations with inverted sign; gravity does not change."""
    return np.asarray(2.0 * STANDARD_GRAVITY - channel.values)


def scale(gain: float) -> Change:
    """Return a change that multiplies a channel by ``gain``."""
    return lambda channel: np.asarray(gain * channel.values)


def scale_acceleration(gain: float) -> Change:
    """Return a change that multiplies the acceleration by ``gain``, but not gravity."""
    return lambda c: STANDARD_GRAVITY + gain * (c.values - STANDARD_GRAVITY)


def add_offset(offset: float) -> Change:
    """Return a change that adds ``offset`` to a channel, in its unit."""
    return lambda channel: np.asarray(channel.values + offset)


def clip(reach: float) -> Change:
    """Return a change that limits an accelerometer to 1 g ± ``reach``, in m/s²."""
    return lambda c: np.clip(c.values, STANDARD_GRAVITY - reach, STANDARD_GRAVITY + reach)


def delay_by(delay_s: float) -> Change:
    """Return a change that delays a channel by ``delay_s``; it begins with its first sample."""

    def delay(channel: Channel) -> FloatArray:
        times = channel.times_s
        return np.interp(times - delay_s, times, channel.values)

    return delay


def lose_samples(every: int) -> Change:
    """Return a change that loses one of ``every`` samples; later samples move forward."""

    def lose(channel: Channel) -> FloatArray:
        index = np.arange(channel.values.size)
        later = np.minimum(index + index // (every - 1), index.size - 1)
        return np.asarray(channel.values[later])

    return lose


def fill_missing(value: float) -> Change:
    """Return a change that replaces missing samples by ``value`` and ``value`` + `JITTER` in turn.

    Constant samples would be detected as those of a stuck sensor.
    """

    def fill(channel: Channel) -> FloatArray:
        jitter = JITTER * (np.arange(channel.values.size) % 2)
        return np.where(np.isnan(channel.values), value + jitter, channel.values)

    return fill


def bridge_missing(recording: Recording) -> Recording:
    """Return ``recording`` with straight lines in place of missing samples."""

    def bridge(channel: Channel) -> Channel:
        seen = np.flatnonzero(np.isfinite(channel.values))
        index = np.arange(channel.values.size)
        return _replace_values(channel, np.interp(index, seen, channel.values[seen]))

    return _each(recording, bridge)


def round_times(recording: Recording) -> Recording:
    """Return ``recording`` with the samples at times that are rounded to 24 bits, in s."""

    def round_each(channel: Channel) -> Channel:
        times = channel.times_s
        known = times.astype(np.float32).astype(np.float64)
        nearest = np.rint(np.interp(known, times, np.arange(times.size)))
        return _replace_values(channel, channel.values[nearest.astype(np.intp)])

    return _each(recording, round_each)


def _each(recording: Recording, change: Callable[[Channel], Channel]) -> Recording:
    return replace(recording, channels=tuple(change(c) for c in recording.channels))


def _replace_values(channel: Channel, values: FloatArray) -> Channel:
    return Channel.of(channel.id.name, values, channel.clock, channel.id.track)
