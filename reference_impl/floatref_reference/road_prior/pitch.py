"""How the body pitches when the vehicle brakes, and what that does to the accelerometer.

With ω = 2π f_p and the damping ratio ζ, the response θ̂ to a_x with a static gain of 1 is

    θ̂'' + 2 ζ ω θ̂' + ω² θ̂ = ω² a_x.

The pitch angle is a multiple of it, θ = κ θ̂ with κ in rad per m/s² and negative, as braking (a_x
negative) lowers the nose (θ positive). (1.5) then reads κ a_x θ̂ for small angles.
"""

import math

import numpy as np
import numpy.typing as npt

from floatref_reference.road_prior.symbols import Vector


def step(
    theta: float, rate: float, a_0: float, a_1: float, dt: float, f_p: float, zeta: float
) -> tuple[float, float]:
    """Advance the pitch response by one sample, exactly for a_x linear in between.

    Equation:
        With s = (a_1 - a_0)/Δt, θ_p(t) = a_0 + s t - 2ζ s/ω solves the equation, and what is left
        decays freely: y = θ̂ - θ_p, ω_d = ω √(1 - ζ²),
        y(t) = e^{-ζωt} (y_0 cos ω_d t + (y'_0 + ζω y_0)/ω_d sin ω_d t) and
        y'(t) = e^{-ζωt} (y'_0 cos ω_d t - (ω² y_0 + ζω y'_0)/ω_d sin ω_d t).

    Args:
        theta: θ̂ at the first sample, m/s².
        rate: θ̂' there, m/s³.
        a_0: a_x there, m/s².
        a_1: a_x at the next sample, m/s².
        dt: time between them, s.
        f_p: natural frequency, Hz.
        zeta: damping ratio ζ.

    Returns:
        θ̂ and θ̂' at the next sample.
    """
    omega, slope = 2 * math.pi * f_p, (a_1 - a_0) / dt
    lag, omega_d = 2 * zeta * slope / omega, omega * math.sqrt(1 - zeta**2)
    y, dy = theta - (a_0 - lag), rate - slope
    cosine, sine = math.cos(omega_d * dt), math.sin(omega_d * dt) / omega_d
    decay = math.exp(-zeta * omega * dt)
    free = decay * (y * cosine + (dy + zeta * omega * y) * sine)
    free_rate = decay * (dy * cosine - (omega**2 * y + zeta * omega * dy) * sine)
    return a_1 - lag + free, slope + free_rate


def pitch_response(
    a_x: npt.ArrayLike,
    t: npt.ArrayLike,
    f_p: float = 1.6,
    zeta: float = 0.3,
    theta_0: float | None = None,
) -> Vector:
    """Compute the pitch response to longitudinal acceleration.

    Equation:
        θ̂'' + 2 ζ ω θ̂' + ω² θ̂ = ω² a_x, ω = 2π f_p, sample by sample as in `step`, from
        θ̂' = 0 at the first.

    Args:
        a_x: longitudinal acceleration, m/s², shape (N,).
        t: time, s, increasing, shape (N,).
        f_p: natural frequency, Hz.
        zeta: damping ratio, 0 to below 1.
        theta_0: θ̂ at the first sample, m/s²; at rest under its a_x if None.

    Returns:
        θ̂, m/s², shape (N,).

    Raises:
        ValueError: unless 0 ≤ ζ < 1 and f_p > 0.
    """
    if not 0 <= zeta < 1 or f_p <= 0:
        raise ValueError(f"no oscillator at {f_p} Hz with a damping ratio of {zeta}")
    a = [float(value) for value in np.asarray(a_x, np.float64)]
    times = [float(value) for value in np.asarray(t, np.float64)]
    theta, rate = a[0] if theta_0 is None else theta_0, 0.0
    response = [theta]
    for k in range(1, len(a)):
        theta, rate = step(theta, rate, a[k - 1], a[k], times[k] - times[k - 1], f_p, zeta)
        response.append(theta)
    return np.array(response)


def tilt_input(a_x: npt.ArrayLike, theta_hat: npt.ArrayLike) -> Vector:
    """Form the input whose κ is the pitch angle per unit of the response.

    Equation:
        (1.5) a_xp sin θ, its leading term: with θ = κ θ̂ and small angles it is κ u, u = a_x θ̂

    Args:
        a_x: longitudinal acceleration, m/s², shape (N,).
        theta_hat: pitch response θ̂, m/s², shape (N,).

    Returns:
        u, m²/s⁴, shape (N,); κ is in rad per m/s².
    """
    return np.multiply(a_x, theta_hat, dtype=np.float64)
