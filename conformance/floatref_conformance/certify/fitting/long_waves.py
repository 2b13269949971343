"""Waves of 4 to 25 m: what is left of the vehicle's own motion in them, and other filters.

The body answers the road around its bounce of 1 to 3 Hz, which are these waves at the speeds of
profilers. Height H of the accelerometer and its distance to the road are only the road z together:
a range that is late by τ leaves z(t-τ) + H(t) - H(t-τ). Beside the short waves, in which the body
is at rest, a wave of the frequency f is taken times $1 + T (e^{2πi f τ} - 1)$, T being the body's
answer: 10 ms change its height or its place by 20 to 40 % of itself in a van of the proving
ground, and by 10 to 14 % in the car of the IRI, whose dampers are hard. So does a laser ahead of
its accelerometer by the way of this time, and a range or an acceleration on another scale leaves a
part of T as well.

That is common to every pass, whatever its line, and coherent with the road: another line on the
road takes coherence and leaves gain and phase alone. A high-pass filter that runs one way shifts
waves by a phase that goes as their length; as in print many have one (2.1.5), it does not count.
"""

from dataclasses import dataclass

import numpy as np

from floatref_conformance.certify.fitting.symmetric import Bands, SymmetricGain


@dataclass(frozen=True)
class LongWaves:
    """The band of long waves that is farthest off, in percent, and 1-sigma.

    Attributes:
        error_percent, error_sigma: of height and place together, as a share of the wave.
        at_longest: whether that is the longest band, as it is of a high-pass.
        wave_m: length of the waves that are farthest off.
        gain_percent, gain_sigma: mean gain of all bands beyond the scale of heights.
    """

    error_percent: float
    error_sigma: float
    wave_m: float
    at_longest: bool
    gain_percent: float
    gain_sigma: float


def examine_long_waves(bands: Bands, gain: SymmetricGain) -> LongWaves:
    """Return by how much the waves of ``bands`` differ from ``gain`` in height and place.

    A wave that is moved by a part of its length is wrong by as much of its height.
    """
    height = bands.gain - gain.log_height
    design = 1.0 / bands.wave_number
    inverse = 1.0 / np.square(bands.phase_sigma)
    one_way = (inverse * design) @ bands.phase / ((inverse * design) @ design)
    place = bands.phase - one_way * design
    error = np.hypot(height, place)
    sigma = bands.phase_sigma
    worst = int(np.argmax(error - 2.0 * sigma))
    weights = 1.0 / np.square(bands.sigma)
    gain_sigma = np.hypot(gain.log_sigma, weights.sum() ** -0.5)
    return LongWaves(
        100.0 * float(error[worst]),
        100.0 * float(sigma[worst]),
        float(1.0 / bands.wave_number[worst]),
        worst == 0,
        100.0 * float(weights @ height / weights.sum()),
        100.0 * float(gain_sigma),
    )
