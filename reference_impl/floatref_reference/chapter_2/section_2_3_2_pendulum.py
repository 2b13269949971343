"""2.3.2 Theoretical Demonstration: the inverted pendulum on a trolley (figure 2.16).

The text names the host vehicle's constants without their values. `HOST_VEHICLE` is a van of
ordinary size, tuned so that a 0.4-g pulse of one second draws the height sensor about 50 mm
closer to the road, as figure 2.20 shows.
"""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from floatref_reference.signals import PI, Signal, samples, signal
from floatref_reference.signals import STANDARD_GRAVITY as G


class Pendulum(NamedTuple):
    """Constants of the host vehicle.

    Args:
        m: mass, kg.
        h_rc: rotation center height, m.
        L_cm: center of mass above the rotation center, m.
        k_r: rotational stiffness, N·m/rad.
        c_r: rotational damping, N·m·s/rad.
        h_p: profiler above the rotation center, m.
        l_p: profiler ahead of the rotation center, m.
    """

    m: float
    h_rc: float
    L_cm: float
    k_r: float
    c_r: float
    h_p: float
    l_p: float


HOST_VEHICLE = Pendulum(m=2500.0, h_rc=0.2, L_cm=0.8, k_r=4.1e5, c_r=1.25e4, h_p=0.1, l_p=2.3)


class Response(NamedTuple):
    """Motion of the pendulum and signals at the profiler reference point.

    Args:
        t: time, s, shape (N,).
        theta: alignment angle θ, nose down positive, rad.
        x: trolley displacement, m.
        a_xp_b: longitudinal acceleration along the body axis (2.23), m/s².
        a_zp_b: vertical acceleration along the body axis (2.24), m/s².
        a_xp_w: true longitudinal acceleration, m/s².
        a_zp_w: true vertical acceleration, m/s².
        h_b: height-sensor signal (2.25), m.
        h_w: true height of the profiler reference point (2.21), m.
    """

    t: Signal
    theta: Signal
    x: Signal
    a_xp_b: Signal
    a_zp_b: Signal
    a_xp_w: Signal
    a_zp_w: Signal
    h_b: Signal
    h_w: Signal


def deceleration_pulse(
    t: np.longdouble, a_xpeak: float = 0.4, T: float = 1.0, t_s: float = 2.0
) -> np.longdouble:
    """Evaluate the trolley's longitudinal acceleration.

    Equation:
        (2.26), mended: d²x/dt² = -a_xpeak sin²(π (t - t_s)/T) for t_s ≤ t ≤ t_s + T, else 0.
        The sine that is printed has no net change of speed; the squared one of half the
        frequency takes 22 m/s to 20 m/s as in figure 2.21.

    Args:
        t: time, s.
        a_xpeak: peak deceleration, in units of g.
        T: duration of the pulse, s.
        t_s: start time, s.

    Returns:
        d²x/dt², m/s².
    """
    if not t_s <= t <= t_s + T:
        return np.longdouble(0)
    return np.longdouble(-a_xpeak * G * np.sin(PI * (t - t_s) / T) ** 2)


def angular_acceleration(
    theta: np.longdouble, theta_dot: np.longdouble, x_ddot: np.longdouble, vehicle: Pendulum
) -> np.longdouble:
    """Evaluate the equation of motion of the alignment angle.

    Equation:
        (2.22) θ'' = g s_θ/L_cm - k_r θ/(m L_cm²) - c_r θ'/(m L_cm²) - x'' c_θ/L_cm

    Args:
        theta: alignment angle θ, rad.
        theta_dot: θ', rad/s.
        x_ddot: trolley acceleration x'', m/s².
        vehicle: constants of the host vehicle.

    Returns:
        θ'', rad/s².
    """
    L_cm, inertia = vehicle.L_cm, vehicle.m * vehicle.L_cm**2
    spring = (vehicle.k_r * theta + vehicle.c_r * theta_dot) / inertia
    return np.longdouble(G * np.sin(theta) / L_cm - spring - x_ddot * np.cos(theta) / L_cm)


