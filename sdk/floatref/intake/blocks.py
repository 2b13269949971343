"""From a recording to blocks: all channels of a run on the accelerometer's clock.

A channel on that clock is passed through. Another is linear between its samples, which is the
definition of `distance`; its `fresh` mask marks new measurements. A missing sample is bridged by
the line between its neighbours and flagged; a longer gap of the accelerometer disturbs the floating
reference height, and one of the encoder may hide a stop; both have flags of their own. Samples that
are present but measure nothing (`damage`, `encoder_damage`) count as missing. GNSS samples keep
their own times, as events.
"""

import math
from collections.abc import Iterator, Mapping, Sequence
from math import ceil

import numpy as np

from floatref.errors import InputError
from floatref.intake.aligned import AlignedChannel, Stretch, bridge
from floatref.intake.gnss_events import GnssEvents
from floatref.intake.steady_rate import report_holes, steady_clock
from floatref.screening.damage.damaged_samples import Damage
from floatref.screening.damage.encoder_damage import encoder_damage
from floatref.screening.damage.saturation import find_saturation
from floatref.screening.damage.spikes import find_spikes
from floatref.screening.damage.stuck_sensors import (
    combine_damage,
    find_stuck_force,
    find_stuck_height,
)
from floatref.screening.findings import Screening
from floatref.screening.second_sensor.doubtful_samples import replaced_by_doubt
from floatref.stages.conditioning import SPECIFIC_FORCE
from floatref.stages.signals import DISTANCE, HEIGHT
from floatref.values.arrays import Flag, FlagArray, FloatArray
from floatref.values.block import Axis, Block, Header
from floatref.values.channels import ChannelId
from floatref.values.clock import StampedClock, UniformClock
from floatref.values.needs import VERTICAL_FORCES, Needs
from floatref.values.recording import Channel, Recording

SHORT = 2
"""Number of steps before its first and behind its last sample for which a channel is constant."""
LEAST = 0.5
"""Smallest part of the run that a channel must cover."""


def extend_to_cover(channel: Channel, begin_s: float, end_s: float) -> Channel:
    """Return ``channel``, extended to at least ``begin_s`` to ``end_s``.

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


BLOCK = 65_536
"""Samples per block: 4 s at 16 kHz, small enough for the cache."""
RANGES = HEIGHT, "suspension_deflection", "rear_suspension_deflection"
"""Sensors that are stuck if they are constant while the accelerometer beside them is not."""


class Source:
    """The channels of a recording that a pipeline needs, as a stream of blocks.

    `header` is that of the stream; `origin_m` the distance at its first sample, `distance_m` the
    distance travelled from there to the last; `ends_m` the encoder's first and last distance, less
    than a sample away; `fastest_mps` the fastest speed over a second of the recording; `length` the
    number of samples that all channels cover; `gone` the damaged stretches of every channel, first
    index and the one behind, shape (k, 2); `warnings` one line for each channel and kind of damage.
    """

    def __init__(self, screening: Screening, more: Sequence[str] = ()) -> None:
        """Find the channels that are needed, and the time that all of them cover.

        Channels named in ``more`` are added. Raises InputError if a channel is missing.
        """
        recording, needs = screening.recording, screening.needs
        self._tracks = needs.tracks
        found = dict(_select_needed(recording, needs))
        clock = steady_clock(found[ChannelId(needs.force, self._tracks[0])])
        first, self.length = _common_span(list(found.values()), clock)
        begin_s, end_s = clock.times(2, first, self.length - 1).tolist()
        for channel in (recording.channel(name, t) for name in more for t in self._tracks):
            if channel.id not in found:
                found[channel.id] = extend_to_cover(channel, begin_s, end_s)
        damage = {name: _damage(name, found, needs.force) for name in found}
        damage |= {
            name: replaced_by_doubt(found[name], d, screening.doubts) for name, d in damage.items()
        }
        holes = [line for name, c in found.items() if _is_force(name) for line in report_holes(c)]
        self.gone = {name: each.gone for name, each in damage.items()}
        self.warnings = (*holes, *(line for d in damage.values() for line in d.warnings))
        self._aligned = {
            name: AlignedChannel(channel, clock, first, damage[name])
            for name, channel in found.items()
        }
        self.header = Header(
            axis=Axis.TIME,
            step=float(1 / clock.rate),
            origin=float(clock.times(1, first)[0]),
            rate=clock.rate,
            channels=frozenset(self._aligned),
            tracks=self._tracks,
            setup=recording.setup,
        )
        self._events = GnssEvents(recording, screening.gnss_faults)
        self.origin_m = self._distance(0)
        self.distance_m = np.fmax(self._distance(self.length - 1) - self.origin_m, 0.0)
        self.ends_m = self._ends(found[ChannelId(DISTANCE)])
        self.fastest_mps = screening.travel.fastest_mps

    def blocks(self, size: int = BLOCK) -> Iterator[Block]:
        """Yield the run in blocks of ``size`` samples, each released before the next."""
        for begin in range(0, self.length, size):
            yield self._block(begin, min(begin + size, self.length))
            for channel in self._aligned.values():
                channel.release()

    def _block(self, begin: int, end: int) -> Block:
        taken = {name: channel.take(begin, end) for name, channel in self._aligned.items()}
        return Block(
            begin,
            {name: stretch.values for name, stretch in taken.items()},
            {name: s.fresh for name, s in taken.items() if s.fresh is not None},
            {name: flags for name, s in taken.items() if (flags := _flags(name, s)) is not None},
            self._events.between(self._time(begin), self._time(end)),
        )

    def _distance(self, index: int) -> float:
        return float(self._aligned[ChannelId(DISTANCE)].take(index, index + 1).values[0])

    def _ends(self, encoder: Channel) -> tuple[float, float]:
        """Return the distances at the encoder's own ends, where they are those of the stream."""
        size, step = encoder.values.size, self.header.step
        first, last = self.origin_m, self.origin_m + self.distance_m
        begin, end = self._time(0), self._time(self.length - 1)
        if begin - encoder.span_s[0] < step:
            first = min(first, _known(encoder, 0))
        if encoder.span_s[1] - end < step:
            last = max(last, _known(encoder, size - 1))
        return first, last

    def _time(self, index: int) -> float:
        return self.header.origin + index * self.header.step


