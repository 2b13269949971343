"""A straightedge on two wheels that rolls along a wheel path and measures in its middle."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from floatref.errors import InputError
from floatref.measures.roughness.areas import list_areas, share, valid_points, valid_throughout
from floatref.measures.roughness.gaps import bridge, check_elevation, measured_stretch
from floatref.values.arrays import FloatArray

TEN_FEET_M = 3.048
"""Length of a straightedge in m (10 ft)."""
EIGHTH_INCH_M = 0.003175
"""Deviation in m (1/8 in) beyond which a contract asks for a correction."""


@dataclass(frozen=True)
class OutOfTolerance:
    """An area from its first to its last point in m, and its largest deviation in m, with its sign.

    ``valid_share`` is the share, 0 to 1, of its points between whose wheels all points are valid.
    """

    start_m: float
    end_m: float
    peak_at_m: float
    deviation_m: float
    valid_share: float


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
    areas: tuple[OutOfTolerance, ...]


def straightedge_half(length_m: float, interval_m: float) -> int:
    """Return the intervals from the middle of a straightedge to its wheels, at least 1.

    round(length/2/interval), ties to even. Raises InputError for a length that is not a positive,
    finite number.
    """
    if not (np.isfinite(length_m) and length_m > 0):
        raise InputError(f"length of the straightedge is {length_m} m; it must be above zero")
    return max(round(length_m / 2.0 / interval_m), 1)


def straightedge_deviation(
    elevation: FloatArray, interval_m: float, length_m: float = TEN_FEET_M
) -> FloatArray:
    """Return how far the road in the middle lies above the line between both wheels, in m.

    d_k = z_k − (z_{k−n} + z_{k+n})/2, with n from `straightedge_half`; one value for each point.
    Gaps are bridged; NaN where a wheel is outside the measured stretch, and in gaps. Raises
    InputError for elevations in m, or a length, that cannot be used. Source: the geometry; the
    middle of a 10-ft straightedge is what the New Jersey DOT had computed (Rutgers CAIT, project 67
    RU790).
    """
    values = check_elevation(elevation, interval_m)
    half = straightedge_half(length_m, interval_m)
    stretch = measured_stretch(values)
    rise = bridge(values[stretch]) - values[stretch.start]
    deviation = np.full(values.size, np.nan)
    if rise.size > 2 * half:
        line = (rise[: -2 * half] + rise[2 * half :]) / 2.0
        deviation[stretch.start + half : stretch.stop - half] = rise[half:-half] - line
    deviation[~np.isfinite(values)] = np.nan
    return deviation


def rolling_straightedge(
    elevation: FloatArray,
    interval_m: float,
    length_m: float = TEN_FEET_M,
    tolerance_m: float = EIGHTH_INCH_M,
    start_m: float = 0.0,
    valid: ArrayLike | None = None,
) -> StraightedgeResult:
    """Return where the deviations of `straightedge_deviation` are beyond ``tolerance_m``.

    High and low places are areas of their own, in order of position.
    ``start_m`` is the position of point 0 in m. Without ``valid``, finite points are valid. Raises
    InputError as `straightedge_deviation`, and for a tolerance that is not above zero.
    """
    if not tolerance_m > 0:
        raise InputError(f"tolerance is {tolerance_m} m; it must be above zero")
    deviation = straightedge_deviation(elevation, interval_m, length_m)
    half = straightedge_half(length_m, interval_m)
    sound = valid_throughout(valid_points(valid, np.asarray(elevation)), half, half)
    size, measured = np.abs(deviation), np.isfinite(deviation)
    areas = [
        OutOfTolerance(
            start_m + area.first * interval_m,
            start_m + (area.end - 1) * interval_m,
            start_m + area.peak * interval_m,
            float(deviation[area.peak]),
            share(sound[area.first : area.end]),
        )
        for sign in (1.0, -1.0)
        for area in list_areas(sign * deviation, tolerance_m)
    ]
    areas.sort(key=lambda area: area.start_m)
    largest = float(size[measured].max()) if measured.any() else float("nan")
    beyond, reliable = size[measured] > tolerance_m, sound[measured]
    found = (largest, share(beyond), share(reliable), tuple(areas))
    return StraightedgeResult(2 * half * interval_m, *found)
