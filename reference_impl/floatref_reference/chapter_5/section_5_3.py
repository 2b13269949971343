"""5.3 Basic Temporal Algorithm (figure 5.4)."""

import numpy as np
import numpy.typing as npt

from floatref_reference.appendix_a.filters import hpf_b3x2, lpf_b3
from floatref_reference.signals import Real, Samples, Signal, mean, samples, signal

F_C_ANTI_ALIAS = 1000.0
LAMBDA_C = 105.91
TIE = 1e-6


def anti_alias(x: npt.ArrayLike, f_s: Real) -> Signal:
    """Low-pass filter a sensor signal against aliasing.

    Equation:
        Section 5.3: LPF_B3 at 1000 Hz. Left out at 4000 Hz and below, where the cut-off lies
        at half the Nyquist frequency or above and removes next to nothing.

    Args:
        x: sensor signal, shape (N,).
        f_s: sampling rate, Hz.

    Returns:
        Filtered signal, shape (N,), in the unit of x.
    """
    if f_s <= 4 * F_C_ANTI_ALIAS:
        return signal(samples(x))
    return lpf_b3(x, F_C_ANTI_ALIAS, 1 / np.longdouble(f_s))


def trapezoidal_rule(x: npt.ArrayLike, dt: Real, y_1: Real = 0.0) -> Signal:
    """Integrate a signal over time.

    Equation:
        Section 5.3: y(t_k) = y(t_{k-1}) + (Δt/2) (x(t_k) + x(t_{k-1}))

    Args:
        x: signal, shape (N,).
        dt: sampling period Δt, s.
        y_1: the integral's first value y(t_1).

    Returns:
        Integral, shape (N,), in the unit of x times s.
    """
    x_t, half_step = samples(x), np.longdouble(dt) / 2
    y = [np.longdouble(y_1)]
    for k in range(1, len(x_t)):
        y.append(y[k - 1] + half_step * (x_t[k] + x_t[k - 1]))
    return signal(y)


def trigger(r_xp: npt.ArrayLike, dx: float) -> list[tuple[int, np.longdouble]]:
    """Find where travel reaches each point of the profile.

    Equation:
        Section 5.3, decimation by encoder progress: x_k = r_xp(t_1) + k Δx for k = 0, 1, …
        while x_k ≤ r_xp(t_N). Point k takes the first sample i with r_xp(t_i) ≥ x_k. A step
        r_xp(t_i) - r_xp(t_{i-1}) above Δx skips points, so there the fraction of the step at x_k
        is taken. A distance within 1e-6 Δx of a point has reached it: encoder counts and points
        are often the same decimal number, which rounding must not separate.

    Args:
        r_xp: travel distance, m, shape (N,), non-decreasing.
        dx: distance interval Δx of the profile, m.

    Returns:
        For each point the sample index i and the fraction of the step from i-1 to i, 1 being
        sample i itself.

    Raises:
        ValueError: if the interval is not positive or the distance decreases.
    """
    x = np.asarray([float(value) for value in samples(r_xp)])
    if not dx > 0:
        raise ValueError(f"the distance interval must be positive, not {dx}")
    if (np.diff(x) < 0).any():
        raise ValueError("the travel distance decreases")
    points: list[tuple[int, np.longdouble]] = []
    i = 0
    tie = TIE * dx
    while (x_k := x[0] + len(points) * dx) <= x[-1] + tie:
        while x[i] + tie < x_k:
            i += 1
        fraction = np.longdouble(1)
        if i > 0 and x[i] - x[i - 1] > dx + tie and x_k < x[i] - tie:
            fraction = (np.longdouble(x_k) - x[i - 1]) / (np.longdouble(x[i]) - x[i - 1])
        points.append((i, fraction))
    return points


def capture(x: npt.ArrayLike, points: list[tuple[int, np.longdouble]]) -> Signal:
    """Read a time signal at the points of the profile.

    Equation:
        Section 5.3: x(x_k) = x(t_i), or between the two samples linear in distance.

    Args:
        x: signal on the clock of the travel distance, shape (N,).
        points: what `trigger` found.

    Returns:
        Signal at the points, shape (len(points),), in the unit of x.
    """
    x_t = samples(x)
    x_x: Samples = []
    for i, fraction in points:
        if fraction == 1:
            x_x.append(x_t[i])
        else:
            x_x.append(x_t[i - 1] + fraction * (x_t[i] - x_t[i - 1]))
    return signal(x_x)


def temporal_profile(
    a_zp: npt.ArrayLike, h: npt.ArrayLike, f_s: Real, *, mean_removal: bool = False
) -> Signal:
    """Compute the temporal profile from anti-aliased sensor signals.

    Equation:
        Figure 5.4: v_zp = ∫ a_zp dt, r_zp = ∫ v_zp dt, r_zr = r_zp - h. With v_zp(t_1) = 0
        and r_zp(t_1) = h(t_1) the profile starts at zero. Section 5.4 removes the mean of
        a_zp and of v_zp before each integration.

    Args:
        a_zp: vertical acceleration with 1 g removed, m/s², shape (N,).
        h: height above the road, m, shape (N,).
        f_s: sampling rate, Hz.
        mean_removal: whether section 5.4 applies.

    Returns:
        Temporal profile r_zr(t_k), m, shape (N,).
    """
    dt = 1 / np.longdouble(f_s)
    a = signal(samples(a_zp))
    if mean_removal:
        a = a - mean(a)
    v_zp = trapezoidal_rule(a, dt)
    if mean_removal:
        v_zp = v_zp - mean(v_zp)
    height = signal(samples(h))
    r_zp = trapezoidal_rule(v_zp, dt, height[0])
    return r_zp - height


def basic_temporal(
    a_zp: npt.ArrayLike,
    h: npt.ArrayLike,
    r_xp: npt.ArrayLike,
    f_s: float,
    dx: float,
    lambda_c: float = LAMBDA_C,
) -> tuple[float, Signal]:
    """Compute a profile by the basic temporal algorithm.

    Equation:
        Figure 5.4: anti-alias filter, both integrations, minus height, decimation to Δx,
        HPF_B3x2 at λ_c.

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
    r_zr = temporal_profile(anti_alias(a_zp, f_s), anti_alias(h, f_s), f_s)
    r_zr_x = hpf_b3x2(capture(r_zr, points), 1 / np.longdouble(lambda_c), dx)
    return float(samples(r_xp)[0]), r_zr_x
