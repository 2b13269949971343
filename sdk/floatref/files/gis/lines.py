"""Lines on the earth from places along a road, as RFC 7946 has them.

A place is a longitude and a latitude in degrees, in this order, with seven decimals: 11 mm. A line
has two places or more. It ends where places are unknown, and at the 180th meridian, where it goes
on from the other side.
"""

from collections.abc import Iterator
from itertools import pairwise

import numpy as np

from floatref.values.arrays import FloatArray

Place = tuple[float, float]
Line = tuple[Place, ...]

DECIMALS = 7
HALF_TURN, TURN = 180.0, 360.0


def known_lines(latitude_deg: FloatArray, longitude_deg: FloatArray) -> tuple[Line, ...]:
    """Return the lines through the known places of a road, in its order.

    Both have shape (N,) and NaN where a place is unknown; longitudes from -180 to 180. A known
    place between unknown ones is no line.
    """
    known = np.isfinite(latitude_deg) & np.isfinite(longitude_deg)
    edges = np.flatnonzero(np.diff(known, prepend=False, append=False))
    found: list[Line] = []
    for first, end in edges.reshape(-1, 2).tolist():
        east, north = (angles[first:end].tolist() for angles in (longitude_deg, latitude_deg))
        found += _cut_at_half_turn(tuple(zip(east, north, strict=True)))
    return tuple(_rounded(line) for line in found if len(line) > 1)


def _cut_at_half_turn(line: Line) -> Iterator[Line]:
    """Yield the parts of ``line`` on either side of the 180th meridian."""
    part = [line[0]]
    for (one, here), (other, there) in pairwise(line):
        if abs(other - one) > HALF_TURN:
            side = HALF_TURN if one > 0.0 else -HALF_TURN
            # The way from one to other is short, and goes over the meridian.
            way = other - one + (TURN if one > 0.0 else -TURN)
            share = (side - one) / way if way else 0.0
            latitude = here + share * (there - here)
            yield (*part, (side, latitude))
            part = [(-side, latitude)]
        part.append((other, there))
    yield tuple(part)


def _rounded(line: Line) -> Line:
    return tuple((round(east, DECIMALS), round(north, DECIMALS)) for east, north in line)
