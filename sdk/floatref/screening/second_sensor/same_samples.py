"""Two wheel paths with the samples of one sensor: one cable on two inputs, or a copied file."""

from collections.abc import Iterator
from itertools import combinations

import numpy as np

from floatref.screening.second_sensor.doubts import Doubt, names
from floatref.values.arrays import FloatArray
from floatref.values.channels import ChannelId
from floatref.values.recording import Channel, Recording
from floatref.values.scanning import chunks

SENSORS = ("vertical_specific_force", "height")
ALIKE = 0.99
"""Share of equal samples that two sensors never have: each has its own noise."""


def same_doubts(recording: Recording) -> Iterator[Doubt]:
    """Yield a fatal doubt for two wheel paths whose sensors gave the same samples.

    A sensor that both share has one channel; samples that never change are another fault.
    """
    for sensor in SENSORS:
        sided = [c for c in recording.channels if c.id.name == sensor]
        for one, other in combinations(sided, 2):
            if _are_same(one, other):
                yield _same((one.id, other.id))


def _same(both: tuple[ChannelId, ChannelId]) -> Doubt:
    return Doubt(
        both,
        f"channels {names(both)}: the same samples, so one sensor was recorded twice; connect the "
        "other, or leave its track out",
        True,
    )


def _are_same(one: Channel, other: Channel) -> bool:
    if one.values.size != other.values.size or one.clock.times(1)[0] != other.clock.times(1)[0]:
        return False
    equal, changed = 0, False
    for first, part in chunks(one.values):
        beside: FloatArray = other.values[first : first + part.size]
        equal += int(np.count_nonzero(part == beside))
        changed = changed or bool(np.any(np.diff(part) != 0))
        if equal < ALIKE * (first + part.size):
            return False
    return changed
