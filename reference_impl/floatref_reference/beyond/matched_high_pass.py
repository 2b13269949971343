"""The matched high-pass filter: vehicle motion cancels under any schedule of the cut-off.

Section 5.7 filters accelerometer and height sensor apart, one before and between integrations.
While the cut-off changes, a filter stage and an integration no longer commute, so motion that
both sensors see leaves a residue. An observer driven by both has one filter for their difference:

    r' = v + 2 ω (h - r),  v' = a + b + 2 ω² (h - r),  b' = ω³ (h - r)

At a constant cut-off r - h is (A.1) applied to the profile ∬ a dt - h; under any schedule it
depends on that profile alone. The backward passes over distance hold ω inside their integrals too.
"""

import numpy as np
import numpy.typing as npt

from floatref_reference.appendix_a.varying import substitutions
from floatref_reference.beyond.state_variable import (
    hpf_b3s1r_state_variable,
    hpf_b3s2r_state_variable,
)
from floatref_reference.chapter_5.section_5_3 import anti_alias, capture, temporal_profile, trigger
from floatref_reference.chapter_5.section_5_6 import travel_speed
from floatref_reference.chapter_5.section_5_7 import (
    SCHEDULE,
    Schedule,
    cut_off_frequency,
    cut_off_wave_number,
)
from floatref_reference.signals import ZERO, Real, Samples, Signal, samples, signal


def matched_filter(z: npt.ArrayLike, f_c: npt.ArrayLike, dt: Real) -> Signal:
    """Apply the third-order high-pass filter whose cut-off acts inside its integrals.

    Equation:
        The observer with e = r - h and z = ∬ a dt - h: e = z - ∫ 2ωe - ∬ 2ω²e - ∭ ω³e, each
        integral by the trapezoidal rule. With ω = (2/Δt) c, (A.7) and (A.11), the sums
        T x(t_k) = T x(t_{k-1}) + x(t_k) + x(t_{k-1}), T x(t_1) = 0, give
        e = z - R, R = T(2 c e + Q), Q = T(2 c² e + P), P = T(c³ e).
        At constant c with z(t_1) = 0 this is HPF_B3, (A.1).

    Args:
        z: temporal profile, m, shape (N,), starting at 0.
        f_c: cut-off frequency at every sample, Hz, shape (N,).
        dt: sampling period Δt, s.

    Returns:
        e(t_k), m, shape (N,), starting at 0.

    Raises:
        ValueError: unless every sample has its cut-off, 0 < f_c Δt < 0.5, and z starts at 0.
    """
    z_t, c = samples(z), substitutions(f_c, dt)
    if len(c) != len(z_t):
        raise ValueError(f"{len(c)} cut-offs do not fit a signal of {len(z_t)} samples")
    if z_t[0] != 0:
        raise ValueError(f"the profile starts at {z_t[0]} m, not at 0")
    e: Samples = [ZERO]
    P = Q = R = ZERO
    for k in range(1, len(z_t)):
        past, now = c[k - 1], c[k]
        P_known = P + past**3 * e[k - 1]
        Q_known = Q + 2 * past**2 * e[k - 1] + P + P_known
        R_known = R + 2 * past * e[k - 1] + Q + Q_known
        e.append((z_t[k] - R_known) / (1 + 2 * now + 2 * now**2 + now**3))
        P = P_known + now**3 * e[k]
        Q = Q_known + (2 * now**2 + now**3) * e[k]
        R = R_known + (2 * now + 2 * now**2 + now**3) * e[k]
    return signal(e)


def matched_high_pass(
    a_zp: npt.ArrayLike,
    h: npt.ArrayLike,
    r_xp: npt.ArrayLike,
    f_s: float,
    dx: float,
    schedule: Schedule = SCHEDULE,
) -> tuple[float, Signal]:
    """Compute a profile by the matched high-pass filter with a spatial backward pass.

    Equation:
        The temporal profile of figure 5.4 through `matched_filter` with f_c(t_k) of (5.3);
        decimation and backward passes over distance as in figure 5.12, these in the form of
        `state_variable`.

    Args:
        a_zp: vertical acceleration with 1 g removed, m/s², shape (N,).
        h: height above the road, m, shape (N,).
        r_xp: travel distance, m, shape (N,), non-decreasing.
        f_s: sampling rate of the three signals, Hz.
        dx: distance interval Δx of the profile, m.
        schedule: settings of (5.3).

    Returns:
        Distance of the first point, m, and the spatial profile r_zr(x_k), m.
    """
    points, v_xp = trigger(r_xp, dx), travel_speed(r_xp, f_s)
    z = temporal_profile(anti_alias(a_zp, f_s), anti_alias(h, f_s), f_s)
    r_zr = matched_filter(z, cut_off_frequency(v_xp, schedule), 1 / np.longdouble(f_s))
    wave_number = cut_off_wave_number(capture(v_xp, points), dx, schedule)
    r_zr_x = hpf_b3s2r_state_variable(capture(r_zr, points), wave_number, dx)
    return float(samples(r_xp)[0]), hpf_b3s1r_state_variable(r_zr_x, wave_number, dx)
