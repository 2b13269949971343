"""Flags of missing samples."""

from collections.abc import Collection

import numpy as np

from floatref.values.arrays import BoolArray, Flag, FlagArray
from floatref.values.block import Block
from floatref.values.channels import ChannelId


def flags_of(
    block: Block, *channels: ChannelId, complete: Collection[ChannelId] = ()
) -> FlagArray | None:
    """Return the flags of all ``channels`` together, NaN as `Flag.MISSING`, or None.

    Those that are known to be ``complete`` are not searched for NaN.
    """
    flags: FlagArray | None = None
    for channel in channels:
        missing = None if channel in complete else _missing(block, channel)
        for more in (block.flags.get(channel), missing):
            if more is not None:
                flags = more if flags is None else flags | more
    return flags


def long_gaps(block: Block, channel: ChannelId) -> BoolArray | None:
    """Return which samples of ``channel`` lie in a gap too long to be bridged, or None."""
    flags = block.flags.get(channel)
    lost = None if flags is None else (flags & np.uint8(Flag.DRIFT)) != 0
    return lost if lost is not None and lost.any() else None


def _missing(block: Block, channel: ChannelId) -> FlagArray | None:
    values = block[channel]
    # A sum is NaN if and only if a sample is; infinities never enter a recording.
    if not np.isnan(values.sum()):
        return None
    return np.where(np.isnan(values), np.uint8(Flag.MISSING), np.uint8(0))
