"""Where a fault acts: a channel, a stretch of the run, its clock, or two channels exchanged."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from floatref.values.arrays import FloatArray
from floatref.values.channels import ChannelId
from floatref.values.recording import Channel, Recording
from floatref_conformance.faults.sample_faults import Effect

DISTANCE = "distance"
BEGIN_M = 250.0
"""Distance in m at which a fault of a stretch begins: within the scored road of both drives."""

Fault = Callable[[Recording, np.random.Generator], Recording]
"""Returns a faulty recording."""
Change = Callable[[Channel, Recording, np.random.Generator], Channel]
"""Returns a faulty channel of a recording."""


def ours(recording: Recording, name: str) -> ChannelId:
    """Return the channel ``name`` of the first wheel path, or the shared one."""
    return recording.channel(name, recording.tracks[0]).id


def change(name: str, how: Change) -> Fault:
    """Return the fault of channel ``name``, of the first wheel path if each has its own."""

    def apply(recording: Recording, source: np.random.Generator) -> Recording:
        there = ours(recording, name)
        channels = tuple(
            how(c, recording, source) if c.id == there else c for c in recording.channels
        )
        return replace(recording, channels=channels)

    return apply


def on_run(effect: Effect) -> Change:
    """Return the change by ``effect`` of the whole run."""
    return on_stretch(effect, 0.0, None)


def on_stretch(effect: Effect, length_s: float | None, begin_m: float | None = BEGIN_M) -> Change:
    """Return the change by ``effect`` for ``length_s`` from ``begin_m`` on.

    Without ``begin_m`` it is of the whole run; without ``length_s`` it lasts to the end.
    """

    def apply(channel: Channel, recording: Recording, source: np.random.Generator) -> Channel:
        times, values = channel.times_s, np.array(channel.values)
        begin_s = times[0] if begin_m is None else time_at(recording, begin_m)
        end_s = np.inf if begin_m is None or length_s is None else begin_s + length_s
        first, behind = np.searchsorted(times, [begin_s, end_s])
        behind = max(int(behind), int(first) + 1)
        values[first:behind] = effect(values[first:behind], times[first:behind], source)
        return replace(channel, values=values)

    return apply


def time_at(recording: Recording, place_m: float) -> float:
    """Return the time in s when the encoder reaches ``place_m``."""
    encoder = recording.channel(DISTANCE)
    at = int(np.searchsorted(encoder.values, place_m))
    return float(encoder.times_s[min(at, encoder.values.size - 1)])


def late(delay_s: float, begin_m: float | None = None) -> Change:
    """Return the change of a channel that is ``delay_s`` late, from ``begin_m`` on if given."""

    def apply(channel: Channel, recording: Recording, source: np.random.Generator) -> Channel:
        times = channel.times_s
        begin_s = -np.inf if begin_m is None else time_at(recording, begin_m)
        return _read_at(channel, times - np.where(times >= begin_s, delay_s, 0.0))

    return apply


def clock_fast(share: float) -> Change:
    """Return the change of a channel whose clock runs ``share`` too fast; below 0 too slow.

    A sample at the time t of its own clock is of t / (1 + share). A slow clock ends early.
    """

    def apply(channel: Channel, recording: Recording, source: np.random.Generator) -> Channel:
        times = channel.times_s
        true_s = times[0] + (times - times[0]) / (1.0 + share)
        return _read_at(channel, true_s[true_s <= times[-1]])

    return apply


def _read_at(channel: Channel, true_s: FloatArray) -> Channel:
    """Return ``channel`` with what it measured at ``true_s``, as its first samples."""
    return replace(channel, values=np.interp(true_s, channel.times_s, channel.values))


def state_rate(factor: float) -> Change:
    """Return the change of a channel whose stated rate is ``factor`` times the true one."""

    def apply(channel: Channel, recording: Recording, source: np.random.Generator) -> Channel:
        from floatref.values.clock import UniformClock

        begin_s, rate = channel.span_s[0], factor * channel.mean_rate_hz
        return replace(channel, clock=UniformClock.of(rate, begin_s))

    return apply


def exchange(*pairs: tuple[str, str]) -> Fault:
    """Return the fault of channels whose samples are exchanged, pair by pair.

    ``left.height`` names a channel of a wheel path by the file's rule.
    """

    def apply(recording: Recording, source: np.random.Generator) -> Recording:
        other = dict(pairs) | {b: a for a, b in pairs}
        named = {str(c.id): c for c in recording.channels}
        channels = tuple(
            replace(c, values=named[other[str(c.id)]].values) if str(c.id) in other else c
            for c in recording.channels
        )
        return replace(recording, channels=channels)

    return apply


def copy(target: str, origin: str) -> Fault:
    """Return the fault of channel ``target`` that has the samples of channel ``origin``."""

    def apply(recording: Recording, source: np.random.Generator) -> Recording:
        named = {str(c.id): c for c in recording.channels}
        channels = tuple(
            replace(c, values=named[origin].values) if str(c.id) == target else c
            for c in recording.channels
        )
        return replace(recording, channels=channels)

    return apply


def mix(name: str, other: str, angle_rad: float) -> Fault:
    """Return the fault of an axis ``name`` that is turned by ``angle_rad`` towards ``other``."""

    def apply(recording: Recording, source: np.random.Generator) -> Recording:
        beside = recording.channel(other, recording.tracks[0]).values

        def turn(channel: Channel, all_: Recording, random: np.random.Generator) -> Channel:
            turned = np.cos(angle_rad) * channel.values + np.sin(angle_rad) * beside
            return replace(channel, values=turned)

        return change(name, turn)(recording, source)

    return apply
