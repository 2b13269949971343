"""Bumps and dips: where a lane leaves its own moving average (Tex-1001-S).

The profiles of both wheel paths are averaged, the average is smoothed by a centred moving average
of 25 ft (7.62 m), and what lies more than 0.150 in (3.81 mm) above the smooth line is a bump, what
lies as far below it is a dip. Source: Texas Department of Transportation, Tex-1001-S; the rule is
stated in the abstract of Evaluate Methodology to Determine Localized Roughness, Texas DOT, 2016.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from floatref.errors import InputError
from floatref.measures.roughness.areas import (
    Area,
    list_areas,
    share,
    valid_points,
    valid_throughout,
)
from floatref.measures.roughness.gaps import bridge, check_elevation, measured_stretch
from floatref.values.arrays import BoolArray, FloatArray

AVERAGE_BASE_M = 7.62
"""Base length of the moving average in m (25 ft)."""
DEVIATION_LIMIT_M = 0.00381
"""Deviation in m (0.150 in) beyond which an area is a bump or a dip."""


@dataclass(frozen=True)
class BumpOrDip:
    """An area from its first to its last point in m, and its largest deviation in m.

    ``kind`` is "bump" or "dip"; ``deviation_m`` is below zero for a dip and lies at ``peak_at_m``.
    ``valid_share`` is the share, 0 to 1, of its points whose base length is valid throughout.
    """

    kind: str
    start_m: float
    end_m: float
    peak_at_m: float
    deviation_m: float
    valid_share: float


def half_window(base_m: float, interval_m: float) -> int:
    """Return the points on either side of the centre of a moving average over ``base_m`` in m.

    round(base/2/interval), ties to even, at least 1. Raises InputError for a base that is not a
    positive, finite number.
    """
    if not (np.isfinite(base_m) and base_m > 0):
        raise InputError(f"base length is {base_m} m; it must be above zero")
    return max(round(base_m / 2.0 / interval_m), 1)


def deviation_from_average(
    elevation: FloatArray, interval_m: float, base_m: float = AVERAGE_BASE_M
) -> FloatArray:
    """Return ``elevation`` less its centred moving average, both in m, one value for each point.

    d_k = z_k − (z_{k−n} + … + z_{k+n})/(2n + 1), n from `half_window`. Gaps are bridged; NaN where
    the window is not inside the measured stretch, and in gaps. Raises InputError for elevations or
    a base that cannot be used. Source: Tex-1001-S.
    """
    values = check_elevation(elevation, interval_m)
    half = half_window(base_m, interval_m)
    stretch = measured_stretch(values)
    rise = bridge(values[stretch]) - values[stretch.start]
    deviation = np.full(values.size, np.nan)
    if rise.size > 2 * half:
        window = 2 * half + 1
        sums = np.concatenate(([0.0], np.cumsum(rise)))
        means = (sums[window:] - sums[:-window]) / window
        deviation[stretch.start + half : stretch.stop - half] = rise[half:-half] - means
    deviation[~np.isfinite(values)] = np.nan
    return deviation


def bumps_and_dips(
    elevation: FloatArray,
    interval_m: float,
    limit_m: float = DEVIATION_LIMIT_M,
    base_m: float = AVERAGE_BASE_M,
    start_m: float = 0.0,
    valid: ArrayLike | None = None,
) -> tuple[BumpOrDip, ...]:
    """Return every bump and dip of ``elevation`` in m, in order of position.

    ``elevation`` is the mean of both wheel paths, as `mean_path` gives it; ``limit_m`` the
    deviation beyond which a point belongs to an area; ``start_m`` the position of point 0. Without
    ``valid``, finite points are valid. Raises InputError as `deviation_from_average`, and for a
    limit that is not above zero. Source: Tex-1001-S.
    """
    if not limit_m > 0:
        raise InputError(f"limit is {limit_m} m; it must be above zero")
    deviation = deviation_from_average(elevation, interval_m, base_m)
    half = half_window(base_m, interval_m)
    sound = valid_throughout(valid_points(valid, np.asarray(elevation)), half, half)
    found = [
        _describe(kind, area, deviation, sound, interval_m, start_m)
        for kind, sign in (("bump", 1.0), ("dip", -1.0))
        for area in list_areas(sign * deviation, limit_m)
    ]
    return tuple(sorted(found, key=lambda each: each.start_m))


def _describe(
    kind: str,
    area: Area,
    deviation: FloatArray,
    sound: BoolArray,
    interval_m: float,
    start_m: float,
) -> BumpOrDip:
    """Return the record of ``area``."""
    return BumpOrDip(
        kind,
        start_m + area.first * interval_m,
        start_m + (area.end - 1) * interval_m,
        start_m + area.peak * interval_m,
        float(deviation[area.peak]),
        share(sound[area.first : area.end]),
    )
