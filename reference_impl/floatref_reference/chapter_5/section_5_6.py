"""5.6 Local Suppression (figure 5.10)."""

import numpy as np
import numpy.typing as npt

from floatref_reference.appendix_a.cut_off import high_pass_cut_off
from floatref_reference.appendix_a.filters import hpf_b3
from floatref_reference.chapter_5.section_5_3 import anti_alias, capture, trigger
from floatref_reference.chapter_5.section_5_5 import (
    F_3DB,
    backward_passes,
    floating_reference_height,
    from_first,
    integrated_acceleration,
)
from floatref_reference.signals import ZERO, Real, Samples, Signal, samples, signal

WINDOW = 0.05
V_ON = 4.4704
"""Speed below which the controller acts, m/s: 10 mph, printed as 16 km/h."""
K_P = 0.001
K_I = 0.834


def travel_speed(r_xp: npt.ArrayLike, f_s: Real) -> Signal:
    """Estimate the speed of travel from the encoder's progress over the preceding 0.05 s.

    Equation:
        Section 5.6: v_xp(t_k) = (r_xp(t_k) - r_xp(t_{k-n})) / (n Δt) with n Δt nearest to 0.05 s,
        n at least 1. Before t_1 the vehicle is stationary at r_xp(t_1).

    Args:
        r_xp: travel distance, m, shape (N,).
        f_s: sampling rate, Hz.

    Returns:
        v_xp(t_k), m/s, shape (N,).
    """
    r_t, n = samples(r_xp), max(1, round(WINDOW * float(f_s)))
    v_xp: Samples = []
    for k in range(len(r_t)):
        v_xp.append((r_t[k] - r_t[max(k - n, 0)]) * np.longdouble(f_s) / n)
    return signal(v_xp)


def time_constant(K_P: float = K_P, K_I: float = K_I) -> float:
    """Compute the time constant of the controller's answer to a step.

    Equation:
        (5.1) τ = (K_P + 1) / K_I

    Args:
        K_P: proportional gain, dimensionless.
        K_I: integral gain, 1/s.

    Returns:
        τ, s.
    """
    return (K_P + 1) / K_I


def frequency_response(omega: float, K_P: float = K_P, K_I: float = K_I) -> complex:
    """Evaluate the controlled velocity relative to its disturbance.

    Equation:
        (5.2), with the sign of the real part mended, which prints as a minus:
        v_zp(ω) / d(ω) = (1/K_I) (jω + τ ω²) / (1 + τ² ω²). The controller
        v = d - K_P v - K_I ∫ v dt passes high frequencies unchanged but for the gain
        1/(1 + K_P); a minus would turn them over. At 2 Hz the phase shift is 3.8 degrees and
        at 14 Hz 0.5; the print has half of each.

    Args:
        omega: angular frequency ω, rad/s.
        K_P: proportional gain, dimensionless.
        K_I: integral gain, 1/s.

    Returns:
        v_zp / d, dimensionless.
    """
    tau = time_constant(K_P, K_I)
    return (1j * omega + tau * omega**2) / (1 + tau**2 * omega**2) / K_I


def controlled_velocity(
    d: npt.ArrayLike,
    v_xp: npt.ArrayLike,
    dt: Real,
    v_on: float = V_ON,
    K_P: float = K_P,
    K_I: float = K_I,
) -> Signal:
    """Suppress the integrated acceleration at low speed.

    Equation:
        Figure 5.10, while v_xp(t_k) < v_on: v_zp(t_k) = d(t_k) + o - K_P v_zp(t_k) - K_I I(t_k)
        with I(t_k) = I(t_{k-1}) + (Δt/2) (v_zp(t_k) + v_zp(t_{k-1})), I = 0 at the switch to
        control. Otherwise v_zp(t_k) = d(t_k) + o. The offset o is what control has changed up to
        its end, 0 before any: the integration goes on from the controlled value without a step.

    Args:
        d: integrated acceleration, the controller's disturbance, m/s, shape (N,).
        v_xp: speed of travel, m/s, shape (N,).
        dt: sampling period Δt, s.
        v_on: speed below which control acts, m/s.
        K_P: proportional gain, dimensionless.
        K_I: integral gain, 1/s.

    Returns:
        v_zp(t_k), m/s, shape (N,).
    """
    d_t, low = samples(d), [v < v_on for v in samples(v_xp)]
    proportional, gain = np.longdouble(K_P), np.longdouble(K_I)
    half_step = np.longdouble(dt) / 2
    v_zp: Samples = []
    o = integral = ZERO
    for k in range(len(d_t)):
        if not low[k]:
            if k > 0 and low[k - 1]:
                o = v_zp[k - 1] - d_t[k - 1]
            v_zp.append(d_t[k] + o)
        elif k == 0 or not low[k - 1]:
            integral = ZERO
            v_zp.append((d_t[k] + o) / (1 + proportional))
        else:
            known = integral + half_step * v_zp[k - 1]
            left_side = 1 + proportional + gain * half_step
            v_zp.append((d_t[k] + o - gain * known) / left_side)
            integral = known + half_step * v_zp[k]
    return signal(v_zp)


def local_suppression(
    a_zp: npt.ArrayLike,
    h: npt.ArrayLike,
    r_xp: npt.ArrayLike,
    f_s: float,
    dx: float,
    f_3db: float = F_3DB,
    v_on: float = V_ON,
    K_P: float = K_P,
    K_I: float = K_I,
) -> tuple[float, Signal]:
    """Compute a profile by temporal high-pass filtering with local suppression.

    Equation:
        Figure 5.9 with figure 5.10 after the first integration.

    Args:
        a_zp: vertical acceleration with 1 g removed, m/s², shape (N,).
        h: height above the road, m, shape (N,).
        r_xp: travel distance, m, shape (N,), non-decreasing.
        f_s: sampling rate of the three signals, Hz.
        dx: distance interval Δx of the profile, m.
        f_3db: frequency at which the forward and backward passes together lose 3 dB, Hz.
        v_on: speed below which control acts, m/s.
        K_P: proportional gain, dimensionless.
        K_I: integral gain, 1/s.

    Returns:
        Distance of the first point, m, and the spatial profile r_zr(x_k), m.
    """
    points, dt, f_c = trigger(r_xp, dx), 1 / np.longdouble(f_s), high_pass_cut_off(f_3db)
    d = integrated_acceleration(anti_alias(a_zp, f_s), f_c, dt)
    v_zp = controlled_velocity(d, travel_speed(r_xp, f_s), dt, v_on, K_P, K_I)
    r_zp = floating_reference_height(v_zp, f_c, dt)
    r_zr = r_zp - hpf_b3(from_first(anti_alias(h, f_s)), f_c, dt)
    return float(samples(r_xp)[0]), capture(backward_passes(r_zr, f_c, dt), points)
