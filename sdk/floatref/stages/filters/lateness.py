"""The delay of a filter, taken off."""

from typing import ClassVar

from floatref.errors import InputError
from floatref.stages.marks import flags_of
from floatref.stages.protocol import Declared, Stage
from floatref.values.block import Axis, Block, Header, join_blocks
from floatref.values.channels import ChannelId

ALL = 1 << 62
"""A number of samples above that of any run."""


class Advance(Stage):
    """Gives ``channel`` of every track earlier by ``delay_s``, to the nearest sample.

    A converter that waits for the delayed output of its filter does the same. The last sample is
    repeated at the end, and missing ones are flagged.
    """

    declared: ClassVar[Declared] = Declared(shift_invariant=True, delay=ALL)

    def __init__(self, channel: str, delay_s: float) -> None:
        """Take ``channel`` from ``delay_s`` later on."""
        super().__init__()
        self.channel, self.delay_s = channel, delay_s
        self._samples = 0
        self._late: tuple[ChannelId, ...] = ()

    def open(self, header: Header) -> Header:
        """Ask for the channel of every track, in time."""
        if header.axis is not Axis.TIME:
            raise InputError(f"stage {self.name}: the stream is not on the time axis")
        self._late = tuple(ChannelId(self.channel, track) for track in header.tracks)
        header.require(self.name, *self._late)
        self._samples = round(self.delay_s / header.step)
        self.memory = {"waiting": None}
        return header

    def advance(self, block: Block) -> Block:
        """Return the samples whose channel is known."""
        waiting: Block | None = self.memory["waiting"]
        wide = block if waiting is None else join_blocks((waiting, block))
        ready = max(0, len(wide) - self._samples)
        self.memory["waiting"] = wide.part(ready, len(wide))
        return self._shift(wide, ready)

    def close(self) -> tuple[Block, ...]:
        """Return the samples held back, with the last value of the channel."""
        waiting: Block | None = self.memory["waiting"]
        if waiting is None or len(waiting) == 0:
            return ()
        last = waiting.part(len(waiting) - 1, len(waiting))
        wide = join_blocks((waiting, *[last] * self._samples))
        return (self._shift(wide, len(waiting)),)

    def _shift(self, wide: Block, ready: int) -> Block:
        begin, end = self._samples, self._samples + ready
        values, flags = {}, {}
        for channel in self._late:
            values[channel] = wide[channel][begin:end]
            marks = flags_of(wide, channel)
            if marks is not None:
                flags[channel] = marks[begin:end]
        out = wide.part(0, ready)
        return Block(
            out.first,
            {**out.values, **values},
            out.fresh,
            {**{c: f for c, f in out.flags.items() if c not in values}, **flags},
            out.events,
        )
