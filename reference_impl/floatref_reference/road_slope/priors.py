"""Misfits of what drifts from node to node, and of what is known before the readings."""

from math import sqrt

import numpy as np

from floatref_reference.road_slope.constants import Constants
from floatref_reference.road_slope.held import Held
from floatref_reference.road_slope.symbols import Stretch, Values, Vector
from floatref_reference.road_slope.unknowns import Unknowns, known_before

STANDING = 0.02
"""V in m/s below which a node stands."""
BOARDING = 1.0 - 1e-9
"""Seconds of standing after which somebody may board, less rounding."""
SETTLED = 3e-3
"""Change of the pitch in rad from which an answer has not settled."""
UNLIKELY = 33.0
"""Sum of twelve squared misfits that one vehicle in a thousand has."""


def bias_rows(x: Unknowns, stretch: Stretch) -> list[Values]:
    """Return the misfits of the bias.

    Equation:
        b_0 = 0 with σ_b0, b_{k+1} = b_k with σ_b √t, t = pause_{k+1}
    """
    c, b, pause = stretch.constants, x.bias, stretch.readings.pause
    rows = [b[0] / c.bias]
    for k in range(len(b) - 1):
        rows.append((b[k + 1] - b[k]) / (c.walk * sqrt(pause[k + 1])))
    return rows


def standing_for(stretch: Stretch) -> Vector:
    """Return how long the vehicle stands at the end of each step from node k to k + 1.

    Equation:
        Sum of pause over this step and those before it, of all of which both nodes have
        V < 0.02 m/s; 0 where one has not

    Args:
        stretch: what is known.

    Returns:
        s, shape (K-1,).
    """
    V, pause = stretch.readings.speed, stretch.readings.pause
    times, time = [], 0.0
    for k in range(len(V) - 1):
        both = V[k] < STANDING and V[k + 1] < STANDING
        time = time + pause[k + 1] if both else 0.0
        times.append(time)
    return np.array(times)


def offset_sigma(stretch: Stretch, held: Held) -> Vector:
    """Return the 1-σ of the offset's steps from node k to k + 1, m.

    Equation:
        Variance σ_o² t, t = pause_{k+1}; (σ_o² t + (o_{k+1} - o_k)²)/2 with the step held where
        the vehicle stands for 1 s

    Args:
        stretch: what is known.
        held: what the pass holds.

    Returns:
        Shape (K-1,).
    """
    times, sigmas = standing_for(stretch), []
    for k in range(len(times)):
        variance = stretch.constants.offset_walk**2 * stretch.readings.pause[k + 1]
        if times[k] >= BOARDING:
            variance = (variance + held.stepped[k] ** 2) / 2
        sigmas.append(sqrt(variance))
    return np.array(sigmas)


def offset_rows(x: Unknowns, stretch: Stretch, held: Held) -> list[Values]:
    """Return the misfits of the height at rest.

    Equation:
        o_0 = 0 with 1 m, o_{k+1} = o_k with the 1-σ of `offset_sigma`
    """
    o, sigma = x.offset, offset_sigma(stretch, held)
    rows = [o[0] / stretch.constants.offset_m]
    for k in range(len(o) - 1):
        rows.append((o[k + 1] - o[k]) / sigma[k])
    return rows


def moment_sigma(stretch: Stretch, held: Held, k: int) -> float:
    """Return the 1-σ of the moment's step from node k to k + 1, m/s².

    Equation:
        Variance σ_μ² t + (0.3 g (β_{k+1} - β_k))², t = pause_{k+1}, β held
    """
    c, t = stretch.constants, stretch.readings.pause[k + 1]
    turned = c.moment_share * c.gravity * (held.beta[k + 1] - held.beta[k])
    return sqrt(c.moment_walk**2 * t + turned**2)


def moment_rows(x: Unknowns, stretch: Stretch, held: Held) -> list[Values]:
    """Return the misfits of the moment.

    Equation:
        μ_0 = 0 with σ_μ0, μ_{k+1} = μ_k with the 1-σ of `moment_sigma`
    """
    mu = x.moment
    rows = [mu[0] / stretch.constants.moment]
    for k in range(len(mu) - 1):
        rows.append((mu[k + 1] - mu[k]) / moment_sigma(stretch, held, k))
    return rows


def heave_rows(x: Unknowns, stretch: Stretch) -> list[Values]:
    """Return the misfits of the heave that the springs do not follow.

    Equation:
        u_k = 0 with σ_u0 + σ_u1 V_k
    """
    c, V = stretch.constants, stretch.readings.speed
    return [x.heave[k] / (c.heave_m + c.heave_speed * V[k]) for k in range(len(V))]


def nod_rows(x: Unknowns, stretch: Stretch) -> list[Values]:
    """Return the misfits of the nod that the springs do not follow.

    Equation:
        n_k = 0 with σ_n0 + σ_n1 V_k
    """
    c, V = stretch.constants, stretch.readings.speed
    return [x.nod[k] / (c.nod_rad + c.nod_speed * V[k]) for k in range(len(V))]


def prior_rows(x: Unknowns, c: Constants) -> list[Values]:
    """Return the misfits of z_0 and of the constants of the vehicle to what was known before.

    Equation:
        (x - mean)/σ, z_0 of 0 and 1 m, the constants in the order of the unknowns
    """
    rows: list[Values] = [x.elevation[0] / c.start_m]
    for name, (mean, sigma) in known_before(c).items():
        rows.append((getattr(x, name) - mean) / sigma)
    return rows


def prior_misfit(x: Unknowns, c: Constants) -> float:
    """Return by how much the unknowns are off what was known of them before, squared.

    Equation:
        Σ ((x - mean)/σ)² over z_0, b_0, o_0, μ_0 and the constants of the vehicle

    Args:
        x: what least squares found.
        c: means and 1-σ.
    """
    starts = x.bias[0] / c.bias, x.offset[0] / c.offset_m, x.moment[0] / c.moment
    return float(sum(misfit**2 for misfit in (*starts, *prior_rows(x, c))))


def is_believed(x: Unknowns, c: Constants, change: float) -> bool:
    """Tell whether an answer is that of a vehicle that there may be.

    Equation:
        The last |Δθ| is below 3 mrad, and `prior_misfit` below 33

    Args:
        x: what least squares found.
        c: means and 1-σ.
        change: the largest |Δθ| of the last pass, rad.
    """
    return change < SETTLED and prior_misfit(x, c) < UNLIKELY
