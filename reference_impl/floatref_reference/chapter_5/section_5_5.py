"""5.5 Temporal High-Pass Filtering, Pre-Integration (figure 5.9)."""

import numpy as np
import numpy.typing as npt

from floatref_reference.appendix_a.cut_off import high_pass_cut_off
from floatref_reference.appendix_a.filters import hpf_b3, hpf_b3s1, hpf_b3s1r, hpf_b3s2, hpf_b3s2r
from floatref_reference.chapter_5.section_5_3 import anti_alias, capture, trapezoidal_rule, trigger
from floatref_reference.signals import Real, Signal, samples, signal

F_3DB = 0.0489


def from_first(h: npt.ArrayLike) -> Signal:
    """Measure the height from its first value.

    Equation:
        Section 5.5 does not define the datum of the elevation. With h(t_1) subtracted, the
        high-pass filters start at zero and not on a step as high as the stand-off.

    Args:
        h: height above the road, m, shape (N,).

    Returns:
        h(t_k) - h(t_1), m, shape (N,).
    """
    h_t = samples(h)
    return signal(h_t) - h_t[0]


def integrated_acceleration(a_zp: npt.ArrayLike, f_c: Real, dt: Real) -> Signal:
    """High-pass filter the vertical acceleration and integrate it once.

    Equation:
        Figure 5.9: HPF_B3S1, then v_zp = ∫ a_zp dt with v_zp(t_1) = 0.

    Args:
        a_zp: vertical acceleration with 1 g removed, m/s², shape (N,).
        f_c: cut-off frequency of the third-order pass, Hz.
        dt: sampling period Δt, s.

    Returns:
        v_zp(t_k), m/s, shape (N,).
    """
    return trapezoidal_rule(hpf_b3s1(a_zp, f_c, dt), dt)


def floating_reference_height(v_zp: npt.ArrayLike, f_c: Real, dt: Real) -> Signal:
    """High-pass filter the vertical velocity and integrate it.

    Equation:
        Figure 5.9: HPF_B3S2, then r_zp = ∫ v_zp dt with r_zp(t_1) = 0.

    Args:
        v_zp: vertical velocity, m/s, shape (N,).
        f_c: cut-off frequency of the third-order pass, Hz.
        dt: sampling period Δt, s.

    Returns:
        r_zp(t_k), m, shape (N,).
    """
    return trapezoidal_rule(hpf_b3s2(v_zp, f_c, dt), dt)


def backward_passes(r_zr: npt.ArrayLike, f_c: Real, dt: Real) -> Signal:
    """Cancel the phase shift of the forward passes.

    Equation:
        Figure 5.9: HPF_B3S2R, then HPF_B3S1R.

    Args:
        r_zr: profile after the forward passes, m, shape (N,).
        f_c: cut-off frequency of the third-order pass, Hz (or 1/λ_c, 1/m).
        dt: sampling period Δt, s (or distance interval, m).

    Returns:
        r_zr, m, shape (N,).
    """
    return hpf_b3s1r(hpf_b3s2r(r_zr, f_c, dt), f_c, dt)


def temporal_high_pass(
    a_zp: npt.ArrayLike,
    h: npt.ArrayLike,
    r_xp: npt.ArrayLike,
    f_s: float,
    dx: float,
    f_3db: float = F_3DB,
) -> tuple[float, Signal]:
    """Compute a profile by the temporal algorithm with high-pass filters before integration.

    Equation:
        Figure 5.9: anti-alias filter; a_zp through HPF_B3S1, ∫, HPF_B3S2, ∫; h through
        HPF_B3S1, HPF_B3S2; their difference through HPF_B3S2R, HPF_B3S1R; decimation to Δx.
        Each third-order pass has the cut-off (A.20) of the collective f_-3dB.

    Args:
        a_zp: vertical acceleration with 1 g removed, m/s², shape (N,).
        h: height above the road, m, shape (N,).
        r_xp: travel distance, m, shape (N,), non-decreasing.
        f_s: sampling rate of the three signals, Hz.
        dx: distance interval Δx of the profile, m.
        f_3db: frequency at which the forward and backward passes together lose 3 dB, Hz.

    Returns:
        Distance of the first point, m, and the spatial profile r_zr(x_k), m.
    """
    points, dt, f_c = trigger(r_xp, dx), 1 / np.longdouble(f_s), high_pass_cut_off(f_3db)
    v_zp = integrated_acceleration(anti_alias(a_zp, f_s), f_c, dt)
    r_zp = floating_reference_height(v_zp, f_c, dt)
    r_zr = r_zp - hpf_b3(from_first(anti_alias(h, f_s)), f_c, dt)
    return float(samples(r_xp)[0]), capture(backward_passes(r_zr, f_c, dt), points)
