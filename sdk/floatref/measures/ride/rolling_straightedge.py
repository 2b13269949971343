"""A straightedge on two wheels that rolls along a wheel path and measures in its middle."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from floatref.measures.ride.deviation_areas import (
    BumpOrDip,
    Deviation,
    deviation_from_line,
    half_count,
)
from floatref.measures.roughness.areas import share
from floatref.values.arrays import FloatArray
from floatref.values.scanning import chunks

TEN_FEET_M = 3.048
"""Length of a straightedge in m (10 ft)."""
EIGHTH_INCH_M = 0.003175
"""Deviation in m (1/8 in) beyond which a contract asks for a correction."""
LENGTH = "length of the straightedge"


@dataclass(frozen=True)
class StraightedgeResult:
    """What a straightedge of ``length_m`` in m measures on a wheel path.

    ``largest_m`` is the largest size of a deviation in m, NaN if nothing was measured;
    ``defective_share`` the share of measured points beyond the tolerance, and ``valid_share`` that
    of measured points between whose wheels all points are valid, both 0 to 1.
    """

    length_m: float
    largest_m: float
    defective_share: float
    valid_share: float
    areas: tuple[BumpOrDip, ...]


def straightedge_deviation(
    elevation: FloatArray, interval_m: float, length_m: float = TEN_FEET_M
) -> FloatArray:
    """Return how far the road in the middle lies above the line between both wheels, in m.

    d_k = z_k − (z_{k−n} + z_{k+n})/2, n = round(length/2/interval), at least 1; one value for each
    point. Gaps are bridged; NaN where a wheel is outside the measured stretch, and in gaps. Raises
    InputError for elevations in m, or a length, that cannot be used. Source: the geometry; the
    middle of a 10-ft straightedge is what the New Jersey DOT had computed (Rutgers CAIT, project
    67 RU790).
    """
    return roll_straightedge(elevation, interval_m, length_m).values


def roll_straightedge(
    elevation: FloatArray,
    interval_m: float,
    length_m: float = TEN_FEET_M,
    start_m: float = 0.0,
    valid: ArrayLike | None = None,
) -> Deviation:
    """Return `straightedge_deviation`, and which of its values rest on valid points only.

    ``start_m`` is the position of point 0 in m. Without ``valid``, finite points are valid. Raises
    InputError as `straightedge_deviation`.
    """
    half = half_count(length_m, interval_m, LENGTH)
    return deviation_from_line(elevation, interval_m, half, _between_wheels, start_m, valid)


def _between_wheels(rise: FloatArray, half: int) -> FloatArray:
    return np.asarray((rise[: -2 * half] + rise[2 * half :]) / 2.0)


def rolling_straightedge(
    elevation: FloatArray,
    interval_m: float,
    length_m: float = TEN_FEET_M,
    tolerance_m: float = EIGHTH_INCH_M,
    start_m: float = 0.0,
    valid: ArrayLike | None = None,
) -> StraightedgeResult:
    """Return where the deviations of `straightedge_deviation` are beyond ``tolerance_m``.

    ``start_m`` is the position of point 0 in m. Without ``valid``, finite points are valid. Raises
    InputError as `straightedge_deviation`, and for a tolerance that is not above zero.
    """
    rolled = roll_straightedge(elevation, interval_m, length_m, start_m, valid)
    areas = rolled.list_areas(tolerance_m)
    measured = np.isfinite(rolled.values)
    largest = max((float(np.abs(part).max()) for part in _measured(rolled.values)), default=np.nan)
    beyond = sum(np.count_nonzero(np.abs(part) > tolerance_m) for part in _measured(rolled.values))
    count = np.count_nonzero(measured)
    shares = (beyond / count if count else np.nan, share(rolled.sound[measured]))
    used_m = 2 * half_count(length_m, interval_m, LENGTH) * interval_m
    return StraightedgeResult(used_m, largest, *shares, areas)


def _measured(values: FloatArray) -> Iterator[FloatArray]:
    """Yield the finite ``values`` of every piece that has some: all sizes would take their room."""
    for _, part in chunks(values):
        finite = part[np.isfinite(part)]
        if finite.size:
            yield finite
