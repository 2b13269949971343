"""Which samples of a block the road-prior smoother trusts, and which are missing."""

import numpy as np

from floatref.stages.marks import long_gaps
from floatref.values.arrays import BoolArray, FloatArray, IndexArray
from floatref.values.block import Block
from floatref.values.channels import ChannelId


def trusted_samples(block: Block, channel: ChannelId, nodes: IndexArray) -> FloatArray:
    """Return the samples of ``channel`` at the nodes, shape (n,), NaN where they are flagged."""
    flags, values = block.flags.get(channel), block[channel][nodes]
    return values if flags is None else np.where(flags[nodes] == 0, values, np.nan)


def missing_samples(block: Block, channel: ChannelId) -> BoolArray | None:
    """Return which samples of ``channel`` are NaN or lie in a gap too long to be bridged."""
    gaps, values = long_gaps(block, channel), block[channel]
    if not np.isnan(values.sum()):
        return gaps
    return np.isnan(values) if gaps is None else gaps | np.isnan(values)
