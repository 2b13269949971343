"""From a recording to blocks: all channels of a run on the accelerometer's clock.

A channel on that clock is passed through. Another is linear between its samples, which is
what `distance` is defined to be; its `fresh` mask tells where a new measurement came in. A
missing sample is bridged by the line between its neighbours and flagged; a longer gap of the
accelerometer disturbs the floating reference height, and one of the encoder may hide a stop; both
are flagged as that too. Samples that are there and yet measure nothing (`damage`,
`encoder_damage`) count as missing. GNSS samples keep their own times, as events.
"""

import math
from collections.abc import Iterator, Mapping, Sequence

import numpy as np

from floatref.architectures.aligned import AlignedChannel, Stretch
from floatref.architectures.covering import covering
from floatref.architectures.damage import Damage
from floatref.architectures.encoder_damage import encoder_damage
from floatref.architectures.events import GnssEvents
from floatref.architectures.kinematic_gnss import gnss_faults
from floatref.architectures.saturation import damaged_force
from floatref.architectures.steady import holes_told, steady_clock
from floatref.architectures.stuck import damaged_height
from floatref.errors import InputError
from floatref.stages.conditioning import SPECIFIC_FORCE
from floatref.stages.signals import DISTANCE, HEIGHT
from floatref.values.arrays import Flag, FlagArray
from floatref.values.block import Axis, Block, Header
from floatref.values.channels import ChannelId
from floatref.values.clock import UniformClock
from floatref.values.plausibility import profiled_tracks
from floatref.values.recording import Channel, Recording

BLOCK = 65_536
"""Samples per block: 4 s at 16 kHz, small enough for the cache."""


class Source:
    """The nominal channels of a recording as a stream of blocks.

    `header` is that of the stream; `origin_m` the distance at its first sample, `distance_m` what
    is travelled from there to the last; `length` the number of samples that all channels cover;
    `warnings` one line for each channel and kind of damage.
    """

    def __init__(self, recording: Recording, more: Sequence[str] = ()) -> None:
        """Find the wheel paths that have a height, and the time that all channels cover.

        Channels called one of ``more`` are taken beside the nominal ones. Raises InputError if a
        channel is missing.
        """
        self._tracks = profiled_tracks(recording)
        found = dict(_nominal(recording, self._tracks))
        clock = steady_clock(found[ChannelId(SPECIFIC_FORCE, self._tracks[0])])
        first, self.length = _common_span(list(found.values()), clock)
        begin_s, end_s = clock.times(2, first, self.length - 1).tolist()
        for channel in (recording.channel(name, t) for name in more for t in self._tracks):
            if channel.id not in found:
                found[channel.id] = covering(channel, begin_s, end_s)
        damage = {name: _damage(name, found) for name in found}
        holes = [line for name, c in found.items() if _is_force(name) for line in holes_told(c)]
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
        self._events = GnssEvents(recording, gnss_faults(recording))
        self.origin_m = self._distance(0)
        self.distance_m = np.fmax(self._distance(self.length - 1) - self.origin_m, 0.0)

    def blocks(self, size: int = BLOCK) -> Iterator[Block]:
        """Yield the run in blocks of ``size`` samples, each let go of before the next."""
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

    def _time(self, index: int) -> float:
        return self.header.origin + index * self.header.step


def _nominal(recording: Recording, tracks: tuple[str, ...]) -> Iterator[tuple[ChannelId, Channel]]:
    yield ChannelId(DISTANCE), recording.channel(DISTANCE, tracks[0])
    for track in tracks:
        for name in (SPECIFIC_FORCE, HEIGHT):
            yield ChannelId(name, track), recording.channel(name, track)


def _damage(name: ChannelId, found: Mapping[ChannelId, Channel]) -> Damage:
    if name.name == DISTANCE:
        return encoder_damage(found[name])
    if _is_force(name):
        return damaged_force(found[name])
    if name.name != HEIGHT:
        return Damage()
    force = found[ChannelId(SPECIFIC_FORCE, name.track)]
    return damaged_height(found[name], force, found[ChannelId(DISTANCE)])


def _is_force(name: ChannelId) -> bool:
    return name.name == SPECIFIC_FORCE


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
    lasting = {SPECIFIC_FORCE: Flag.DRIFT, DISTANCE: Flag.SLOW}.get(name.name)
    if lasting is not None and stretch.lost is not None:
        flags |= np.where(stretch.lost, np.uint8(lasting), np.uint8(0))
    return flags
