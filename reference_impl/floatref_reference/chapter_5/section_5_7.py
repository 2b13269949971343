"""5.7 Adaptive High-Pass Filtering (figures 5.11 and 5.12)."""

from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from floatref_reference.appendix_a.varying import (
    hpf_b3s1_varying,
    hpf_b3s1r_varying,
    hpf_b3s2_varying,
    hpf_b3s2r_varying,
)
from floatref_reference.chapter_5.section_5_3 import (
    LAMBDA_C,
    anti_alias,
    capture,
    trapezoidal_rule,
    trigger,
)
from floatref_reference.chapter_5.section_5_5 import from_first
from floatref_reference.chapter_5.section_5_6 import travel_speed
from floatref_reference.signals import Real, Samples, Signal, samples, signal


class Schedule(NamedTuple):
    """Settings of the adaptive cut-off (5.3).

    Args:
        f_ls: cut-off frequency of low-speed operation f_ls, Hz.
        lambda_c: cut-off wavelength of high-speed operation λ_c, m.
        v_0: speed in the middle of the transition, m/s.
        alpha: steepness of the transition α, s/m.
    """

    f_ls: float = 0.45
    lambda_c: float = LAMBDA_C
    v_0: float = 2.778
    alpha: float = 2.5


SCHEDULE = Schedule()


def cut_off_frequency(v_xp: npt.ArrayLike, schedule: Schedule = SCHEDULE) -> Signal:
    """Adapt the cut-off frequency to the speed of travel.

    Equation:
        (5.3) f_c = (f_ls + (v_xp/λ_c) e^(α(v_xp - v_0))) / (1 + e^(α(v_xp - v_0)));
        above v_0 divided through by the exponential, which then cannot overflow.

    Args:
        v_xp: speed of travel, m/s, shape (N,).
        schedule: settings of (5.3).

    Returns:
        f_c(t_k), Hz, shape (N,).
    """
    f_ls, lambda_c, v_0, alpha = (np.longdouble(value) for value in schedule)
    f_c: Samples = []
    for v in samples(v_xp):
        e = np.exp(-alpha * abs(v - v_0))
        low, high = (f_ls, v / lambda_c * e) if v < v_0 else (f_ls * e, v / lambda_c)
        f_c.append((low + high) / (1 + e))
    return signal(f_c)


def cut_off_wave_number(v_xp: npt.ArrayLike, dx: float, schedule: Schedule = SCHEDULE) -> Signal:
    """Convert the adaptive cut-off frequency to a wave number.

    Equation:
        Figure 5.11: the effective cut-off wavelength is v_xp/f_c(v_xp) of (5.3), here at least
        4 Δx, which holds at a stop too.

    Args:
        v_xp: speed stored with each point, m/s, shape (K,).
        dx: distance interval Δx of the profile, m.
        schedule: settings of (5.3).

    Returns:
        1/λ_c(x_k), 1/m, shape (K,).
    """
    shortest = 4 * np.longdouble(dx)
    f_c = samples(cut_off_frequency(v_xp, schedule))
    wavelength = [v / f for v, f in zip(samples(v_xp), f_c, strict=True)]
    return signal([1 / max(value, shortest) for value in wavelength])


def forward_profile(a_zp: npt.ArrayLike, h: npt.ArrayLike, f_c: npt.ArrayLike, f_s: Real) -> Signal:
    """Compute the temporal profile with the forward passes of the adaptive filter.

    Equation:
        Figure 5.12: a_zp through HPF_B3S1, ∫, HPF_B3S2, ∫, minus h through HPF_B3S1, HPF_B3S2,
        with f_c(t_k). Heights count from h(t_1); both integrals start at 0.

    Args:
        a_zp: anti-aliased vertical acceleration with 1 g removed, m/s², shape (N,).
        h: anti-aliased height above the road, m, shape (N,).
        f_c: cut-off frequency at every sample, Hz, shape (N,).
        f_s: sampling rate, Hz.

    Returns:
        r_zr(t_k) before the backward passes, m, shape (N,).
    """
    dt = 1 / np.longdouble(f_s)
    v_zp = trapezoidal_rule(hpf_b3s1_varying(a_zp, f_c, dt), dt)
    r_zp = trapezoidal_rule(hpf_b3s2_varying(v_zp, f_c, dt), dt)
    height = hpf_b3s2_varying(hpf_b3s1_varying(from_first(h), f_c, dt), f_c, dt)
    return r_zp - height


def backward_passes_varying(r_zr: npt.ArrayLike, f_c: npt.ArrayLike, dt: Real) -> Signal:
    """Cancel the phase shift of the forward passes of the adaptive filter.

    Equation:
        Figure 5.12: HPF_B3S2R, then HPF_B3S1R, with the cut-off of each sample.

    Args:
        r_zr: profile after the forward passes, m, shape (N,).
        f_c: cut-off frequency at every sample, Hz (or 1/λ_c, 1/m), shape (N,).
        dt: sampling period Δt, s (or distance interval, m).

    Returns:
        r_zr, m, shape (N,).
    """
    return hpf_b3s1r_varying(hpf_b3s2r_varying(r_zr, f_c, dt), f_c, dt)


def adaptive_high_pass(
    a_zp: npt.ArrayLike,
    h: npt.ArrayLike,
    r_xp: npt.ArrayLike,
    f_s: float,
    dx: float,
    schedule: Schedule = SCHEDULE,
) -> tuple[float, Signal]:
    """Compute a profile by adaptive high-pass filtering.

    Equation:
        Section 5.7: figure 5.9 with f_c(t_k) of (5.3) in every filter stage, forward and
        backward in time; then decimation to Δx.

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
    points, f_c = trigger(r_xp, dx), cut_off_frequency(travel_speed(r_xp, f_s), schedule)
    r_zr = forward_profile(anti_alias(a_zp, f_s), anti_alias(h, f_s), f_c, f_s)
    r_zr = backward_passes_varying(r_zr, f_c, 1 / np.longdouble(f_s))
    return float(samples(r_xp)[0]), capture(r_zr, points)


def adaptive_high_pass_spatial_backward(
    a_zp: npt.ArrayLike,
    h: npt.ArrayLike,
    r_xp: npt.ArrayLike,
    f_s: float,
    dx: float,
    schedule: Schedule = SCHEDULE,
) -> tuple[float, Signal]:
    """Compute a profile by adaptive high-pass filtering with a spatial backward pass.

    Equation:
        Figure 5.12: the forward passes in time with f_c(t_k) of (5.3), decimation of the profile
        and of v_xp to Δx, then HPF_B3S2R, HPF_B3S1R over distance at the effective cut-off
        wavelength of each point.

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
    f_c = cut_off_frequency(v_xp, schedule)
    r_zr = forward_profile(anti_alias(a_zp, f_s), anti_alias(h, f_s), f_c, f_s)
    wave_number = cut_off_wave_number(capture(v_xp, points), dx, schedule)
    r_zr_x = backward_passes_varying(capture(r_zr, points), wave_number, dx)
    return float(samples(r_xp)[0]), r_zr_x
