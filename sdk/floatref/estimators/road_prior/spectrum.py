"""The spectrum of the road, from the run itself where speed allows."""

from dataclasses import dataclass

import numpy as np

from floatref.estimators.road_prior.constants import RoadPrior
from floatref.kernels.compiling import compiled
from floatref.values.arrays import FloatArray

SHORT, LONG, GONE, AGO, COUNT, MOVED, TURNED, RING = range(8)
"""Of the memory: both mean squares in m², travel in m and time in s since the latest point, how
many points there are behind one another, by how much readings have moved the height in m and turned
the velocity in m/s, and the points from the latest: elevation in m without what readings have
moved, seconds since the one before, and the velocity turned."""
SERIES = 3
STEADY = 0.02
"""Both halves of the longer distance take the same time but for this share: in a brake the tilt
that is not known yet looks like road."""

RUN, LATELY, LAST = 2, 3, 5
"""Of the memory of `texture`: both mean squares in m², how many nodes in a row count, and the
elevation in m at the latest ones."""


@compiled
def gather(
    elevation: FloatArray,
    travel: FloatArray,
    moved: FloatArray,
    turned: FloatArray,
    interval_s: float,
    spacing: float,
    lags: tuple[int, int],
    most_s: float,
    share: float,
    memory: FloatArray,
) -> None:
    """Take ``elevation`` in m at nodes ``travel`` in m behind one another, NaN where unknown.

    A reading there has ``moved`` the height in m and ``turned`` the velocity in m/s; the road has
    not, so that this is taken off. Points are ``spacing`` in m apart. Both mean squares, over
    ``lags`` of points, go to each new square by ``share`` if no more than ``most_s`` in s lie
    between its ends.
    """
    kept = 2 * lags[1] + 1
    for k in range(elevation.size):
        memory[GONE] += travel[k]
        memory[AGO] += interval_s
        memory[MOVED] += interval_s * memory[TURNED] + moved[k]
        memory[TURNED] += turned[k]
        if memory[GONE] < spacing or elevation[k] != elevation[k]:
            continue
        if memory[GONE] >= 2.0 * spacing:
            memory[COUNT] = 0.0
        for j in range(kept - 1, 0, -1):
            for series in range(SERIES):
                at = RING + series * kept + j
                memory[at] = memory[at - 1]
        memory[RING], memory[RING + kept] = elevation[k] - memory[MOVED], memory[AGO]
        memory[RING + 2 * kept] = memory[TURNED]
        memory[COUNT] = min(memory[COUNT] + 1.0, float(kept))
        memory[GONE] %= spacing
        memory[AGO] = 0.0
        for which in range(2):
            _square(which, lags[which], kept, most_s, share, memory)


@compiled
def texture(
    elevation: FloatArray,
    travel: FloatArray,
    least_m: float,
    most_m: float,
    per_m: float,
    memory: FloatArray,
) -> None:
    """Take second differences over one and over two nodes, where these are some way apart.

    Both mean squares go to each new one by ``per_m`` of the travel; nodes count that are
    ``least_m`` to ``most_m`` apart, in m, five in a row.
    """
    for k in range(elevation.size):
        for j in range(LAST - 1, 0, -1):
            memory[LATELY + j] = memory[LATELY + j - 1]
        memory[LATELY] = elevation[k]
        good = elevation[k] == elevation[k] and least_m <= travel[k] <= most_m
        memory[RUN] = memory[RUN] + 1.0 if good else 0.0
        if memory[RUN] < LAST:
            continue
        share = min(per_m * travel[k], 1.0)
        for which in range(2):
            lag = which + 1
            bend = memory[LATELY] - 2.0 * memory[LATELY + lag] + memory[LATELY + 2 * lag]
            mean = memory[which]
            memory[which] += share * (min(bend * bend, 9.0 * mean) - mean)


@compiled
def _square(
    which: int, lag: int, kept: int, most_s: float, share: float, memory: FloatArray
) -> None:
    """Take the second difference over ``lag`` points; one far out counts as three deviations."""
    if memory[COUNT] < 2 * lag + 1:
        return
    later = earlier = 0.0
    for j in range(lag):
        later += memory[RING + kept + j]
        earlier += memory[RING + kept + lag + j]
    lasted, uneven = later + earlier, later - earlier
    if lasted > most_s or (which == LONG and abs(uneven) > STEADY * lasted):
        return
    bend = memory[RING] - 2.0 * memory[RING + lag] + memory[RING + 2 * lag]
    # What had been turned before the first of the three is no error of theirs.
    bend += uneven * memory[RING + 2 * kept + 2 * lag]
    memory[which] += share * (min(bend * bend, 9.0 * memory[which]) - memory[which])


SPACING_M = 1.0
LAGS = (2, 16)
"""Metres of second differences: the short ones show white slope, the long ones long waves."""
LONGEST_S = 4.0
"""What takes longer is the accelerometer's drift as much as the road."""
APART_M = 0.005, 0.03
"""Nodes this far apart show the texture, which differs at each of them."""
SOONER = 15.0
"""Times by which the travel of texture's memory is shorter than that of the spectrum."""
LEAST = 0.125
"""No road is taken for smoother than this share of what it was taken for at the start."""


@dataclass(eq=False)
class RoadSpectrum:
    """Intensities of white slope and of white spatial acceleration, (2.4).

    For a road of the spectrum 2 q / (2 pi nu)^2 + 2 g / (2 pi nu)^4 the square of the second
    difference over L is 2 q L + 2/3 g L^3 in the mean. Texture, which is G_e of (2.4) and another
    one at each node, adds six times its variance, for any L: it is what remains for L = 0.

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
        """Take filtered elevation at the next nodes, NaN where it is missing, and the travel.

        Both have shape (nodes,); ``changed``, shape (2, nodes), is by how much the reading of a
        node has moved the height in m and turned the velocity in m/s.
        """
        limits = self.interval_s, SPACING_M, LAGS, LONGEST_S, self.share
        moved, turned = changed
        gather(elevation_m, travel_m, moved, turned, *limits, self.memory)
        per_m = SOONER * self.share / SPACING_M
        texture(elevation_m, travel_m, *APART_M, per_m, self.texture)

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
