"""All misfits over their 1-σ, by plain sums over nodes and points.

Each function returns the list of its misfits, each of shape () or, of m unknown vectors at once,
(m,). `misfits` puts all of them together.
"""

from math import sqrt

import numpy as np

from floatref_reference.road_slope.swing import swing
from floatref_reference.road_slope.symbols import (
    Constants,
    Prior,
    Stretch,
    Values,
    Vector,
    has_both_sides,
)
from floatref_reference.road_slope.unknowns import Unknowns, by_name
from floatref_reference.road_slope.wheels import (
    height_over_wheels,
    road_at,
    road_points,
    slope_rate,
    slope_under_wheels,
)

BOUNCE = 0.3
"""Seconds that a body bounces."""


def height_rows(x: Unknowns, stretch: Stretch) -> list[Values]:
    """Return the misfits of the heights that were read.

    Equation:
        h_k = r_k + l θ_k - z(x_k), variance σ_h² + q min(V_k Δ, d)/3
    """
    run, c, points = stretch.readings, stretch.constants, road_points(stretch)
    rows = []
    for k in range(len(run.height)):
        if np.isnan(run.height[k]):
            continue
        between = c.road * min(run.speed[k] * c.interval, c.spacing) / 3
        road = road_at(x.elevation, points, run.place[k])
        height = x.height[k] + stretch.places.lever * x.pitch[k] - road
        rows.append((run.height[k] - height) / sqrt(c.read**2 + between))
    return rows


def acceleration_sigma(stretch: Stretch, k: int) -> float:
    """Return the 1-σ of the acceleration row of node k, m/s².

    Equation:
        Variance (σ_a² + p (σ_m² - σ_a²))/Δ + (ε F_k)², p the largest of the shares that are
        missing at k-1, k and k+1
    """
    c = stretch.constants
    p = max(stretch.readings.missing[k - 1 : k + 2])
    density = c.acceleration**2 + p * (c.missing_acceleration**2 - c.acceleration**2)
    return sqrt(density / c.interval + (c.force_share * stretch.readings.force[k]) ** 2)


def acceleration_rows(x: Unknowns, stretch: Stretch) -> list[Values]:
    """Return the misfits of the vertical acceleration, at nodes with both neighbours.

    Equation:
        (r_{k-1} - 2 r_k + r_{k+1})/Δ² = F_k + ⟨a P + g P²/2 - b⟩_k, P = θ + λ,
        ⟨y⟩_k = (y_{k-1} + 4 y_k + y_{k+1})/6
    """
    run, c, r = stretch.readings, stretch.constants, x.height
    rows = []
    for k in range(len(run.force)):
        if not has_both_sides(stretch, k):
            continue
        mean = 0.0
        for i, share in ((k - 1, 1 / 6), (k, 4 / 6), (k + 1, 1 / 6)):
            pitch = x.pitch[i] + x.lean
            mean = mean + share * (run.along[i] * pitch + c.g / 2 * pitch**2 - x.bias[i])
        bent = (r[k - 1] - 2 * r[k] + r[k + 1]) / c.interval**2
        rows.append((bent - run.force[k] - mean) / acceleration_sigma(stretch, k))
    return rows


def slopes_under_wheels(x: Unknowns, stretch: Stretch) -> list[Values]:
    """Return β_k at all nodes, each of shape ()."""
    points = road_points(stretch)
    return [
        slope_under_wheels(x.elevation, points, place, stretch.places)
        for place in stretch.readings.place
    ]


def rolled_over(x: Unknowns, slopes: list[Values], stretch: Stretch, k: int) -> Values:
    """Return what the body follows at node k.

    Equation:
        u = (1 + κ g) β + (2ζ/ω) β̇ + κ a, ω = 2πf
    """
    late = 2 * np.exp(x.log_damping) / (2 * np.pi * np.exp(x.log_hz))
    by_force = x.gain * stretch.readings.along[k]
    rate = slope_rate(slopes, stretch, k)
    u: Values = (1 + x.gain * stretch.constants.g) * slopes[k] + late * rate + by_force
    return u


