"""The body as an oscillator that rolls over the road, exactly over three nodes."""

from typing import NamedTuple

import numpy as np

from floatref_reference.road_slope.symbols import Values


class Swing(NamedTuple):
    """Coefficients of the oscillator over Δ.

    Equation:
        θ_{k+1} - T θ_k + D θ_{k-1} = G_0 u_{k-1} + G_1 u_k + G_2 u_{k+1}

    Attributes:
        trace: T of the transition matrix of θ and θ' over Δ.
        determinant: D of it.
        before: G_0.
        now: G_1.
        after: G_2.
    """

    trace: Values
    determinant: Values
    before: Values
    now: Values
    after: Values


def line_from_rest(hz: Values, damping: Values, t: float) -> Values:
    """Return the answer to u = t, which begins at rest at t = 0.

    Equation:
        θ(t) = t - c + e^{-ζωt} (c cos ω_d t + ((ζωc - 1)/ω_d) sin ω_d t),
        c = 2ζ/ω, ω_d = ω √(1 - ζ²)

    Args:
        hz: f, Hz.
        damping: ζ, below 1.
        t: time, s.

    Returns:
        θ(t) for a slope of u of 1 rad/s, s.
    """
    omega = 2 * np.pi * hz
    free, late = omega * np.sqrt(1 - damping**2), 2 * damping / omega
    cosine, sine = np.cos(free * t), np.sin(free * t)
    swung = late * cosine + (damping * omega * late - 1) / free * sine
    answer: Values = t - late + np.exp(-damping * omega * t) * swung
    return answer


def swing(hz: Values, damping: Values, interval: float) -> Swing:
    """Return the coefficients of three nodes of θ'' + 2ζω θ' + ω² θ = ω² u, u linear between.

    Equation:
        T = 2 e^{-ζωΔ} cos ω_d Δ, D = e^{-2ζωΔ}. With θ_{k-1} and θ_k 0 and u 0 until the node k,
        G_2 = θ(Δ)/Δ of `line_from_rest`. θ = 1 answers u = 1 and θ = t - c answers u = t, so
        G_0 + G_1 + G_2 = 1 - T + D and Δ (G_2 - G_0) = Δ (1 - D) - c (1 - T + D)

    Args:
        hz: f, Hz.
        damping: ζ, below 1.
        interval: Δ, s.
    """
    omega = 2 * np.pi * hz
    decay = np.exp(-damping * omega * interval)
    trace = 2 * decay * np.cos(omega * np.sqrt(1 - damping**2) * interval)
    determinant, late = decay**2, 2 * damping / omega
    rest = 1 - trace + determinant
    after = line_from_rest(hz, damping, interval) / interval
    before = after - (1 - determinant) + late / interval * rest
    return Swing(trace, determinant, before, rest - before - after, after)
