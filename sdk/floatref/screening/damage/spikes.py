"""Single samples that leave their neighbours: a bad contact, a bit that flips, dust in a beam."""

import numpy as np

from floatref.screening.damage.damaged_samples import NONE, Damage, describe_damage
from floatref.values.arrays import FloatArray, IndexArray
from floatref.values.channels import STANDARD_GRAVITY
from floatref.values.needs import FORCE, HEIGHT
from floatref.values.recording import Channel
from floatref.values.scanning import take

SLOWEST_HZ = 1000.0
"""At this rate and above, an accelerometer's own bandwidth spreads a shock over several samples."""
LEAST = {
    HEIGHT: 0.05,
    **dict.fromkeys(
        (FORCE, "sprung_specific_force", "equipment_specific_force"), 0.5 * STANDARD_GRAVITY
    ),
}
"""Smallest spike of a height in m, deeper than a crack, and of an accelerometer on the body in
m/s². On a wheel carrier an impact may take a single sample."""
UNUSUAL = 15.0
"""A spike is this number of usual distances from the neighbours: white noise of a million samples
reaches 8."""
ALONE = 0.5
"""The neighbours of a spike differ by less than this share of it."""
MOST = 0.01
"""Share of all samples from which on they are noise, not spikes."""


def find_spikes(channel: Channel) -> Damage:
    """Return the single samples of ``channel`` that leave both neighbours and return at once."""
    least = LEAST.get(channel.id.name)
    if least is None or channel.mean_rate_hz < SLOWEST_HZ or channel.values.size < 3:
        return Damage()
    values = channel.values
    # On most channels no step is as large as a spike, and none is read again.
    steep = channel.scan.leap > least
    if not steep.any():
        return Damage()
    least = max(least, UNUSUAL * _usual(values))
    parts = channel.scan.parts(values, steep, overlap=2)
    at = np.concatenate([first + 1 + _spikes(part, least) for first, part in parts])
    if not 0 < at.size <= MOST * values.size:
        return Damage()
    spans: IndexArray = np.stack([at, at + 1], axis=1)
    line = describe_damage(channel, spans, "leaves its neighbours and returns at once")
    return Damage(spans, NONE, warnings=(line,))


def _usual(values: FloatArray) -> float:
    """Return the median distance of a sample from the mean of its neighbours, repeats left out."""
    stride = max(1, values.size >> 16)
    index = np.arange(1, values.size - 1, stride)
    before, here, after = (take(values, index + k) for k in (-1, 0, 1))
    off = np.abs(here - 0.5 * (before + after))
    off = off[np.isfinite(off) & (off > 0)]
    return float(np.median(off)) if off.size else 0.0


def _spikes(part: FloatArray, least: float) -> IndexArray:
    before, here, after = part[:-2], part[1:-1], part[2:]
    off = np.minimum(np.abs(here - before), np.abs(here - after))
    same_side = (here - before) * (here - after) > 0
    alone = np.abs(after - before) < ALONE * off
    return np.flatnonzero((off > least) & same_side & alone)
