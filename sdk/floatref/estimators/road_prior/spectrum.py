"""The spectrum of the road, from the run itself where speed allows."""

from dataclasses import dataclass, field
from functools import cache, partial

import numpy as np

from floatref.estimators.road_prior.constants import RoadPrior
from floatref.kernels.compiling import compiled
from floatref.values.arrays import FloatArray, Records, new_record, new_records, read_only

SHORT, LONG = range(2)
"""Of the mean squares: over the shorter and over the longer distance."""
SINCE = np.dtype(
    [(name, np.float64) for name in ("travel_m", "time_s", "moved_m", "turned", "points")],
)
"""Since the latest point: travel and time; by how much readings have moved the height, and turned
the velocity in m/s, since the start; and how many points there are behind one another."""
POINT = np.dtype([(name, np.float64) for name in ("elevation_m", "after_s", "turned")], align=True)
"""Elevation without what readings have moved, time since the point before, and velocity turned."""
STEADY = 0.02
"""Both halves of the longer distance take the same time but for this share: in a brake the tilt
that is not known yet looks like road."""


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
    since: np.record,
    points: Records,
    squares: FloatArray,
) -> None:
    """Take ``elevation`` in m at nodes ``travel`` in m behind one another, NaN where unknown.

    A reading there has ``moved`` the height in m and ``turned`` the velocity in m/s; the road has
    not, so that this is taken off. ``points``, the latest first, are ``spacing`` in m apart. Both
    mean ``squares``, over ``lags`` of points, go to each new square by ``share`` if no more than
    ``most_s`` in s lie between its ends.
    """
    gone, ago, height, velocity = since.travel_m, since.time_s, since.moved_m, since.turned
    count = since.points
    for k in range(elevation.size):
        gone += travel[k]
        ago += interval_s
        height += interval_s * velocity + moved[k]
        velocity += turned[k]
        if gone < spacing or elevation[k] != elevation[k]:
            continue
        if gone >= 2.0 * spacing:
            count = 0.0
        for j in range(points.size - 1, 0, -1):
            points[j] = points[j - 1]
        newest = points[0]
        newest.elevation_m, newest.after_s, newest.turned = elevation[k] - height, ago, velocity
        count = min(count + 1.0, float(points.size))
        gone, ago = gone % spacing, 0.0
        for which in range(2):
            if count > 2 * lags[which]:
                _square(which, lags[which], most_s, share, points, squares)
    since.travel_m, since.time_s, since.moved_m, since.turned = gone, ago, height, velocity
    since.points = count


@compiled
def texture(
    elevation: FloatArray,
    travel: FloatArray,
    least_m: float,
    most_m: float,
    per_m: float,
    latest: FloatArray,
    squares: FloatArray,
) -> None:
    """Take second differences over one and over two nodes, where these are some way apart.

    Both mean ``squares`` go to each new one by ``per_m`` of the travel; nodes count that are
    ``least_m`` to ``most_m`` apart, in m, all five ``latest`` elevations in a row.
    """
    for k in range(elevation.size):
        for j in range(latest.size - 1, 0, -1):
            latest[j] = latest[j - 1]
        latest[0] = elevation[k] if least_m <= travel[k] <= most_m else float("nan")
        total = 0.0
        for j in range(latest.size):
            total += latest[j]
        if total != total:
            continue
        share = min(per_m * travel[k], 1.0)
        for which in range(2):
            lag = which + 1
            bend = latest[0] - 2.0 * latest[lag] + latest[2 * lag]
            mean = squares[which]
            squares[which] += share * (min(bend * bend, 9.0 * mean) - mean)


@compiled
def _square(
    which: int, lag: int, most_s: float, share: float, points: Records, squares: FloatArray
) -> None:
    """Take the second difference over ``lag`` points; one far out counts as three deviations."""
    later = earlier = 0.0
    for j in range(lag):
        later += points[j].after_s
        earlier += points[lag + j].after_s
    lasted, uneven = later + earlier, later - earlier
    if lasted > most_s or (which == LONG and abs(uneven) > STEADY * lasted):
        return
    first = points[2 * lag]
    bend = points[0].elevation_m - 2.0 * points[lag].elevation_m + first.elevation_m
    # What had been turned before the first of the three is no error of theirs.
    bend += uneven * first.turned
    squares[which] += share * (min(bend * bend, 9.0 * squares[which]) - squares[which])


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
        squares: mean squares over both lags, in m².
        texture: mean squares over one and over two nodes, in m².
        since, points, latest: of the kernels.
    """

    interval_s: float
    least: FloatArray
    share: float
    squares: FloatArray
    texture: FloatArray
    since: np.record = field(default_factory=partial(new_record, SINCE))
    points: Records = field(default_factory=partial(new_records, 2 * LAGS[LONG] + 1, POINT))
    latest: FloatArray = field(default_factory=partial(np.full, 5, np.nan))

    @classmethod
    def of(cls, constants: RoadPrior, interval_s: float) -> "RoadSpectrum":
        """Return one that takes the road for that of ``constants`` until it is driven on."""
        usual = np.array([constants.road, constants.long_waves])
        squares, texture = _squares() @ usual, np.full(2, 6.0 * constants.reading_m**2)
        share = SPACING_M / constants.road_memory_m
        return cls(interval_s, LEAST * usual, share, squares, texture)

    def add(self, elevation_m: FloatArray, travel_m: FloatArray, changed: FloatArray) -> None:
        """Take filtered elevation at the next nodes, NaN where it is missing, and the travel.

        Both have shape (nodes,); ``changed``, shape (2, nodes), is by how much the reading of a
        node has moved the height in m and turned the velocity in m/s.
        """
        limits = self.interval_s, SPACING_M, LAGS, LONGEST_S, self.share
        moved, turned = changed
        memory = self.since, self.points, self.squares
        gather(elevation_m, travel_m, moved, turned, *limits, *memory)
        per_m = SOONER * self.share / SPACING_M
        texture(elevation_m, travel_m, *APART_M, per_m, self.latest, self.texture)

    @property
    def bend_m(self) -> float:
        """RMS of the second difference over the longer distance, at least that of the start."""
        return float(np.sqrt(max(self.squares[LONG], _squares()[1] @ self.least / LEAST)))

    def reading_m2(self) -> float:
        """Return the variance of texture and noise in a reading of the height sensor, in m²."""
        once, twice = self.texture
        return float(max(0.0, 2.0 * once - twice) / 6.0)

    def road(self) -> FloatArray:
        """Return q in m and g in 1/m, shape (2,)."""
        found = np.linalg.solve(_squares(), self.squares)
        # Where one would be negative, the other alone has to make up its own distance's square.
        if found[1] < self.least[1]:
            found[0] = self.squares[SHORT] / _squares()[SHORT, 0]
        road: FloatArray = np.maximum(found, self.least)
        return road


@cache
def _squares() -> FloatArray:
    """Return what q and g add to the mean square over either lag, read-only."""
    lag = SPACING_M * np.array(LAGS)
    found = np.stack((2.0 * lag, 2.0 / 3.0 * lag**3), axis=1)
    return read_only(found)
