"""From the time axis to the distance axis: projection of the profile, trigger of the samples."""

from collections.abc import Mapping

import numpy as np

from floatref.errors import InputError
from floatref.stages.marks import flags_of
from floatref.stages.protocol import Declared, Stage
from floatref.stages.signals import DISTANCE, TIME, TIME_STEP
from floatref.values.arrays import LASTING, FlagArray, FloatArray, IndexArray, frozen
from floatref.values.block import Axis, Block, Header
from floatref.values.channels import ChannelId

MOST_POINTS = 10_000_000
"""Most points in one block; more means a distance in another unit, or a leap."""


class ToDistance(Stage):
    """Takes one sample of every channel per ``interval_m`` of encoder distance.

    Point k lies at ``origin_m + k * interval_m``. It takes the first time sample that has reached
    it, so a stop gives no points (section 5.3); where time samples are further apart than the
    interval, it is linear in distance between them. `distance` is dropped, and so are samples at
    which the encoder is missing or behind its largest distance. A point has the flags of the
    samples it is read from; those that are `LASTING` of any sample since the point before reach it
    too, for a stop of any length. Flags behind the last point belong to that point, which is
    therefore held back.

    With ``keep_time`` each point gets the channel `time` that an encoder-triggered engine
    stores with its sample (section 5.8).
    """

    declared = Declared(shift_invariant=False, delay=1)

    def __init__(self, interval_m: float, origin_m: float, keep_time: bool = False) -> None:
        """Sample at ``interval_m`` from ``origin_m`` on."""
        super().__init__()
        self.interval_m, self.origin_m, self.keep_time = interval_m, origin_m, keep_time
        self._rate = 1.0

    def open(self, header: Header) -> Header:
        """Ask for the distance; change the axis."""
        if header.axis is not Axis.TIME:
            raise InputError(f"stage {self.name}: the stream is not on the time axis")
        header.require(self.name, ChannelId(DISTANCE))
        self._rate = float(header.rate)
        self.memory = {"next": 0, "carry": None, "pending": {}, "held": None}
        points = header.on_distance(self.interval_m, self.origin_m).without(DISTANCE)
        return points.adding(ChannelId(TIME)) if self.keep_time else points

    def advance(self, block: Block) -> Block:
        """Take the points that lie within the block."""
        if len(block) == 0:
            none = {ChannelId(TIME): np.empty(0)} if self.keep_time else {}
            points = Block(self.memory["next"], {**block.without(DISTANCE).values, **none})
            return self._but_last(points)
        own = block[ChannelId(DISTANCE)]
        before, marks = self.memory["carry"] or _first(block, own[0])
        distance = _farthest(before[ChannelId(DISTANCE)], own)
        sample, part = self._points(distance)
        wide = _flags_behind(block, marks)
        self.memory["carry"] = _last(block, wide, distance[-1])
        first = self.memory["next"]
        self.memory["next"] = first + sample.size
        others = block.without(DISTANCE).values
        values = {c: _at(before[c], x, sample, part) for c, x in others.items()}
        flags = self._flags(wide, tuple(others), distance.size, sample, part)
        if self.keep_time:
            values[ChannelId(TIME)] = ((block.first + sample - 2) + part) / self._rate
        return self._but_last(Block(first, values, flags=flags))

    def close(self) -> tuple[Block, ...]:
        """Return the last point, with the lasting flags of what came behind it."""
        held: Block | None = self.memory["held"]
        if held is None:
            return ()
        pending = {c: np.uint8(f) for c, f in self.memory["pending"].items() if f}
        blank = np.zeros(1, np.uint8)
        return (held.setting({}, {c: held.flags.get(c, blank) | f for c, f in pending.items()}),)

    def _but_last(self, points: Block) -> Block:
        """Hold the last point back and return the one held before with the others."""
        held: Block | None = self.memory["held"]
        if len(points) == 0:
            return points if held is None else _part(held, slice(0, 0))
        joined = points if held is None else _join(held, points)
        self.memory["held"] = _part(joined, slice(len(joined) - 1, len(joined)))
        return _part(joined, slice(0, len(joined) - 1))

    def _flags(
        self,
        wide: Mapping[ChannelId, FlagArray],
        channels: tuple[ChannelId, ...],
        count: int,
        sample: IndexArray,
        part: FloatArray,
    ) -> dict[ChannelId, FlagArray]:
        from floatref.kernels import motion

        late = wide.get(ChannelId(DISTANCE))
        pending, found = self.memory["pending"], {}
        # The time of a point is as the encoder's distance.
        time = (ChannelId(TIME),) if self.keep_time else ()
        for channel in (*channels, *time):
            own = [f for f in (wide.get(channel), late) if f is not None]
            if not own and not pending.get(channel):
                continue
            marks = np.bitwise_or.reduce(own or [np.zeros(count, np.uint8)])
            gathered = np.empty(sample.size, np.uint8)
            pending[channel] = motion.gather_flags(
                marks, sample, part, int(LASTING), pending.get(channel, 0), gathered
            )
            found[channel] = gathered
        return found

    def _points(self, distance: FloatArray) -> tuple[IndexArray, FloatArray]:
        from floatref.kernels import motion

        first = self.memory["next"]
        reach = (distance[-1] - self.origin_m) / self.interval_m - first
        if not reach < MOST_POINTS:
            raise InputError(
                f"channel distance: leaps by {reach * self.interval_m:.0f} m; "
                "it must be the encoder distance in m"
            )
        room = max(0, int(reach)) + 2
        sample, part = np.empty(room, np.int64), np.empty(room)
        found = motion.find_points(distance, self.origin_m, self.interval_m, first, sample, part)
        return sample[:found], part[:found]


