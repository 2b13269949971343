"""6.4.3 GPS Outputs: the standard deviations that a receiver reports with its readings.

Section 6.4.4 takes their median for all readings, Table 6.1, and has that "use of the individual
estimates in real time may lead to some improvement". Both are here.
"""

import numpy as np
import numpy.typing as npt

from floatref_reference.appendix_c.symbols import Matrix
from floatref_reference.chapter_6.section_6_4_4_tuning import SIGMA_GPS


def typical_sigma(reported: npt.ArrayLike, counted: npt.ArrayLike) -> float:
    """Take one standard deviation for all readings of a quantity.

    Equation:
        Section 6.4.4: median of the estimates of the receiver, "excluding bounce tests and
        quiescent tests".

    Args:
        reported: standard deviation of each reading, NaN where the receiver gave no estimate,
            shape (M,).
        counted: whether the reading is of a run that counts, shape (M,).

    Returns:
        The median, in the unit of the estimates.

    Raises:
        ValueError: if no reading counts.
    """
    sigma = np.asarray(reported, np.float64)
    chosen = sigma[np.asarray(counted, bool) & ~np.isnan(sigma)]
    if not chosen.size:
        raise ValueError("no reading with a standard deviation counts")
    return float(np.median(chosen))


def own_sigma(reported: npt.ArrayLike, typical: npt.ArrayLike = SIGMA_GPS) -> Matrix:
    """Take the receiver's own standard deviation for each reading.

    Equation:
        Section 6.4.4, "the individual estimates"; the typical value of Table 6.1 where there is
        no estimate, as for the vertical velocity.

    Args:
        reported: of y_rz in m, y_vz in m/s, y_θ and y_φ in rad, NaN where missing, shape (M, 4).
        typical: σ_rz, σ_vz, σ_θ, σ_φ in place of a missing one, shape (4,).

    Returns:
        σ of each reading for `gps_observations`, shape (M, 4).
    """
    sigma = np.asarray(reported, np.float64).reshape(-1, 4)
    return np.where(np.isnan(sigma), np.asarray(typical, np.float64), sigma)


def resolved_readings(y: npt.ArrayLike, narrow_lane: npt.ArrayLike) -> Matrix:
    """Leave out readings whose carrier phase ambiguities are not resolved.

    Equation:
        Section 6.4.4: the performance "is not maintained if the carrier phase ambiguities are not
        resolved to narrow-lane integers".

    Args:
        y: y_rz in m, y_vz in m/s, y_θ and y_φ in rad, shape (M, 4).
        narrow_lane: whether each reading is resolved so, shape (M,).

    Returns:
        The readings, NaN where height, pitch and roll are not resolved, shape (M, 4). The velocity
        does not depend on it.
    """
    y_m = np.array(y, dtype=np.float64).reshape(-1, 4)
    unresolved = ~np.asarray(narrow_lane, bool)
    for column in (0, 2, 3):
        y_m[unresolved, column] = np.nan
    return y_m
