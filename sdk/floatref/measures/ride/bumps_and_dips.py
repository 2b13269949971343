"""Bumps and dips: where a lane leaves its own moving average (Tex-1001-S).

The profiles of both wheel paths are averaged, the average is smoothed by a centred moving average
of 25 ft (7.62 m), and what lies more than 0.150 in (3.81 mm) above the smooth line is a bump, what
lies as far below it is a dip. Source: Texas Department of Transportation, Tex-1001-S; the rule is
stated in the abstract of Evaluate Methodology to Determine Localized Roughness, Texas DOT, 2016.
"""

import numpy as np
from numpy.typing import ArrayLike

from floatref.measures.ride.deviation_areas import (
    BumpOrDip,
    Deviation,
    deviation_from_line,
    half_count,
)
from floatref.values.arrays import FloatArray

AVERAGE_BASE_M = 7.62
"""Base length of the moving average in m (25 ft)."""
DEVIATION_LIMIT_M = 0.00381
"""Deviation in m (0.150 in) beyond which an area is a bump or a dip."""
BASE = "base length of the moving average"


def deviation_from_average(
    elevation: FloatArray, interval_m: float, base_m: float = AVERAGE_BASE_M
) -> FloatArray:
    """Return ``elevation`` less its centred moving average, both in m, one value for each point.

    d_k = z_k − (z_{k−n} + … + z_{k+n})/(2n + 1), n = round(base/2/interval), at least 1. Gaps are
    bridged; NaN where the window is not inside the measured stretch, and in gaps. Raises InputError
    for elevations or a base that cannot be used. Source: Tex-1001-S.
    """
    return average_deviation(elevation, interval_m, base_m).values


def average_deviation(
    elevation: FloatArray,
    interval_m: float,
    base_m: float = AVERAGE_BASE_M,
    start_m: float = 0.0,
    valid: ArrayLike | None = None,
) -> Deviation:
    """Return `deviation_from_average`, and which of its values rest on valid points only.

    ``start_m`` is the position of point 0 in m. Without ``valid``, finite points are valid. Raises
    InputError as `deviation_from_average`.
    """
    half = half_count(base_m, interval_m, BASE)
    return deviation_from_line(elevation, interval_m, half, _moving_average, start_m, valid)


def _moving_average(rise: FloatArray, half: int) -> FloatArray:
    window = 2 * half + 1
    sums = np.concatenate(([0.0], np.cumsum(rise)))
    return np.asarray((sums[window:] - sums[:-window]) / window)


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
    return average_deviation(elevation, interval_m, base_m, start_m, valid).list_areas(limit_m)