class TimeStep(Stage):
    """Adds `time_step`, the time from the trigger before to this one: (5.4)."""

    declared = Declared(shift_invariant=False)

    def open(self, header: Header) -> Header:
        """Ask for the times of the triggers."""
        header.require(self.name, ChannelId(TIME))
        self.memory = {"last": None}
        return header.adding(ChannelId(TIME_STEP))

    def advance(self, block: Block) -> Block:
        """Difference the times; the first trigger has a step of zero."""
        times = block[ChannelId(TIME)]
        if times.size == 0:
            return block.setting({ChannelId(TIME_STEP): np.empty(0)})
        before = times[0] if self.memory["last"] is None else self.memory["last"]
        self.memory["last"] = float(times[-1])
        return block.setting({ChannelId(TIME_STEP): np.diff(times, prepend=before)})


Carry = tuple[dict[ChannelId, float], dict[ChannelId, int]]
"""The values and the flags of one sample of every channel; without an entry 0 is the flag."""


def _first(block: Block, distance: float) -> Carry:
    """Return the first sample of ``block``, at a ``distance``."""
    values = {c: float(x[0]) for c, x in block.values.items()}
    flags = {c: int(f[0]) for c, f in block.flags.items()}
    return {**values, ChannelId(DISTANCE): float(distance)}, flags


def _last(block: Block, wide: Mapping[ChannelId, FlagArray], distance: float) -> Carry:
    """Return the last sample of ``block``, whose flags are ``wide``, at a ``distance``."""
    values = {c: float(x[-1]) for c, x in block.values.items()}
    flags = {c: int(f[-1]) for c, f in wide.items()}
    return {**values, ChannelId(DISTANCE): float(distance)}, flags


def _flags_behind(block: Block, before: Mapping[ChannelId, int]) -> dict[ChannelId, FlagArray]:
    """Return the flags of ``block``, behind those of the sample ``before``, where there are any."""
    found = {}
    for channel in block.values:
        marks, mark = flags_of(block, channel), np.uint8(before.get(channel, 0))
        if marks is not None or mark:
            found[channel] = np.zeros(len(block) + 1, np.uint8)
            found[channel][0] = mark
            found[channel][1:] = 0 if marks is None else marks
    return found


def _farthest(before: float, distance: FloatArray) -> FloatArray:
    from floatref.kernels import motion

    found = np.empty(distance.size + 1)
    motion.go_farther(before, frozen(distance), found)
    return found


def _join(before: Block, after: Block) -> Block:
    blanks = np.zeros(len(before), np.uint8), np.zeros(len(after), np.uint8)
    flags = {
        c: np.concatenate((before.flags.get(c, blanks[0]), after.flags.get(c, blanks[1])))
        for c in {**before.flags, **after.flags}
    }
    values = {c: np.concatenate((x, after.values[c])) for c, x in before.values.items()}
    return Block(before.first, values, flags=flags)


def _part(block: Block, where: slice) -> Block:
    return Block(
        block.first + where.start,
        {c: x[where] for c, x in block.values.items()},
        flags={c: f[where] for c, f in block.flags.items() if f[where].any()},
    )


def _at(before: float, x: FloatArray, sample: IndexArray, part: FloatArray) -> FloatArray:
    from floatref.kernels import motion

    y = np.empty(sample.size)
    motion.read_at(before, frozen(x), sample, part, y)
    return y
