"""A sensor that is much noisier than that of the other wheel path, sample by sample.

White noise shows in how far a sample is off the line between its neighbours. Road and body are
smooth over three samples of a sensor of 1 kHz and more; a texture is alike on both sides of a lane.
"""

from collections.abc import Iterator
from itertools import permutations

import numpy as np

from floatref.screening.second_sensor.doubts import Doubt
from floatref.values.arrays import FloatArray
from floatref.values.recording import Channel, Recording

SLOWEST_HZ = 1000.0
LEAST = {"vertical_specific_force": 0.3, "height": 5e-4}
"""Noise that matters, as 1-σ of a sample: ten times that of usual sensors (4.3, Table 6.1)."""
NOISIER = 8.0
"""How many times noisier than the other side a faulty sensor is: textures differ by less."""
MOST, LENGTH = 32, 2048
"""Number of stretches, evenly spread, that are looked at, and samples of each."""
TO_SIGMA = 1.4826 / 1.5**0.5
"""1-σ of white noise by the median distance from the mean of both neighbours."""


def noise_doubts(recording: Recording) -> Iterator[Doubt]:
    """Yield a doubt for a sensor that is much noisier than its twin on the other side."""
    for sensor, least in LEAST.items():
        sided = [c for c in recording.channels if c.id.name == sensor]
        if len(sided) != 2 or min(c.mean_rate_hz for c in sided) < SLOWEST_HZ:
            continue
        noise = {channel.id: noise_of(channel) for channel in sided}
        for one, other in permutations(sided):
            own, beside = noise[one.id], noise[other.id]
            if own > max(least, NOISIER * beside):
                yield Doubt(
                    (one.id,),
                    f"channel {one.id}: noise of {own:.3g} {one.unit} from sample to sample, "
                    f"{own / max(beside, 1e-12):.0f} times that of {other.id}; check cable and "
                    "supply; flagged",
                )


def noise_of(channel: Channel) -> float:
    """Return the 1-σ of white noise on the samples of ``channel``; repeated samples count once."""
    found: list[FloatArray] = []
    apart = max(LENGTH, channel.values.size // MOST)
    for first in range(0, channel.values.size, apart):
        part = channel.values[first : first + LENGTH]
        changed = part[np.append(True, np.diff(part) != 0)]
        changed = changed[np.isfinite(changed)]
        found.append(np.abs(changed[1:-1] - 0.5 * (changed[:-2] + changed[2:])))
    joined = np.concatenate(found)
    return TO_SIGMA * float(np.median(joined)) if joined.size else 0.0
