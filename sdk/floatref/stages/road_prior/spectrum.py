"""The spectrum of the road, from the run itself where speed allows."""

from dataclasses import dataclass

import numpy as np

from floatref.kernels.road_spectrum import LAST, LATELY, LONG, RING, SERIES, SHORT
from floatref.stages.road_prior.constants import RoadPrior
from floatref.values.arrays import FloatArray

SPACING_M = 1.0
LAGS = (2, 16)
"""Second differences are taken over so many metres: one tells white slope, the other long waves."""
LONGEST_S = 4.0
"""What takes longer is the accelerometer's drift as much as the road."""
APART_M = 0.005, 0.03
"""Nodes so far apart tell the texture, which is another one at each of them."""
SOONER = 15.0
"""Texture is forgotten after so much less travel than the spectrum."""
LEAST = 0.125
"""No road is taken for smoother than this share of what it was taken for at the start."""


@dataclass(eq=False)
class RoadSpectrum:
    """Intensities of white slope and of white spatial acceleration, (2.4).

    For a road of the spectrum 2 q / (2 pi nu)^2 + 2 g / (2 pi nu)^4 the square of the second
    difference over L is 2 q L + 2/3 g L^3 in the mean. Texture, which is G_e of (2.4) and another
    one at each node, adds six times its variance, whatever L: it is what is left for L = 0.

    Attributes:
        interval_s: between nodes.
        least: the smallest of both, q in m and g in 1/m.
        share: of a new square in the mean of all.
        memory, texture: of the kernels.
    """

    interval_s: float
    least: FloatArray
    share: float
    memory: FloatArray
    texture: FloatArray

    @classmethod
    def of(cls, constants: RoadPrior, interval_s: float) -> "RoadSpectrum":
        """Return one that takes the road for that of ``constants`` until it is driven on."""
        usual = np.array([constants.road, constants.long_waves])
        memory = np.zeros(RING + SERIES * (2 * LAGS[1] + 1))
        memory[[SHORT, LONG]] = _squares() @ usual
        texture = np.zeros(LATELY + LAST)
        texture[:2] = 6.0 * constants.reading_m**2
        return cls(interval_s, LEAST * usual, SPACING_M / constants.road_memory_m, memory, texture)

    def add(self, elevation_m: FloatArray, travel_m: FloatArray, changed: FloatArray) -> None:
        """Take filtered elevation at the next nodes, NaN where there is none, and the travel.

        Both have shape (nodes,); ``changed``, shape (2, nodes), is by how much the reading of a
        node has moved the height in m and turned the velocity in m/s.
        """
        from floatref.kernels import road_spectrum

        limits = self.interval_s, SPACING_M, LAGS, LONGEST_S, self.share
        moved, turned = changed
        road_spectrum.gather(elevation_m, travel_m, moved, turned, *limits, self.memory)
        per_m = SOONER * self.share / SPACING_M
        road_spectrum.texture(elevation_m, travel_m, *APART_M, per_m, self.texture)

    @property
    def bend_m(self) -> float:
        """RMS of the second difference over the longer distance, at least that of the start."""
        return float(np.sqrt(max(self.memory[LONG], _squares()[1] @ self.least / LEAST)))

    def reading_m2(self) -> float:
        """Return the variance of texture and noise in a reading of the height sensor, in m²."""
        once, twice = self.texture[:2]
        return float(max(0.0, 2.0 * once - twice) / 6.0)

    def road(self) -> FloatArray:
        """Return q in m and g in 1/m, shape (2,)."""
        found = np.linalg.solve(_squares(), self.memory[[SHORT, LONG]])
        # Where one would be negative, the other alone has to make up its own distance's square.
        if found[1] < self.least[1]:
            found[0] = (self.memory[SHORT] / _squares()[0])[0]
        road: FloatArray = np.maximum(found, self.least)
        return road


def _squares() -> FloatArray:
    """Return what q and g add to the mean square over either lag."""
    lag = SPACING_M * np.array(LAGS)
    return np.stack((2.0 * lag, 2.0 / 3.0 * lag**3), axis=1)
