"""5.4 Temporal Mean Removal."""

import numpy as np
import numpy.typing as npt

from floatref_reference.appendix_a.filters import hpf_b3x2
from floatref_reference.chapter_5.section_5_3 import (
    LAMBDA_C,
    anti_alias,
    capture,
    temporal_profile,
    trigger,
)
from floatref_reference.signals import Signal, samples


def mean_removal(
    a_zp: npt.ArrayLike,
    h: npt.ArrayLike,
    r_xp: npt.ArrayLike,
    f_s: float,
    dx: float,
    lambda_c: float = LAMBDA_C,
) -> tuple[float, Signal]:
    """Compute a profile by the temporal algorithm with mean removal.

    Equation:
        Section 5.4: as figure 5.4, with the mean over the run removed from a_zp(t_k) before
        the first integration and from v_zp(t_k) before the second.

    Args:
        a_zp: vertical acceleration with 1 g removed, m/s², shape (N,).
        h: height above the road, m, shape (N,).
        r_xp: travel distance, m, shape (N,), non-decreasing.
        f_s: sampling rate of the three signals, Hz.
        dx: distance interval Δx of the profile, m.
        lambda_c: cut-off wavelength of each third-order pass, m.

    Returns:
        Distance of the first point, m, and the spatial profile r_zr(x_k), m.
    """
    points = trigger(r_xp, dx)
    r_zr = temporal_profile(anti_alias(a_zp, f_s), anti_alias(h, f_s), f_s, mean_removal=True)
    r_zr_x = hpf_b3x2(capture(r_zr, points), 1 / np.longdouble(lambda_c), dx)
    return float(samples(r_xp)[0]), r_zr_x
