"""V.A Simulation Results: the integration of order 4, and a road of the shape of a chirp."""

import math
from collections.abc import Callable

import numpy as np
import numpy.typing as npt

from floatref_reference.imine.section_2_trailer import Matrix, Vector
from floatref_reference.imine.section_4_a_observer import estimator, observer
from floatref_reference.imine.section_4_state_form import StateForm

F_S = 128.0
"""Sampling frequency, Hz."""
POINTS = 2559
"""Points delivered by the memory of the test bench."""


def runge_kutta(f: Callable[[float, Vector], Vector], t: float, w: Vector, h: float) -> Vector:
    """Integrate over one step.

    Equation:
        Section V.A: the algorithm of Runge and Kutta of order 4.

    Args:
        f: derivative dw/dt at (t, w).
        t: time at the start of the step, s.
        w: value there, shape (n,).
        h: step, s.

    Returns:
        w at t + h, shape (n,).
    """
    s_1 = f(t, w)
    s_2 = f(t + h / 2, w + h / 2 * s_1)
    s_3 = f(t + h / 2, w + h / 2 * s_2)
    s_4 = f(t + h, w + h * s_3)
    return w + h / 6 * (s_1 + 2 * s_2 + 2 * s_3 + s_4)


def sub_steps(L: Matrix, dt: float, reach: float = 0.1) -> int:
    """Choose into how many steps to part a sampling period.

    Equation:
        The fewest steps h with |λ| h <= reach for every eigenvalue λ of L of (15). The tyres'
        k_3/B_3 alone is several hundred 1/s, too fast for a step of 1/128 s.

    Args:
        L: composite error matrix, shape (12, 12).
        dt: sampling period, s.
        reach: largest |λ| h; order 4 leaves errors of about its fifth power per step.

    Returns:
        Number of steps, at least 1.
    """
    fastest = float(np.abs(np.linalg.eigvals(L)).max())
    return max(1, math.ceil(fastest * dt / reach))


def observe(
    z_ddot: npt.ArrayLike,
    y: npt.ArrayLike,
    dt: float,
    form: StateForm,
    G: Matrix,
    C_prime: Matrix,
    steps: int,
    w_0: npt.ArrayLike = (0.0,) * 12,
) -> tuple[Matrix, Matrix]:
    """Run observer and estimator over sampled signals.

    Equation:
        (10) and (11) by `runge_kutta`, the signals on straight lines between samples. These lower
        a wave of frequency ω by (ω Δt)²/12, at 128 Hz by 0.5 % at 5 Hz.

    Args:
        z_ddot: accelerations of the wheels, m/s², shape (N, 2).
        y: what is measured of the state, shape (N, nm).
        dt: sampling period, s.
        form: matrices of (8) and (9).
        G: gains, shape (10, nm).
        C_prime: C', shape (nm, 10).
        steps: steps to a sampling period, as `sub_steps` chooses them.
        w_0: x̄_1 and ū at the first sample, shape (12,).

    Returns:
        x̄_1, shape (N, 10), and ū, m, shape (N, 2), at every sample.
    """
    a_k, y_k = np.asarray(z_ddot, np.float64), np.asarray(y, np.float64)
    w = np.asarray(w_0, np.float64)
    run, h = [w], dt / steps
    for k in range(len(a_k) - 1):

        def derivative(t: float, w: Vector, k: int = k) -> Vector:
            a = a_k[k] + t / dt * (a_k[k + 1] - a_k[k])
            y = y_k[k] + t / dt * (y_k[k + 1] - y_k[k])
            x, u = w[:10], w[10:]
            u_dot = estimator(x, u, a, form)
            return np.concatenate([observer(x, u, u_dot, y, form, G, C_prime), u_dot])

        for step in range(steps):
            w = runge_kutta(derivative, step * h, w, h)
        run.append(w)
    return np.array(run)[:, :10], np.array(run)[:, 10:]


def chirp(
    t: float, T: float, amplitude: float = 1e-3, f_0: float = 0.1, f_1: float = 4.0
) -> tuple[float, float]:
    """Evaluate a sine whose frequency rises in proportion to time.

    Equation:
        Figure 5: u = a sin(2π (f_0 t + (f_1 - f_0) t²/(2T))). The error of 5e-6 m is
        0.5 % in print, so a = 1 mm; the frequencies are ours.

    Args:
        t: time, s.
        T: time at which it reaches f_1, s.
        amplitude: a, m.
        f_0: frequency at t = 0, Hz.
        f_1: frequency at T, Hz.

    Returns:
        u in m and u̇ in m/s.
    """
    phase = 2 * math.pi * (f_0 * t + (f_1 - f_0) * t**2 / (2 * T))
    rate = 2 * math.pi * (f_0 + (f_1 - f_0) * t / T)
    return amplitude * math.sin(phase), amplitude * rate * math.cos(phase)
