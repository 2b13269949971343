"""A road: elevation of its wheel paths on a uniform grid of true distance.

The grid starts behind distance 0 and ends beyond the road's length, so that every wheel and
every laser of a vehicle stands on it. A made road is level (elevation 0) up to
`LEVEL_UNTIL_M`, where a vehicle can start in equilibrium, and undisturbed from `FULL_FROM_M`.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from types import MappingProxyType

import numpy as np

from floatref.errors import InputError
from floatref.values.arrays import FloatArray, frozen
from floatref_conformance.proving_ground.roads.alignment import LEVEL, Alignment

START_M = -20.0
"""Where the grid of a made road starts, in m."""
RUN_OUT_M = 20.0
"""How far the grid of a made road goes on beyond its length, in m."""
LEVEL_UNTIL_M = 6.0
"""A made road is level up to here, in m: a vehicle's length ahead of its sensors."""
FULL_FROM_M = 26.0
"""A made road carries its whole roughness from here on, in m."""
SPACING_M = 0.005
TRACKS: Mapping[str, float] = MappingProxyType({"left": 0.86, "right": -0.86})
"""Lateral positions in m (left positive) of the two wheel paths of a vehicle 1.72 m wide."""


@dataclass(frozen=True, eq=False)
class Road:
    """Elevation in m of each wheel path at ``start_m + k * spacing_m``.

    Attributes:
        start_m: true distance of the first point, in m.
        spacing_m: distance between points, in m.
        elevation: one array of shape (n,) in m per wheel path, up positive.
        lateral_m: lateral position in m of each wheel path, left positive.
        alignment: the part of the elevation that all wheel paths share as their alignment: a
            vehicle leans on its grade as on that of a `Course`.
    """

    start_m: float
    spacing_m: float
    elevation: Mapping[str, FloatArray]
    lateral_m: Mapping[str, float]
    alignment: Alignment = LEVEL

    def __post_init__(self) -> None:
        """Refuse a grid, elevations or lateral positions that do not fit together."""
        if not (np.isfinite(self.spacing_m) and self.spacing_m > 0):
            raise InputError(f"spacing_m is {self.spacing_m}; it must be above zero")
        if not self.elevation or set(self.elevation) != set(self.lateral_m):
            raise InputError("the road needs an elevation and a lateral position per wheel path")
        if len({z.size for z in self.elevation.values()}) > 1:
            raise InputError("the road's wheel paths differ in length")
        if len(set(self.lateral_m.values())) < len(self.lateral_m):
            raise InputError("two wheel paths of the road have the same lateral position")
        for name, z in self.elevation.items():
            if z.size < 2 or not np.isfinite(z).all():
                raise InputError(f"wheel path {name}: needs two or more points, all of them finite")
        fixed = MappingProxyType({name: frozen(z) for name, z in self.elevation.items()})
        object.__setattr__(self, "elevation", fixed)
        object.__setattr__(self, "lateral_m", MappingProxyType(dict(self.lateral_m)))

    @property
    def points(self) -> int:
        """Number of points of each wheel path."""
        return next(iter(self.elevation.values())).size

    @property
    def end_m(self) -> float:
        """True distance of the last point, in m."""
        return self.start_m + self.spacing_m * (self.points - 1)

    @property
    def distance_m(self) -> FloatArray:
        """True distance of every point, shape (n,), in m."""
        return self.start_m + self.spacing_m * np.arange(self.points, dtype=np.float64)

    @property
    def tracks(self) -> tuple[str, ...]:
        """Names of the wheel paths, from left to right."""
        return tuple(sorted(self.lateral_m, key=lambda name: -self.lateral_m[name]))

    def at(self, track: str, x: FloatArray) -> FloatArray:
        """Return the elevation in m of a wheel path at the true distances ``x`` in m.

        Linear between points, constant beyond both ends; the result has the shape of ``x``.
        InputError if there is no such wheel path.
        """
        if track not in self.elevation:
            raise InputError(f"wheel path {track}: missing; the road has {', '.join(self.tracks)}")
        z = self.elevation[track]
        position = np.clip((np.asarray(x) - self.start_m) / self.spacing_m, 0.0, z.size - 1.0)
        index = np.minimum(position.astype(np.intp), z.size - 2)
        below = z[index]
        return np.asarray(below + (position - index) * (z[index + 1] - below))

    def across(self, x: FloatArray, y: FloatArray) -> FloatArray:
        """Return the elevation in m at distances ``x`` and lateral positions ``y``, both in m.

        Linear in ``y`` between neighbouring wheel paths; the outermost pair's cross slope goes
        on beyond them. A road of one wheel path has no cross slope.
        """
        names = self.tracks[::-1]
        if len(names) == 1:
            return self.at(names[0], x)
        sides = np.array([self.lateral_m[name] for name in names])
        pair = np.clip(np.searchsorted(sides, y, side="right") - 1, 0, sides.size - 2)
        weight = (y - sides[pair]) / (sides[pair + 1] - sides[pair])
        rows = np.stack([self.at(name, x) for name in names])
        column = np.arange(pair.size).reshape(pair.shape)
        flat = rows.reshape(len(names), -1)
        right, left = flat[pair, column], flat[pair + 1, column]
        return np.asarray(right + weight * (left - right))

    def with_elevation(self, elevation: Mapping[str, FloatArray]) -> "Road":
        """Return the same grid and wheel paths with other elevations."""
        return replace(self, elevation=elevation)


def points_of(length_m: float, spacing_m: float = SPACING_M, start_m: float = START_M) -> int:
    """Return the number of grid points of a made road that is usable up to ``length_m``."""
    if not (np.isfinite(length_m) and length_m > 0):
        raise InputError(f"length_m is {length_m}; it must be above zero")
    if not (np.isfinite(spacing_m) and 0 < spacing_m <= length_m):
        raise InputError(f"spacing_m is {spacing_m}; it must be above zero and below the length")
    return int(np.ceil((length_m + RUN_OUT_M - start_m) / spacing_m)) + 1


def lateral_positions(tracks: Sequence[str] | Mapping[str, float]) -> Mapping[str, float]:
    """Return the lateral position in m of every wheel path, left positive.

    A mapping gives the positions itself; a sequence of names takes those of `TRACKS`, and a
    single other name lies in the middle. InputError for other names without a position.
    """
    if isinstance(tracks, Mapping):
        return MappingProxyType(dict(tracks))
    if len(tracks) == 1 and tracks[0] not in TRACKS:
        return MappingProxyType({tracks[0]: 0.0})
    unknown = [name for name in tracks if name not in TRACKS]
    if unknown:
        raise InputError(f"wheel path {unknown[0]}: give its lateral position in a mapping")
    return MappingProxyType({name: TRACKS[name] for name in tracks})


def flat_road(
    length_m: float,
    spacing_m: float = SPACING_M,
    tracks: Sequence[str] | Mapping[str, float] = ("left", "right"),
    start_m: float = START_M,
) -> Road:
    """Return a level road of elevation 0, usable up to ``length_m``."""
    sides = lateral_positions(tracks)
    points = points_of(length_m, spacing_m, start_m)
    return Road(start_m, spacing_m, {name: np.zeros(points) for name in sides}, sides)