def swing_rows(x: Unknowns, stretch: Stretch) -> list[Values]:
    """Return the misfits of the oscillator, at nodes with both neighbours.

    Equation:
        θ_{k+1} - T θ_k + D θ_{k-1} = G_0 u_{k-1} + G_1 u_k + G_2 u_{k+1},
        1-σ (σ_s0 + σ_s1 V_k) Δ^{3/2}
    """
    run, c = stretch.readings, stretch.constants
    by = swing(np.exp(x.log_hz), np.exp(x.log_damping), c.interval)
    slopes, rows = slopes_under_wheels(x, stretch), []
    for k in range(len(run.place)):
        if not has_both_sides(stretch, k):
            continue
        u = [rolled_over(x, slopes, stretch, i) for i in (k - 1, k, k + 1)]
        swung = x.pitch[k + 1] - by.trace * x.pitch[k] + by.determinant * x.pitch[k - 1]
        driven = by.before * u[0] + by.now * u[1] + by.after * u[2]
        rows.append((swung - driven) / ((c.swing + c.swing_speed * run.speed[k]) * c.interval**1.5))
    return rows


def even_rows(x: Unknowns, stretch: Stretch) -> list[Values]:
    """Return the misfits of a body on even springs.

    Equation:
        r_k = p_k + (-l - x_f + H L)(θ_k - β_k) + h_0, 1-σ (σ_e0 + σ_e1 V_k) √(0.3 s/Δ)
    """
    (run, at, c), points = stretch, road_points(stretch)
    lever = -at.lever - at.front + x.centre * (at.front - at.rear)
    slopes, rows = slopes_under_wheels(x, stretch), []
    for k in range(len(run.place)):
        line = height_over_wheels(x.elevation, points, run.place[k], at)
        height = line + lever * (x.pitch[k] - slopes[k]) + x.offset
        sigma = (c.even + c.even_speed * run.speed[k]) * sqrt(BOUNCE / c.interval)
        rows.append((x.height[k] - height) / sigma)
    return rows


def bias_rows(x: Unknowns, stretch: Stretch) -> list[Values]:
    """Return the misfits of the bias.

    Equation:
        b_0 = 0 with σ_b0, b_k = b_{k-1} with σ_b √pause_k
    """
    c, b = stretch.constants, x.bias
    rows = [b[0] / c.bias]
    for k in range(1, len(b)):
        rows.append((b[k] - b[k - 1]) / (c.walk * sqrt(stretch.readings.pause[k])))
    return rows


def road_rows(x: Unknowns, c: Constants, intensity: Vector) -> list[Values]:
    """Return the misfits of the road.

    Equation:
        z_{j+1} = z_j + d s_j with √(q d), s_{j+1} = s_j with √(g_j d), s_j = 0 with σ_s √(ℓ/d)

    Args:
        x: unknowns.
        c: constants.
        intensity: g_j, 1/m, shape (N-1,).
    """
    z, s, d = x.elevation, x.slope, c.spacing
    rows = [s[j] / (c.slope * sqrt(c.slope_reach / d)) for j in range(len(s))]
    for j in range(len(z) - 1):
        rows.append((z[j + 1] - z[j] - d * s[j]) / sqrt(c.road * d))
        rows.append((s[j + 1] - s[j]) / sqrt(intensity[j] * d))
    return rows


def prior_rows(x: Unknowns, c: Constants) -> list[Values]:
    """Return the misfits of z_0, κ, λ, H, h_0, ln f and ln ζ to what was known before.

    Equation:
        (x - mean)/σ; the means of ln f and ln ζ are ln f_0 and ln ζ_0
    """
    pairs = [
        (x.elevation[0], Prior(0.0, c.start_height)),
        (x.gain, c.gain),
        (x.lean, c.lean),
        (x.centre, c.centre),
        (x.offset, Prior(0.0, c.offset)),
        (x.log_hz, Prior(np.log(c.hz.mean), c.hz.sigma)),
        (x.log_damping, Prior(np.log(c.damping.mean), c.damping.sigma)),
    ]
    return [(value - prior.mean) / prior.sigma for value, prior in pairs]


def misfits(vector: Values, stretch: Stretch, intensity: Vector) -> Values:
    """Return all misfits over their 1-σ.

    Equation:
        Of heights, accelerations, swing, even springs, bias, road and constants, in this order

    Args:
        vector: unknowns, shape (M,), or (M, m) of m vectors at once.
        stretch: what is known.
        intensity: g_j, 1/m, shape (N-1,).

    Returns:
        Shape (R,), or (R, m).
    """
    x = by_name(vector, len(intensity) + 1, len(stretch.readings.place))
    rows = height_rows(x, stretch) + acceleration_rows(x, stretch) + swing_rows(x, stretch)
    rows += even_rows(x, stretch) + bias_rows(x, stretch)
    rows += road_rows(x, stretch.constants, intensity) + prior_rows(x, stretch.constants)
    return np.array(rows)