def simulate(
    duration: float,
    dt: float,
    v_0: float,
    x_ddot: Callable[[np.longdouble], np.longdouble] = deceleration_pulse,
    vehicle: Pendulum = HOST_VEHICLE,
) -> Response:
    """Simulate the trolley from rest relative to the road's vertical.

    Equation:
        (2.22) by the classical fourth-order Runge-Kutta method.

    Args:
        duration: simulated time, s.
        dt: time step, s.
        v_0: initial speed, m/s.
        x_ddot: trolley acceleration x'' over time, m/s².
        vehicle: constants of the host vehicle.

    Returns:
        Motion and signals at every step, shape (N,) each.
    """
    step = np.longdouble(dt)
    state = np.array([0, 0, 0, v_0], dtype=np.longdouble)

    def rates(t: np.longdouble, y: Signal) -> Signal:
        return np.array(
            [y[1], angular_acceleration(y[0], y[1], x_ddot(t), vehicle), y[3], x_ddot(t)]
        )

    t = [k * step for k in range(round(duration / dt) + 1)]
    states = [state]
    for t_k in t[:-1]:
        k_1 = rates(t_k, state)
        k_2 = rates(t_k + step / 2, state + step / 2 * k_1)
        k_3 = rates(t_k + step / 2, state + step / 2 * k_2)
        k_4 = rates(t_k + step, state + step * k_3)
        state = state + step / 6 * (k_1 + 2 * k_2 + 2 * k_3 + k_4)
        states.append(state)
    theta, theta_dot, x, _ = np.array(states).T
    pushes = [x_ddot(t_k) for t_k in t]
    theta_ddot = [
        angular_acceleration(*state, vehicle)
        for state in zip(theta, theta_dot, pushes, strict=True)
    ]
    return profiler_signals(signal(t), theta, theta_dot, theta_ddot, x, pushes, vehicle)


def profiler_signals(
    t: Signal,
    theta: Signal,
    theta_dot: Signal,
    theta_ddot: npt.ArrayLike,
    x: Signal,
    x_ddot: npt.ArrayLike,
    vehicle: Pendulum,
) -> Response:
    """Derive the signals at the profiler reference point from the motion.

    Equation:
        (2.23) a_xp^b = x'' c_θ + h_p θ'' - l_p θ'²
        (2.24) a_zp^b = x'' s_θ - h_p θ'² - l_p θ''
        (2.25) h^b = (h_rc + h_p c_θ - l_p s_θ) / c_θ, and (2.21) h^w = h^b c_θ
        a_xp^w = a_xp^b c_θ + a_zp^b s_θ, a_zp^w = -a_xp^b s_θ + a_zp^b c_θ. These hold no
        gravity; (2.17) turns the last two into accelerometer readings.

    Args:
        t: time, s, shape (N,).
        theta: θ, rad, shape (N,).
        theta_dot: θ', rad/s, shape (N,).
        theta_ddot: θ'', rad/s², shape (N,).
        x: trolley displacement, m, shape (N,).
        x_ddot: trolley acceleration, m/s², shape (N,).
        vehicle: constants of the host vehicle.

    Returns:
        Motion and signals, shape (N,) each.
    """
    push, spin = signal(samples(x_ddot)), signal(samples(theta_ddot))
    s_t, c_t = signal(np.sin(theta)), signal(np.cos(theta))
    a_xp_b = push * c_t + vehicle.h_p * spin - vehicle.l_p * theta_dot**2
    a_zp_b = push * s_t - vehicle.h_p * theta_dot**2 - vehicle.l_p * spin
    a_xp_w = a_xp_b * c_t + a_zp_b * s_t
    a_zp_w = -a_xp_b * s_t + a_zp_b * c_t
    h_w = vehicle.h_rc + vehicle.h_p * c_t - vehicle.l_p * s_t
    return Response(t, theta, x, a_xp_b, a_zp_b, a_xp_w, a_zp_w, h_w / c_t, h_w)