def _known(channel: Channel, index: int) -> float:
    """Return a sample; a missing one is interpolated between the known ones beside it."""

    def read(low: int, high: int) -> FloatArray:
        return channel.values[low:high]

    values, *_ = bridge(read, channel.values.size, index, index + 1)
    return float(values[0])


def _select_needed(recording: Recording, needs: Needs) -> Iterator[tuple[ChannelId, Channel]]:
    """Yield the channels of ``needs``; a shared one is yielded for every wheel path."""
    yield ChannelId(DISTANCE), recording.channel(DISTANCE, needs.tracks[0])
    for track in needs.tracks:
        yield ChannelId(needs.force, track), recording.channel(needs.force, track)
        for name in needs.others:
            channel = recording.find(name, track)
            if channel is not None:
                yield ChannelId(name, track), channel


def _damage(name: ChannelId, found: Mapping[ChannelId, Channel], force: str) -> Damage:
    if name.name == DISTANCE:
        return encoder_damage(found[name])
    if _is_force(name):
        damage = combine_damage(find_saturation(found[name]), find_spikes(found[name]))
        if name.name == SPECIFIC_FORCE:
            return damage
        return combine_damage(damage, find_stuck_force(found[name], found[ChannelId(DISTANCE)]))
    if name.name not in RANGES:
        return Damage()
    beside = found[ChannelId(force, name.track)]
    stuck = find_stuck_height(found[name], beside, found[ChannelId(DISTANCE)])
    return combine_damage(stuck, find_spikes(found[name])) if name.name == HEIGHT else stuck


def _is_force(name: ChannelId) -> bool:
    return name.name in VERTICAL_FORCES


def _common_span(channels: list[Channel], clock: UniformClock) -> tuple[int, int]:
    begin = max(channel.span_s[0] for channel in channels)
    end = min(channel.span_s[1] for channel in channels)
    rate = float(clock.rate)
    # A thousandth of a step: the channels' own start times are rounded decimals.
    first = max(0, math.ceil((begin - clock.start_s) * rate - 1e-3))
    last = math.floor((end - clock.start_s) * rate + 1e-3)
    if last <= first:
        names = ", ".join(str(channel.id) for channel in channels)
        raise InputError(f"channels {names} have no stretch of time in common; check start_s")
    return first, last - first + 1


def _flags(name: ChannelId, stretch: Stretch) -> FlagArray | None:
    if stretch.missing is None:
        return None
    flags = np.where(stretch.missing, np.uint8(Flag.MISSING), np.uint8(0))
    lasting = Flag.SLOW if name.name == DISTANCE else Flag.DRIFT
    if stretch.lost is not None and (name.name == DISTANCE or _is_force(name)):
        flags |= np.where(stretch.lost, np.uint8(lasting), np.uint8(0))
    return flags
