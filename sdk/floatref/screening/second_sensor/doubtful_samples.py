"""Samples that a second sensor shows to measure nothing: they count as missing."""

from collections.abc import Iterable

import numpy as np

from floatref.screening.damage.damaged_samples import Damage
from floatref.screening.damage.stuck_sensors import combine_damage
from floatref.screening.second_sensor.doubts import Doubt
from floatref.values.arrays import FloatArray, IndexArray
from floatref.values.clock import StampedClock
from floatref.values.recording import Channel

MOST = 0.9
"""Largest share of a channel that can be replaced: of the whole, nothing would be left."""


def replaced_by_doubt(channel: Channel, damage: Damage, doubts: Iterable[Doubt]) -> Damage:
    """Return ``damage`` of ``channel`` and the stretches that ``doubts`` replace.

    They disturb the samples after them as a gap does. The lines of doubts are the screening's.
    """
    spans = [
        span
        for doubt in doubts
        if doubt.replaced and doubt.suspects == (channel.id,)
        for span in doubt.spans
    ]
    if not spans:
        return damage
    stretches = _samples(channel, np.array(spans))
    if np.diff(stretches).sum() > MOST * channel.values.size:
        return damage
    return combine_damage(damage, Damage(stretches, stretches))


def _samples(channel: Channel, spans: FloatArray) -> IndexArray:
    """Return the first sample of each of ``spans``, in s, and the one behind, shape (k, 2)."""
    clock, last = channel.clock, channel.values.size
    if isinstance(clock, StampedClock):
        found = np.searchsorted(clock.times_s, spans)
    else:
        found = np.ceil((spans - clock.start_s) * float(clock.rate))
    return np.clip(found, 0, last).astype(np.int64)
