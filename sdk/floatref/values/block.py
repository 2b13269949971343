"""Blocks: stretches of all channels on one clock, as stages see them."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from enum import Enum
from fractions import Fraction
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from floatref.errors import InputError
from floatref.values.arrays import BoolArray, FlagArray, FloatArray
from floatref.values.channels import ChannelId
from floatref.values.recording import Setup

M = TypeVar("M", np.bool_, np.uint8)


class Axis(Enum):
    """What a block's index counts."""

    TIME = "time"
    """Samples of the accelerometer's clock; the step is in s."""
    DISTANCE = "distance"
    """Points of the profile or triggers of the encoder; the step is in m."""


@dataclass(frozen=True)
class Header:
    """What every block of a stream has in common.

    Index k lies at ``origin + k * step``, in s or m after `axis`. ``rate`` is the rational
    sampling rate of the time axis in Hz, also after a change to the distance axis.
    """

    axis: Axis
    step: float
    origin: float
    rate: Fraction
    channels: frozenset[ChannelId]
    tracks: tuple[str, ...]
    setup: Setup = field(default_factory=Setup)

    def adding(self, *channels: ChannelId) -> "Header":
        """Return the header with ``channels`` added."""
        return replace(self, channels=self.channels | set(channels))

    def without(self, *names: str) -> "Header":
        """Return the header without the channels called ``names``, of any track."""
        return replace(self, channels=frozenset(c for c in self.channels if c.name not in names))

    def replacing(self, name: str, by: str) -> "Header":
        """Return the header with channel ``by`` in place of ``name`` for every track."""
        return self.without(name).adding(*(ChannelId(by, track) for track in self.tracks))

    def on_distance(self, interval_m: float, origin_m: float) -> "Header":
        """Return the header on the distance axis."""
        return replace(self, axis=Axis.DISTANCE, step=interval_m, origin=origin_m)

    def require(self, stage: str, *channels: ChannelId) -> None:
        """Raise InputError unless all ``channels`` are present for ``stage`` to use."""
        missing = [str(c) for c in channels if c not in self.channels]
        if missing:
            raise InputError(
                f"stage {stage} needs channel {', '.join(missing)}; add a stage that makes it"
            )


@dataclass(frozen=True, eq=False)
class Event:
    """A sample that keeps its own time (GNSS): time in s and its values."""

    time_s: float
    values: Mapping[ChannelId, float]


@dataclass(frozen=True, eq=False)
class Block:
    """Samples ``first`` to ``first + length - 1`` of every channel.

    ``fresh`` is true where a channel's value is a new measurement (a held or interpolated one is
    not); a channel without a mask is fresh throughout. ``flags`` holds `Flag` bits; a channel
    without them is trusted throughout.
    """

    first: int
    values: Mapping[ChannelId, FloatArray]
    fresh: Mapping[ChannelId, BoolArray] = field(default_factory=dict)
    flags: Mapping[ChannelId, FlagArray] = field(default_factory=dict)
    events: tuple[Event, ...] = ()

    def __len__(self) -> int:
        """Return the number of samples."""
        # A loop: a generator takes five times as long, and every stage asks.
        for values in self.values.values():
            return int(values.size)
        return 0

    def __getitem__(self, channel: ChannelId) -> FloatArray:
        """Return the samples of ``channel``."""
        return self.values[channel]

    def setting(
        self,
        values: Mapping[ChannelId, FloatArray],
        flags: Mapping[ChannelId, FlagArray] | None = None,
    ) -> "Block":
        """Return a block with ``values`` (and ``flags``) added or replaced."""
        for array in values.values():
            array.flags.writeable = False
        return Block(
            self.first,
            {**self.values, **values},
            self.fresh,
            {**self.flags, **flags} if flags else self.flags,
            self.events,
        )

    def without(self, *names: str) -> "Block":
        """Return the block without the channels called ``names``, of any track."""
        return Block(
            self.first,
            {c: v for c, v in self.values.items() if c.name not in names},
            {c: v for c, v in self.fresh.items() if c.name not in names},
            {c: v for c, v in self.flags.items() if c.name not in names},
            self.events,
        )

    def part(self, begin: int, end: int) -> "Block":
        """Return samples ``begin`` to ``end - 1`` of this block, counted from its first.

        The events go with the part that holds the first sample.
        """
        where = slice(begin, end)
        return Block(
            self.first + begin,
            {c: x[where] for c, x in self.values.items()},
            {c: m[where] for c, m in self.fresh.items()},
            {c: f[where] for c, f in self.flags.items()},
            self.events if begin == 0 else (),
        )


def join_blocks(blocks: Sequence[Block]) -> Block:
    """Return one or more successive ``blocks`` as one block."""
    if len(blocks) == 1:
        return blocks[0]
    sizes = [len(block) for block in blocks]
    return Block(
        blocks[0].first,
        {c: np.concatenate([b.values[c] for b in blocks]) for c in blocks[0].values},
        _masks([b.fresh for b in blocks], sizes, True, np.bool_),
        _masks([b.flags for b in blocks], sizes, 0, np.uint8),
        tuple(event for block in blocks for event in block.events),
    )


def _masks(
    masks: Sequence[Mapping[ChannelId, NDArray[M]]], sizes: Sequence[int], usual: int, kind: type[M]
) -> dict[ChannelId, NDArray[M]]:
    """Join the masks of every channel that has one; a block without it has the ``usual`` value."""
    found = {}
    for channel in {c for mask in masks for c in mask}:
        parts = [
            mask[channel] if channel in mask else np.full(size, usual, kind)
            for mask, size in zip(masks, sizes, strict=True)
        ]
        found[channel] = np.concatenate(parts)
    return found
