"""What the smoother is unsure of: its 1-σ with what levelling leaves, against the road's bends."""

from collections.abc import Mapping, Sequence

import numpy as np

from floatref.stages.signals import LEVELLED, LEVELLING_SIGMA, REFERENCE_HEIGHT, SIGMA
from floatref.values.arrays import Flag, FlagArray, FloatArray
from floatref.values.block import Block
from floatref.values.channels import ChannelId

LEVELLING = ChannelId(LEVELLING_SIGMA)


def flag_uncertain(
    block: Block, bends_m: Mapping[str, float | FloatArray], most_share: float
) -> Block:
    """Return ``block`` with the heights flagged whose 1-σ is too large for the road.

    Too large is more than ``most_share`` of ``bends_m``, the height in m by which the road of a
    track bends, shape (n,).
    """
    flags: dict[ChannelId, FlagArray] = {}
    block = _add_levelling(block, tuple(bends_m))
    for track, bend_m in bends_m.items():
        height, sigma = ChannelId(REFERENCE_HEIGHT, track), ChannelId(SIGMA, track)
        doubtful = block[sigma] > most_share * bend_m
        if doubtful.any():
            own = doubtful * np.uint8(Flag.UNCERTAIN)
            flags[height] = flags[sigma] = own | block.flags.get(height, np.uint8(0))
    return block.setting({}, flags)


def _add_levelling(block: Block, tracks: Sequence[str]) -> Block:
    """Return ``block`` with what levelling leaves in its 1-σ, in quadrature."""
    if LEVELLING not in block.values:
        return block
    own = [ChannelId(SIGMA, track) for track in tracks if block[LEVELLING].any()]
    values = {sigma: np.hypot(block[sigma], block[LEVELLING]) for sigma in own}
    return block.setting(values, {}).without(LEVELLED, LEVELLING_SIGMA)
