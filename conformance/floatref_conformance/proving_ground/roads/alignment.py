"""The vertical alignment of a road: crowns, humps, dips, gutters and changes of grade.

Where vehicles stop, roads cross: the lane climbs over the crown of the other road, through its
gutters, and its grade changes. Sizes that streets have: crowns of 25 to 100 mm over 10 to 20 m,
humps of 75 to 150 mm over 4 to 10 m, gutters and dips likewise downward, grades that change by
1 to 6 % within 20 to 60 m.

Distances are horizontal, here and in the whole proving ground: over a hump of 150 mm on 4 m the
way along the surface is 14 mm longer than its base, which is left out.
"""

from dataclasses import dataclass
from typing import Protocol

import numpy as np

from floatref.errors import InputError
from floatref.values.arrays import BoolArray, FloatArray


class Feature(Protocol):
    """A piece of the alignment; all arrays have the shape of the distances ``x`` in m."""

    def height(self, x: FloatArray) -> FloatArray:
        """Return the elevation in m."""

    def grade(self, x: FloatArray) -> FloatArray:
        """Return the slope of the elevation, uphill positive."""

    def curvature(self, x: FloatArray) -> FloatArray:
        """Return the second derivative of the elevation in 1/m, a sag positive."""


@dataclass(frozen=True)
class Crown:
    """A raised cosine; a negative height makes it a dip or a gutter.

    Attributes:
        centre_m: true distance of its middle, in m.
        length_m: from its first to its last point, in m.
        height_m: of its middle, in m.
    """

    centre_m: float
    length_m: float
    height_m: float

    def __post_init__(self) -> None:
        """Refuse a length that is not above zero."""
        check_length("crown", self.length_m)

    def height(self, x: FloatArray) -> FloatArray:
        """Return h/2·(1 + cos(2πs/L)) at s from the middle, 0 outside."""
        turn, inside = self._turn(x)
        return np.where(inside, self.height_m / 2 * (1 + np.cos(turn)), 0.0)

    def grade(self, x: FloatArray) -> FloatArray:
        """Return its first derivative."""
        turn, inside = self._turn(x)
        return np.where(inside, -np.pi * self.height_m / self.length_m * np.sin(turn), 0.0)

    def curvature(self, x: FloatArray) -> FloatArray:
        """Return its second derivative; its size in the middle is 2π²·h/L²."""
        turn, inside = self._turn(x)
        most = 2 * np.pi**2 * self.height_m / self.length_m**2
        return np.where(inside, -most * np.cos(turn), 0.0)

    def _turn(self, x: FloatArray) -> tuple[FloatArray, BoolArray]:
        away = np.asarray(x, dtype=np.float64) - self.centre_m
        return 2 * np.pi * away / self.length_m, np.abs(away) < self.length_m / 2


@dataclass(frozen=True)
class GradeBreak:
    """A change of grade along a parabola, as vertical curves are built; level before it.

    Attributes:
        centre_m: true distance of the parabola's middle, in m.
        length_m: of the parabola, in m.
        change: grade behind it less grade before it; 0.02 is 2 %.
    """

    centre_m: float
    length_m: float
    change: float

    def __post_init__(self) -> None:
        """Refuse a length that is not above zero."""
        check_length("grade break", self.length_m)

    def height(self, x: FloatArray) -> FloatArray:
        """Return the integral of `grade` from far before."""
        within = self._within(x)
        beyond = np.maximum(np.asarray(x) - self.centre_m - self.length_m / 2, 0.0)
        return np.asarray(self.change * (within**2 / (2 * self.length_m) + beyond))

    def grade(self, x: FloatArray) -> FloatArray:
        """Return the grade, linear within the parabola."""
        return np.asarray(self.change * self._within(x) / self.length_m)

    def curvature(self, x: FloatArray) -> FloatArray:
        """Return change / length within the parabola."""
        within = self._within(x)
        inside = (within > 0) & (within < self.length_m)
        return np.where(inside, self.change / self.length_m, 0.0)

    def _within(self, x: FloatArray) -> FloatArray:
        """Return how far into the parabola ``x`` is, from 0 to its length."""
        return np.clip(np.asarray(x) - self.centre_m + self.length_m / 2, 0.0, self.length_m)


@dataclass(frozen=True)
class Alignment:
    """The sum of its features."""

    features: tuple[Feature, ...] = ()

    def height(self, x: FloatArray) -> FloatArray:
        """Return the elevation in m at true distances ``x`` in m, in the shape of ``x``."""
        return sum((f.height(x) for f in self.features), np.zeros(np.shape(x)))

    def grade(self, x: FloatArray) -> FloatArray:
        """Return the slope at ``x``, uphill positive."""
        return sum((f.grade(x) for f in self.features), np.zeros(np.shape(x)))

    def curvature(self, x: FloatArray) -> FloatArray:
        """Return the second derivative of the elevation at ``x``, in 1/m."""
        return sum((f.curvature(x) for f in self.features), np.zeros(np.shape(x)))


LEVEL = Alignment()


def check_length(what: str, length_m: float) -> None:
    """Raise InputError unless ``length_m`` is a number above zero."""
    if not (np.isfinite(length_m) and length_m > 0):
        raise InputError(f"{what}: its length is {length_m} m; it must be above zero")
