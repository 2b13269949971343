"""A road from a measured surface: lines across an OpenCRG file.

The wheel paths lie at their lateral positions from the file's reference line, and a vehicle
that leaves them meets the surface beside them. The file starts where a made road carries its whole
roughness. Before and beyond its ends the surface is mirrored, which keeps neighbouring lines
together, less one slope along the road for all of them, which has no roughness: otherwise a
graded surface would become a roof. The file is read in a process of its own, for the OpenCRG
library ends the process on many that are damaged.
"""

from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from scipy.interpolate import CubicSpline

from floatref.errors import InputError, missing_extra
from floatref.files.apart.child_process import LONGEST_SILENCE_S, MOST_MEMORY, read_apart
from floatref.files.sources import check_file, name_errors
from floatref.values.arrays import FloatArray, IndexArray
from floatref_conformance.proving_ground.roads.road import (
    FULL_FROM_M,
    SPACING_M,
    START_M,
    Road,
    lateral_positions,
    points_of,
)
from floatref_conformance.proving_ground.roads.shaping import with_level_start
from floatref_conformance.proving_ground.roads.wander import Line

if TYPE_CHECKING:
    import pycrg

SUFFIX = ".crg"
ROUNDING_M = 1e-6
"""A line this far beyond an edge is on it: positions in a file are rounded."""
FEWEST_POINTS = 4
"""Fewest cross sections of which a road is made, as of points of a profile."""
BYTES_PER_POINT = 512
"""What splines through a surface take: some thirty numbers per point, and as many again."""
BYTES_PER_BYTE = 8
"""What a surface takes per byte of its file: at most a double per digit."""
MOST_BYTES = 2 << 30
"""Largest file that is read: it takes as much memory, and one of zeros takes no room on a disk."""
SLOWEST, SLOWEST_POINTS = 1e6, 1e4
"""Bytes, and points of the road, per s: a file is given the time that they take at these rates,
beyond what each has. A busy machine is slow, and cross sections may be closer than points."""


def crg_road(
    path: Path,
    length_m: float,
    line: Line | None = None,
    spacing_m: float = SPACING_M,
    tracks: Sequence[str] | Mapping[str, float] = ("left", "right"),
    start_m: float = START_M,
) -> Road:
    """Make a road, usable up to ``length_m``, of an OpenCRG file, under a line if one is given.

    Raises InputError that names the file if it cannot be read, has more than `MOST_BYTES`, or if
    pycrg is missing, and for a surface of fewer than four cross sections, one with a hole under a
    wheel path, or one too narrow for a wheel path.
    """
    sides = lateral_positions(tracks)
    points = points_of(length_m, spacing_m, start_m)
    size = _check(path)
    (elevation,) = read_apart(
        f"{__name__}:read_lines",
        (path, start_m + spacing_m * np.arange(points, dtype=np.float64), line, dict(sides)),
        f"{path}: not a whole OpenCRG file (the library that reads it broke down); "
        "copy the complete file again",
        LONGEST_SILENCE_S + size / SLOWEST + points / SLOWEST_POINTS,
        MOST_MEMORY + BYTES_PER_POINT * points + BYTES_PER_BYTE * size,
    )
    return with_level_start(Road(start_m, spacing_m, elevation, sides))


def _check(path: Path) -> int:
    """Return the bytes of a file that pycrg can read; InputError if it cannot, or is missing."""
    check_file(path)
    size = path.stat().st_size
    if size > MOST_BYTES:
        raise InputError(
            f"{path}: has {size / 1e9:.1f} GB, and surfaces of up to {MOST_BYTES / 1e9:.1f} GB are "
            "read; cut it into shorter ones"
        )
    try:
        import pycrg as pycrg
    except ImportError as error:
        raise missing_extra(f"{path}: reading OpenCRG needs pycrg", "conformance") from error
    return size


def read_lines(
    path: Path, x: FloatArray, line: Line | None, sides: Mapping[str, float]
) -> Iterator[dict[str, FloatArray]]:
    """Yield once the elevation in m of each wheel path at ``x`` m, each of the shape of ``x``.

    ``sides`` are the lateral positions in m. Raises InputError that names the file.
    """
    with _opened(path) as surface, name_errors(path):
        (begin, end), (step, _) = surface.u_range(), surface.increments()
        sections = round((end - begin) / step) + 1
        if sections < FEWEST_POINTS:
            raise InputError(f"has {sections} cross sections; a road needs {FEWEST_POINTS} or more")
        slope = _slope(surface, sections, list(sides.values()))
        first = int(np.floor((x[0] - FULL_FROM_M) / step)) - 2
        last = int(np.ceil((x[-1] - FULL_FROM_M) / step)) + 2
        knots = np.arange(first, last + 1)
        at = FULL_FROM_M + step * knots.astype(np.float64)
        rows = sections - 1 - np.abs(np.mod(knots, 2 * (sections - 1)) - (sections - 1))
        shift = np.zeros(knots.size) if line is None else line.at(at)
        yield {
            name: CubicSpline(at, _sample(surface, rows, side + shift) - slope * rows)(x)
            for name, side in sides.items()
        }


@contextmanager
def _opened(path: Path) -> Iterator["pycrg.RoadSurface"]:
    """Open an OpenCRG file as it is stored but for its own modifiers, holes kept as holes."""
    import pycrg

    try:
        with pycrg.RoadSurface.open(path, apply_modifiers=False) as surface:
            surface.modifier_set_int(pycrg.MOD_GRID_NAN_MODE, pycrg.GRID_NAN_KEEP)
            surface.modifiers_apply()
            yield surface
    except (pycrg.OpenCRGError, OSError) as error:
        raise InputError(
            f"{path}: not a whole OpenCRG file ({' '.join(str(error).split())})"
        ) from error


def _slope(surface: "pycrg.RoadSurface", sections: int, sides: list[float]) -> float:
    """Return the mean slope of the wheel paths along the file, in m per cross section."""
    rows = np.arange(sections)
    middle = np.mean([_sample(surface, rows, np.full(sections, y)) for y in sides], axis=0)
    return float(np.polyfit(rows, middle, 1)[0])


def _sample(surface: "pycrg.RoadSurface", rows: IndexArray, y: FloatArray) -> FloatArray:
    """Return the elevation in m at cross sections and lateral positions, bilinear."""
    (begin, _), (step, _), (right, left) = (
        surface.u_range(),
        surface.increments(),
        surface.v_range(),
    )
    u = begin + step * rows
    outside = (y < right - ROUNDING_M) | (y > left + ROUNDING_M)
    if outside.any():
        far = y[int(np.argmax(outside))]
        raise InputError(
            f"the surface reaches from {right:g} to {left:g} m across, and the line is at "
            f"{far:.4f} m; take a wider one or lower wander_m, wander_within_m or laser_line_mm"
        )
    z = surface.uv_to_z_many(u, np.clip(y, right, left))
    holes = ~np.isfinite(z)
    if holes.any():
        at = int(np.argmax(holes))
        raise InputError(
            f"the surface has a hole at u {u[at]:.3f} m, v {y[at]:.3f} m, under the line; "
            "fill it or cut it off"
        )
    return np.asarray(z, dtype=np.float64)
