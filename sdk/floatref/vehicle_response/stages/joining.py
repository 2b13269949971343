"""The estimates under several tyres of one wheel path, joined."""

from collections.abc import Mapping, Sequence
from typing import ClassVar

import numpy as np

from floatref.stages.marks import flags_of
from floatref.stages.protocol import Declared, Stage
from floatref.stages.signals import ELEVATION, SIGMA
from floatref.values.arrays import FlagArray, FloatArray
from floatref.values.block import Block, Header
from floatref.values.channels import ChannelId

ELEVATION_UNDER, SIGMA_UNDER = "elevation_under_tyre", "sigma_under_tyre"


def elevation_under(number: int) -> str:
    """Return the channel of the road under tyre ``number`` of the model, in m."""
    return f"{ELEVATION_UNDER}_{number}"


def sigma_under(number: int) -> str:
    """Return the channel of its 1-σ, in m."""
    return f"{SIGMA_UNDER}_{number}"


Found = tuple[FloatArray, FloatArray, FlagArray]


class JoinTyres(Stage):
    """Adds `elevation` and `elevation_sigma` from the estimates under each tyre of a wheel path.

    Each counts by its variance, as front and rear of (8) of Zhu do once both lie at one place; one
    that is NaN, or whose 1-σ is, does not count. Sensors' noise is each tyre's own, but the
    parameters are common: the joint 1-σ is that of the better one. Flags are those of all, and
    the estimates under the tyres are dropped.
    """

    declared: ClassVar[Declared] = Declared(linear=False, zero_in_zero_out=False)

    def __init__(self, tyres: Mapping[str, Sequence[int]]) -> None:
        """Join the ``tyres``, by number, of every wheel path."""
        super().__init__()
        self.tyres = {track: tuple(numbers) for track, numbers in tyres.items()}

    def open(self, header: Header) -> Header:
        """Ask for the estimates under every tyre."""
        made = {name for name, _ in self._names()}
        for track, numbers in self.tyres.items():
            needed = [n for k in numbers for n in (elevation_under(k), sigma_under(k))]
            header.require(self.name, *(ChannelId(name, track) for name in needed))
        joint = [ChannelId(n, track) for n in (ELEVATION, SIGMA) for track in self.tyres]
        return header.without(*made).adding(*joint)

    def advance(self, block: Block) -> Block:
        """Join the estimates of every wheel path."""
        values, flags = {}, {}
        for track, numbers in self.tyres.items():
            elevation, sigma, marks = _join([_find(block, track, k) for k in numbers])
            target = ChannelId(ELEVATION, track)
            values[target], values[ChannelId(SIGMA, track)] = elevation, sigma
            if marks.any():
                flags[target] = flags[ChannelId(SIGMA, track)] = marks
        return block.without(*{name for name, _ in self._names()}).setting(values, flags)

    def _names(self) -> list[tuple[str, int]]:
        numbers = sorted({k for some in self.tyres.values() for k in some})
        return [(name(k), k) for k in numbers for name in (elevation_under, sigma_under)]


def _find(block: Block, track: str, number: int) -> Found:
    elevation = ChannelId(elevation_under(number), track)
    sigma = ChannelId(sigma_under(number), track)
    marks = flags_of(block, elevation, sigma)
    blank = np.zeros(len(block), np.uint8)
    return block[elevation], block[sigma], blank if marks is None else marks


def _join(found: Sequence[Found]) -> Found:
    """Return the mean by variance, the least 1-σ, and the flags of all."""
    elevations = np.stack([elevation for elevation, _, _ in found])
    sigmas = np.stack([sigma for _, sigma, _ in found])
    marks = np.stack([flags for _, _, flags in found])
    there = ~np.isnan(elevations + sigmas)
    weights = np.where(there, 1.0 / np.fmax(np.where(there, sigmas, 1.0), 1e-12) ** 2, 0.0)
    total = weights.sum(axis=0)
    known = total > 0.0
    summed = (weights * np.where(there, elevations, 0.0)).sum(axis=0)
    elevation = np.where(known, summed / np.where(known, total, 1.0), np.nan)
    sigma = np.where(known, np.where(there, sigmas, np.inf).min(axis=0), np.nan)
    return elevation, sigma, np.bitwise_or.reduce(marks, axis=0)
