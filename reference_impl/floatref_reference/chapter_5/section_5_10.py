"""5.10 Timer Distortion and Height-Sensor Reflection."""

import numpy as np
import numpy.typing as npt

from floatref_reference.chapter_5.section_5_3 import LAMBDA_C
from floatref_reference.chapter_5.section_5_5 import backward_passes
from floatref_reference.chapter_5.section_5_8 import captured, position
from floatref_reference.chapter_5.section_5_9 import high_passed_height, high_passed_velocity
from floatref_reference.signals import ZERO, Real, Samples, Signal, samples, signal

V_0 = 3.576
BETA = 25.0


def time_step_limit(dx: Real, v_0: Real = V_0) -> np.longdouble:
    """Compute the longest time step of integration.

    Equation:
        (5.7) Δt_0 = Δx / v_0

    Args:
        dx: distance interval Δx of the profile, m.
        v_0: threshold of low speed, m/s.

    Returns:
        Δt_0, s.
    """
    return np.longdouble(dx) / np.longdouble(v_0)


def adjusted_time_step(dt: npt.ArrayLike, dt_0: Real, beta: Real = BETA) -> Signal:
    """Limit the time steps of integration.

    Equation:
        (5.8) Δt_Adj = Δt_0 (1 + Δt/Δt_0 - (1 + (Δt/Δt_0)^β)^(1/β)), as printed: extended
        precision holds the power for steps up to 10^190 times Δt_0 at β = 25.

    Args:
        dt: Δt(x_k) of (5.4), s, shape (K,).
        dt_0: limit Δt_0 of (5.7), s.
        beta: sharpness of the transition β, dimensionless.

    Returns:
        Δt_Adj(x_k), s, shape (K,); 0 where Δt is 0.
    """
    limit, power = np.longdouble(dt_0), np.longdouble(beta)
    adjusted: Samples = []
    for step in samples(dt):
        ratio = step / limit
        adjusted.append(limit * (1 + ratio - (1 + ratio**power) ** (1 / power)))
    return signal(adjusted)


def reflected_position(
    v_zp: npt.ArrayLike, dt_adj: npt.ArrayLike, dt: npt.ArrayLike, h: npt.ArrayLike
) -> Signal:
    """Integrate the vertical velocity and replace the attenuated part by the height.

    Equation:
        (5.9), with the factor 1/2 of the trapezoidal rule missing in print, and with a plus
        where it prints a minus: r_zp has to follow h for r_zp - h to be flat.
        r_zp(x_k) = r_zp(x_{k-1}) + Δt_Adj(x_k) (v_zp(x_k) + v_zp(x_{k-1})) / 2
        + (1 - (Δt_Adj(x_k)/Δt(x_k))²) (h(x_k) - h(x_{k-1})), with r_zp(x_1) = 0.
        Two points at one time, Δt = 0, attenuate nothing.

    Args:
        v_zp: vertical velocity, m/s, shape (K,).
        dt_adj: Δt_Adj(x_k) of (5.8), s, shape (K,).
        dt: Δt(x_k) of (5.4), s, shape (K,).
        h: height as it is subtracted afterwards, m, shape (K,).

    Returns:
        r_zp(x_k), m, shape (K,).
    """
    v_x, h_x = samples(v_zp), samples(h)
    adj_x, dt_x = samples(dt_adj), samples(dt)
    r_zp = [ZERO]
    for k in range(1, len(v_x)):
        integrated = adj_x[k] * (v_x[k] + v_x[k - 1]) / 2
        ratio = adj_x[k] / dt_x[k] if dt_x[k] > 0 else np.longdouble(1)
        reflected = (1 - ratio**2) * (h_x[k] - h_x[k - 1])
        r_zp.append(r_zp[k - 1] + integrated + reflected)
    return signal(r_zp)


def timer_distortion(
    a_zp: npt.ArrayLike,
    h: npt.ArrayLike,
    r_xp: npt.ArrayLike,
    f_s: float,
    dx: float,
    lambda_c: float = LAMBDA_C,
    v_0: float = V_0,
    beta: float = BETA,
) -> tuple[float, Signal]:
    """Compute a profile by spatial high-pass filtering with timer distortion.

    Equation:
        Figure 5.14 with Δt_Adj of (5.8) in (5.5) and (5.6).

    Args:
        a_zp: vertical acceleration with 1 g removed, m/s², shape (N,).
        h: height above the road, m, shape (N,).
        r_xp: travel distance, m, shape (N,), non-decreasing.
        f_s: sampling rate of the three signals, Hz.
        dx: distance interval Δx of the profile, m.
        lambda_c: cut-off wavelength of each third-order pass, m.
        v_0: threshold of low speed of (5.7), m/s.
        beta: sharpness of (5.8), dimensionless.

    Returns:
        Distance of the first point, m, and the spatial profile r_zr(x_k), m.
    """
    a_x, h_x, dt = captured(a_zp, h, r_xp, f_s, dx)
    dt_adj = adjusted_time_step(dt, time_step_limit(dx, v_0), beta)
    v_zp = high_passed_velocity(a_x, dt_adj, lambda_c, dx)
    r_zr = position(v_zp, dt_adj) - high_passed_height(h_x, lambda_c, dx)
    return float(samples(r_xp)[0]), backward_passes(r_zr, 1 / np.longdouble(lambda_c), dx)


def timer_distortion_reflection(
    a_zp: npt.ArrayLike,
    h: npt.ArrayLike,
    r_xp: npt.ArrayLike,
    f_s: float,
    dx: float,
    lambda_c: float = LAMBDA_C,
    v_0: float = V_0,
    beta: float = BETA,
) -> tuple[float, Signal]:
    """Compute a profile by timer distortion with height-sensor reflection.

    Equation:
        Figure 5.14 with Δt_Adj of (5.8) in (5.5), and (5.9) in place of (5.6).

    Args:
        a_zp: vertical acceleration with 1 g removed, m/s², shape (N,).
        h: height above the road, m, shape (N,).
        r_xp: travel distance, m, shape (N,), non-decreasing.
        f_s: sampling rate of the three signals, Hz.
        dx: distance interval Δx of the profile, m.
        lambda_c: cut-off wavelength of each third-order pass, m.
        v_0: threshold of low speed of (5.7), m/s.
        beta: sharpness of (5.8), dimensionless.

    Returns:
        Distance of the first point, m, and the spatial profile r_zr(x_k), m.
    """
    a_x, h_x, dt = captured(a_zp, h, r_xp, f_s, dx)
    dt_adj = adjusted_time_step(dt, time_step_limit(dx, v_0), beta)
    v_zp = high_passed_velocity(a_x, dt_adj, lambda_c, dx)
    height = high_passed_height(h_x, lambda_c, dx)
    r_zr = reflected_position(v_zp, dt_adj, dt, height) - height
    return float(samples(r_xp)[0]), backward_passes(r_zr, 1 / np.longdouble(lambda_c), dx)
