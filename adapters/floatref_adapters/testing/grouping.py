"""The channels of a recording by their clocks, as formats hold them that have groups."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction

import numpy as np
from numpy.typing import NDArray

from floatref import Channel, Recording, UniformClock
from floatref_adapters.shared.clock_groups import group_by_clock
from floatref_adapters.shared.simplest_ratio import find_simplest


@dataclass(frozen=True, eq=False)
class ClockGroup:
    """Channels of one clock and one length, called `group 0` and on.

    ``step_s`` and ``start_s`` are of a uniform clock whose rate is found again from the step as
    a float64; ``times_s`` are the times of any other, in s.
    """

    name: str
    channels: tuple[Channel, ...]
    step_s: float = 0.0
    start_s: float = 0.0
    times_s: NDArray[np.float64] | None = None

    @property
    def count(self) -> int:
        """Samples of each channel."""
        return int(self.channels[0].values.size)


def by_clock(recording: Recording) -> list[ClockGroup]:
    """Return the channels of ``recording`` in the order of their clocks."""
    groups = enumerate(group_by_clock(recording))
    return [_group(f"group {k}", channels) for k, channels in groups]


def _group(name: str, channels: Sequence[Channel]) -> ClockGroup:
    clock = channels[0].clock
    if isinstance(clock, UniformClock):
        step_s = float(1 / clock.rate)
        if 1 / find_simplest(step_s) == Fraction(clock.rate):
            return ClockGroup(name, tuple(channels), step_s, clock.start_s)
    return ClockGroup(name, tuple(channels), times_s=channels[0].times_s)


def count_quanta(
    channel: Channel, quanta: Mapping[str, float] | None
) -> tuple[float, NDArray[np.int64]] | None:
    """Return the quantum of ``channel`` and its values in quanta, 0 where missing.

    None if ``quanta``, by the names of channels, does not have it.
    """
    quantum = (quanta or {}).get(channel.id.name)
    if quantum is None:
        return None
    filled = np.where(np.isnan(channel.values), 0.0, channel.values)
    return quantum, np.rint(filled / quantum).astype(np.int64)
