"""A line laser: one height of a line across the lane, which narrow features do not reach.

The nominal profiler of the dissertation has a line laser of about 400 readings over 100 mm (4.3),
an LMI Gocator 2342: a wide footprint tells changes of a wide area from texture, narrow cracks and
joints (4.1.1). AASHTO R 56 asks for a single, bridged elevation of such a line. The rule is the
maker's, "Bridge Value" in the user manual of Gocator line profile sensors (LMI Technologies): the
readings are sorted by height, the highest share `SKIP` is left out, as stones and rubber are, what
lies below the highest share `WINDOW` is left out, as cracks and tining are, and the mean of the
others is the height. 15 % and 85 % are the numbers of the manual's figure; no tilt is taken off.

So a crack of up to 15 % of the line does not count, a dip of 85 % or more counts as a whole, and a
plane has the height of its middle. The strings of a surface are 10 mm apart and straight in
between; readings 0.25 mm apart are as good as the continuous line between them, whose
height is found in closed form: they differ by less than the relief of the line divided by 400.

On six wheel paths of table 2.2's normal case, filtered as for the IRI, the height of 100 mm agrees
with that of a point in its middle by 0.996 (lowest 0.994), that of 300 mm by 0.990 (0.981).
"""

import numpy as np

from floatref.errors import InputError
from floatref.values.arrays import FloatArray
from floatref_conformance.proving_ground.roads.surface import Surface

SKIP, WINDOW = 0.15, 0.85
"""Highest share of the readings that is left out, and the share within which the others lie."""


def bridge(surface: Surface, lateral_m: FloatArray, width_m: float) -> FloatArray:
    """Return the height in m that a line laser gives at every point along a surface.

    Args:
        surface: strings along the road.
        lateral_m: lateral position of the line's middle, left positive, in m, shape (points,).
        width_m: width of the line, in m.

    Raises:
        InputError: for a width that is not above zero, and where the line leaves the surface or
            crosses a hole.
    """
    from floatref_conformance.proving_ground.roads.bridging_kernels import bridge_strings

    if not (np.isfinite(width_m) and width_m > 0):
        raise InputError(f"the line of a laser is {width_m} m wide; it must be above zero")
    for beyond in (lateral_m - width_m / 2, lateral_m + width_m / 2):
        surface.refuse_beyond(beyond)
    begin = (lateral_m - width_m / 2 - surface.right_m) / surface.across_m
    width = width_m / surface.across_m
    _refuse_holes(surface, begin, width)
    heights = np.empty(surface.points)
    strings = np.asarray(surface.elevation, dtype=np.float64)
    bridge_strings(strings, begin, width, 1.0 - WINDOW, SKIP, heights)
    return heights


def _refuse_holes(surface: Surface, begin: FloatArray, width: float) -> None:
    """Raise InputError for a hole under a line that begins at ``begin``, both in strings."""
    strings, points = np.nonzero(np.isnan(surface.elevation))
    under = (strings > begin[points] - 1) & (strings < begin[points] + width + 1)
    if under.any():
        at = surface.start_m + surface.spacing_m * int(points[under].min())
        raise InputError(f"line at {at:.2f} m: the surface has a hole there; fill it or cut it off")
