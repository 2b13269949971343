"""A road surface: elevation over distance and lateral position, and lines across it."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from floatref.errors import InputError
from floatref.values.arrays import FloatArray, IndexArray

Lateral = Callable[[FloatArray], FloatArray]
"""Lateral position in m, left positive, at distances in m; both of shape (n,)."""
ON_STRING = 1e-6
"""A line this close to a string, in lateral spacings, lies on it: rounding leaves a part of it."""


@dataclass(frozen=True, eq=False)
class Surface:
    """Elevation on a grid of distance by lateral position, one string per lateral position.

    The elevation is neither copied nor converted: 10 km at 25 mm, 3 m wide, take 194 MB as
    float32.

    Attributes:
        start_m: true distance of the first point of every string, in m.
        spacing_m: distance between the points of a string, in m.
        right_m: lateral position of the first string, the rightmost one, in m, left positive.
        across_m: distance between neighbouring strings, in m.
        elevation: in m, shape (strings, points), float32 or float64, read-only; NaN is a hole.
    """

    start_m: float
    spacing_m: float
    right_m: float
    across_m: float
    elevation: NDArray[np.float32] | NDArray[np.float64]

    def __post_init__(self) -> None:
        """Refuse an impossible grid; InputError names the number."""
        for name in ("spacing_m", "across_m"):
            value = getattr(self, name)
            if not (np.isfinite(value) and value > 0):
                raise InputError(f"{name} is {value}; it must be above zero")
        if not np.isfinite([self.start_m, self.right_m]).all():
            raise InputError("start_m and right_m of a surface must be finite")
        z = self.elevation
        if z.dtype not in (np.float32, np.float64):
            raise InputError(f"elevation is {z.dtype}; give float32 or float64")
        if z.ndim != 2 or min(z.shape) < 2:
            raise InputError(f"elevation has the shape {z.shape}; give two strings of two points")
        view = z.view()
        view.flags.writeable = False
        object.__setattr__(self, "elevation", view)

    @property
    def points(self) -> int:
        """Number of points of each string."""
        return int(self.elevation.shape[1])

    @property
    def left_m(self) -> float:
        """Lateral position of the last, the leftmost string, in m."""
        return self.right_m + self.across_m * float(self.elevation.shape[0] - 1)

    @property
    def distance_m(self) -> FloatArray:
        """True distance of every point of a string, shape (points,), in m."""
        return self.start_m + self.spacing_m * np.arange(self.points, dtype=np.float64)

    def line(self, lateral: Lateral | FloatArray) -> FloatArray:
        """Return the elevation in m along a line, linear between neighbouring strings.

        Args:
            lateral: lateral position in m of the line at `distance_m`, shape (points,), or a
                function that returns it there.

        Raises:
            InputError: for a line of another shape, one that leaves the surface or crosses a
                hole; it names the distance and the lateral position.
        """
        y = np.asarray(lateral(self.distance_m) if callable(lateral) else lateral)
        if y.shape != (self.points,):
            raise InputError(f"the line has the shape {y.shape}; give {self.points} positions")
        right, weight = self._between(y)
        points = np.arange(self.points)
        below = self.elevation[right, points].astype(np.float64)
        above = self.elevation[np.minimum(right + 1, self.elevation.shape[0] - 1), points]
        z = np.where(weight > 0, below + weight * (above - below), below)
        self._refuse(~np.isfinite(z), y, "the surface has a hole there; fill it or cut it off")
        return z

    def _between(self, y: FloatArray) -> tuple[IndexArray, FloatArray]:
        """Return the string on the right of each position, and the weight of its left one."""
        position = (y - self.right_m) / self.across_m
        position = np.where(
            np.abs(position - np.rint(position)) < ON_STRING, np.rint(position), position
        )
        self.refuse_beyond(y)
        right = position.astype(np.int64)
        return right, position - right

    def refuse_beyond(self, y: FloatArray) -> None:
        """Raise InputError for the first lateral position in m beyond the outer strings."""
        margin = ON_STRING * self.across_m
        inside = (y >= self.right_m - margin) & (y <= self.left_m + margin)
        reach = f"the surface reaches from {self.right_m:g} to {self.left_m:g} m"
        self._refuse(~inside, y, f"{reach}; take a wider one or let the line wander less")

    def _refuse(self, wrong: NDArray[np.bool_], y: FloatArray, why: str) -> None:
        """Raise InputError that names the first place where ``wrong`` holds."""
        if wrong.any():
            at = int(np.argmax(wrong))
            x = self.start_m + self.spacing_m * at
            raise InputError(f"line at {x:.2f} m, {y[at]:.3f} m to the left: {why}")
