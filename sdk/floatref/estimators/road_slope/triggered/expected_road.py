"""The road that the fits of a run have found, for the smoother to expect."""

from dataclasses import dataclass, field
from typing import ClassVar, NamedTuple

import numpy as np

from floatref.estimators.road_slope.constants import Places, SlopeModel
from floatref.estimators.road_slope.gauss_newton import Fit
from floatref.estimators.road_slope.levelled import LOST_REACH_M, Levelled
from floatref.estimators.road_slope.readings import Drive
from floatref.values.arrays import FloatArray


class ExpectedRoad(NamedTuple):
    """A road in time, bin by bin, each of shape (n,).

    Attributes:
        elevation: in m, 0 in the first bin.
        acceleration: its second difference in time, in m/s², 0 in the first and last bin.
    """

    elevation: FloatArray
    acceleration: FloatArray

    @classmethod
    def of(cls, slope: FloatArray, distance: FloatArray, step: float) -> "ExpectedRoad":
        """Return the road that has the ``slope`` at the ``distance`` in m of bins ``step`` s apart.

        Twice the integral of its acceleration, on lines between bins, is its elevation.
        """
        rises = 0.5 * (slope[1:] + slope[:-1]) * np.diff(distance)
        elevation = np.concatenate((np.zeros(min(slope.size, 1)), np.cumsum(rises)))
        acceleration = np.zeros(slope.size)
        acceleration[1:-1] = np.diff(elevation, 2) / step**2
        return cls(elevation, acceleration)


@dataclass(eq=False)
class LevelledRoad(Levelled):
    """What was found of a run, with the road itself.

    Attributes:
        weight: sum of the weights of all fits that know the pitch, shape (n,).
        gains_weighted: of κ times each, in rad per m/s².
        slopes_weighted: of the road's slope under the laser, less its mean, times each.
    """

    weight: FloatArray = field(init=False)
    gains_weighted: FloatArray = field(init=False)
    slopes_weighted: FloatArray = field(init=False)
    unknown_reach_m: ClassVar[float] = LOST_REACH_M

    def __post_init__(self) -> None:
        """Know nothing."""
        self.weight, self.gains_weighted, self.slopes_weighted = np.zeros((3, self.share.size))

    @classmethod
    def over(
        cls, drive: Drive, places: Places, model: SlopeModel, wavelength_m: float
    ) -> "LevelledRoad":
        """Fit every stretch of ``drive``, see `Levelled.of`."""
        found = cls.of(drive, places, model, wavelength_m)
        assert isinstance(found, LevelledRoad)
        return found

    @property
    def gain(self) -> FloatArray:
        """κ in rad per m/s², where the pitch is known."""
        return self.gains_weighted / np.maximum(self.weight, np.finfo(np.float64).tiny)

    @property
    def slope(self) -> FloatArray:
        """That of the road under the laser, less its mean; comes and goes as ``share`` does."""
        return self.slopes_weighted / np.maximum(self.weight, 1.0)

    def _add(self, result: Fit, inside: slice, weight: FloatArray) -> None:
        super()._add(result, inside, weight)
        self.weight[inside] += weight
        self.gains_weighted[inside] += weight * result.of("gain")
        bins, seen = np.arange(inside.start, inside.stop), result.stretch.readings
        slope = slope_at(result, np.interp(bins, seen.bins, seen.place))
        self.slopes_weighted[inside] += weight * (slope - result.grade)


def slope_at(result: Fit, places: FloatArray) -> FloatArray:
    """Return the slope of the road of a fit at ``places`` in m, shape (n,)."""
    stretch = result.stretch
    slopes = result.unknowns[stretch.layout.slope]
    # Each is the slope from its point to the next.
    middles = stretch.first_m + stretch.model.spacing_m * (np.arange(slopes.size) + 0.5)
    return np.interp(places, middles, slopes)
