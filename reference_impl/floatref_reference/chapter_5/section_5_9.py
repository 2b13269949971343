"""5.9 Spatial High-Pass Filtering, Pre-Integration (figure 5.14)."""

import numpy as np
import numpy.typing as npt

from floatref_reference.appendix_a.filters import hpf_b3, hpf_b3s1, hpf_b3s2
from floatref_reference.chapter_5.section_5_3 import LAMBDA_C
from floatref_reference.chapter_5.section_5_5 import backward_passes, from_first
from floatref_reference.chapter_5.section_5_8 import captured, position, velocity
from floatref_reference.signals import Real, Signal, samples


def high_passed_velocity(
    a_zp: npt.ArrayLike, dt: npt.ArrayLike, lambda_c: Real, dx: Real
) -> Signal:
    """Integrate the vertical acceleration between the stages of the high-pass filter.

    Equation:
        Figure 5.14: HPF_B3S1 at λ_c, (5.5) with v_zp(x_1) = 0, HPF_B3S2 at λ_c.

    Args:
        a_zp: vertical acceleration with 1 g removed, m/s², shape (K,).
        dt: integration step Δt(x_k), s, shape (K,).
        lambda_c: cut-off wavelength of the third-order pass, m.
        dx: distance interval Δx, m.

    Returns:
        v_zp(x_k) as the second integration takes it, m/s, shape (K,).
    """
    f_c = 1 / np.longdouble(lambda_c)
    return hpf_b3s2(velocity(hpf_b3s1(a_zp, f_c, dx), dt), f_c, dx)


def high_passed_height(h: npt.ArrayLike, lambda_c: Real, dx: Real) -> Signal:
    """High-pass filter the height, forward.

    Equation:
        Figure 5.14: HPF_B3S1, HPF_B3S2 at λ_c, heights counted from h(x_1).

    Args:
        h: height above the road, m, shape (K,).
        lambda_c: cut-off wavelength of the third-order pass, m.
        dx: distance interval Δx, m.

    Returns:
        h(x_k) as it is subtracted, m, shape (K,).
    """
    return hpf_b3(from_first(h), 1 / np.longdouble(lambda_c), dx)


def spatial_high_pass(
    a_zp: npt.ArrayLike,
    h: npt.ArrayLike,
    r_xp: npt.ArrayLike,
    f_s: float,
    dx: float,
    lambda_c: float = LAMBDA_C,
) -> tuple[float, Signal]:
    """Compute a profile by the spatial algorithm with high-pass filters before integration.

    Equation:
        Figure 5.14: capture at each trigger, HPF_B3S1, (5.5), HPF_B3S2, (5.6), minus the
        filtered height, HPF_B3S2R, HPF_B3S1R.

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
    a_x, h_x, dt = captured(a_zp, h, r_xp, f_s, dx)
    v_zp = high_passed_velocity(a_x, dt, lambda_c, dx)
    r_zr = position(v_zp, dt) - high_passed_height(h_x, lambda_c, dx)
    return float(samples(r_xp)[0]), backward_passes(r_zr, 1 / np.longdouble(lambda_c), dx)
