"""5.8 Basic Spatial Algorithm (figure 5.13)."""

import numpy as np
import numpy.typing as npt

from floatref_reference.appendix_a.filters import hpf_b3x2
from floatref_reference.chapter_5.section_5_3 import LAMBDA_C, anti_alias, capture, trigger
from floatref_reference.signals import Real, Signal, samples, signal


def time_step(t: npt.ArrayLike) -> Signal:
    """Compute the elapsed time between spatial samples.

    Equation:
        (5.4) Δt(x_k) = t(x_k) - t(x_{k-1})

    Args:
        t: time of each spatial sample, s, shape (K,).

    Returns:
        Δt(x_k), s, shape (K,); zero at the first sample, which has no predecessor.
    """
    t_x = samples(t)
    dt = [np.longdouble(0)]
    for k in range(1, len(t_x)):
        dt.append(t_x[k] - t_x[k - 1])
    return signal(dt)


def velocity(a_zp: npt.ArrayLike, dt: npt.ArrayLike, v_1: Real = 0.0) -> Signal:
    """Integrate the vertical acceleration in the distance domain.

    Equation:
        (5.5), with the factor 1/2 of the trapezoidal rule that is missing in print:
        v_zp(x_k) = v_zp(x_{k-1}) + Δt(x_k) (a_zp(x_k) + a_zp(x_{k-1})) / 2

    Args:
        a_zp: vertical acceleration with 1 g removed, m/s², shape (K,).
        dt: Δt(x_k) of (5.4), s, shape (K,).
        v_1: v_zp(x_1), m/s.

    Returns:
        v_zp(x_k), m/s, shape (K,).
    """
    return _trapezoids(a_zp, dt, v_1)


def position(v_zp: npt.ArrayLike, dt: npt.ArrayLike, r_1: Real = 0.0) -> Signal:
    """Integrate the vertical velocity in the distance domain.

    Equation:
        (5.6), with the factor 1/2 of the trapezoidal rule that is missing in print:
        r_zp(x_k) = r_zp(x_{k-1}) + Δt(x_k) (v_zp(x_k) + v_zp(x_{k-1})) / 2

    Args:
        v_zp: vertical velocity, m/s, shape (K,).
        dt: Δt(x_k) of (5.4), s, shape (K,).
        r_1: r_zp(x_1), m.

    Returns:
        r_zp(x_k), m, shape (K,).
    """
    return _trapezoids(v_zp, dt, r_1)


def _trapezoids(x: npt.ArrayLike, dt: npt.ArrayLike, y_1: Real) -> Signal:
    x_x, dt_x = samples(x), samples(dt)
    y = [np.longdouble(y_1)]
    for k in range(1, len(x_x)):
        y.append(y[k - 1] + dt_x[k] * (x_x[k] + x_x[k - 1]) / 2)
    return signal(y)


def captured(
    a_zp: npt.ArrayLike, h: npt.ArrayLike, r_xp: npt.ArrayLike, f_s: Real, dx: float
) -> tuple[Signal, Signal, Signal]:
    """Read the sensors and the clock at each trigger.

    Equation:
        Figure 5.13: anti-alias filter in time, capture of a_zp, h and t, (5.4).

    Args:
        a_zp: vertical acceleration with 1 g removed, m/s², shape (N,).
        h: height above the road, m, shape (N,).
        r_xp: travel distance, m, shape (N,), non-decreasing.
        f_s: sampling rate of the three signals, Hz.
        dx: distance interval Δx of the profile, m.

    Returns:
        a_zp(x_k), m/s², h(x_k), m, and Δt(x_k), s, each of shape (K,).
    """
    points = trigger(r_xp, dx)
    t = np.arange(len(samples(r_xp))) / np.longdouble(f_s)
    a_x = capture(anti_alias(a_zp, f_s), points)
    h_x = capture(anti_alias(h, f_s), points)
    return a_x, h_x, time_step(capture(t, points))


def basic_spatial(
    a_zp: npt.ArrayLike,
    h: npt.ArrayLike,
    r_xp: npt.ArrayLike,
    f_s: float,
    dx: float,
    lambda_c: float = LAMBDA_C,
) -> tuple[float, Signal]:
    """Compute a profile by the basic spatial algorithm.

    Equation:
        Figure 5.13: anti-alias filter in time, capture of a_zp, h and t at each trigger,
        (5.4) to (5.6) with v_zp(x_1) = 0 and r_zp(x_1) = h(x_1), minus height, HPF_B3x2
        at λ_c.

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
    r_zp = position(velocity(a_x, dt), dt, h_x[0])
    r_zr = hpf_b3x2(r_zp - h_x, 1 / np.longdouble(lambda_c), dx)
    return float(samples(r_xp)[0]), r_zr
