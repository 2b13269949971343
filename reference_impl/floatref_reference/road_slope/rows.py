"""All misfits over their 1-σ, by plain sums over nodes and points.

Each function returns the list of its misfits, each of shape () or, of m unknown vectors at once,
(m,). `misfits` puts all of them together; those of the springs are in `springs`, and of what drifts
or is known before in `priors`.
"""

from math import sqrt

import numpy as np

from floatref_reference.road_slope.constants import Constants
from floatref_reference.road_slope.held import Held
from floatref_reference.road_slope.middles import bent, mean, middles
from floatref_reference.road_slope.priors import (
    bias_rows,
    heave_rows,
    moment_rows,
    nod_rows,
    offset_rows,
    prior_rows,
)
from floatref_reference.road_slope.springs import bounce_rows, pitch_rows
from floatref_reference.road_slope.symbols import Stretch, Values, Vector
from floatref_reference.road_slope.unknowns import Unknowns, by_name
from floatref_reference.road_slope.wheels import passed_over


def height_rows(x: Unknowns, stretch: Stretch) -> list[Values]:
    """Return the misfits of the heights that were read.

    Equation:
        h_k = r_k + l θ_k - z̄_k(0) - η θ_k s̄_k, variance σ_h² + q min(V_k Δ, d)/3
    """
    run, c = stretch.readings, stretch.constants
    road, slope = passed_over(x.elevation, stretch, 0.0), passed_over(x.slope, stretch, 0.0)
    rows = []
    for k in range(len(run.height)):
        if np.isnan(run.height[k]):
            continue
        between = c.road * min(run.speed[k] * c.interval_s, c.spacing_m) / 3
        spot = road[k] + c.sway_m * x.pitch[k] * slope[k]
        height = x.height[k] + stretch.places.lever * x.pitch[k] - spot
        rows.append((run.height[k] - height) / sqrt(c.reading_m**2 + between))
    return rows


def acceleration_sigma(stretch: Stretch, k: int) -> float:
    """Return the 1-σ of the acceleration row of node k, m/s².

    Equation:
        Variance (σ_a² + m (σ_m² - σ_a²))/Δ + (ε F_k)², m the largest of the shares that are
        missing at k-1, k and k+1
    """
    c = stretch.constants
    m = max(stretch.readings.missing[k - 1 : k + 2])
    density = c.acceleration**2 + m * (c.missing_acceleration**2 - c.acceleration**2)
    return sqrt(density / c.interval_s + (c.force_share * stretch.readings.force[k]) ** 2)


def acceleration_rows(x: Unknowns, stretch: Stretch) -> list[Values]:
    """Return the misfits of the vertical acceleration, at the middles.

    Equation:
        D_k(r) = F_k + ⟨a P + g P²/2 - b⟩_k, P = θ + λ
    """
    run, c = stretch.readings, stretch.constants
    added = []
    for k in range(len(run.force)):
        P = x.pitch[k] + x.lean
        added.append(run.along[k] * P + c.gravity / 2 * P**2 - x.bias[k])
    rows = []
    for k in middles(stretch):
        off = bent(x.height, k, c.interval_s) - run.force[k] - mean(added, k)
        rows.append(off / acceleration_sigma(stretch, k))
    return rows


def road_rows(x: Unknowns, c: Constants, intensity: Vector) -> list[Values]:
    """Return the misfits of the road.

    Equation:
        z_{j+1} = z_j + d s_j with √(q d), s_{j+1} = s_j with √(g_j d), s_j = 0 with σ_s √(ℓ/d)

    Args:
        x: unknowns.
        c: constants.
        intensity: g_j, 1/m, shape (N-1,).

    Returns:
        N rows of s_j = 0, and then for each step from j to j + 1 one of z and one of s.
    """
    z, s, d = x.elevation, x.slope, c.spacing_m
    rows = [s[j] / (c.slope * sqrt(c.slope_reach_m / d)) for j in range(len(s))]
    for j in range(len(z) - 1):
        rows.append((z[j + 1] - z[j] - d * s[j]) / sqrt(c.road * d))
        rows.append((s[j + 1] - s[j]) / sqrt(intensity[j] * d))
    return rows


def rows_by_kind(x: Unknowns, stretch: Stretch, held: Held) -> dict[str, list[Values]]:
    """Return all misfits over their 1-σ by kind, in the order of `misfits`.

    Equation:
        Of heights and accelerations, of bounce and pitch with the 1-σ of the pass, of what drifts,
        heave and nod, the road and constants

    Args:
        x: unknowns.
        stretch: what is known.
        held: what the pass holds.
    """
    return {
        "height": height_rows(x, stretch),
        "acceleration": acceleration_rows(x, stretch),
        "bounce": bounce_rows(x, stretch, held.loose),
        "pitch": pitch_rows(x, stretch, held.loose),
        "bias": bias_rows(x, stretch),
        "offset": offset_rows(x, stretch, held),
        "moment": moment_rows(x, stretch, held),
        "heave": heave_rows(x, stretch),
        "nod": nod_rows(x, stretch),
        "road": road_rows(x, stretch.constants, held.intensity),
        "prior": prior_rows(x, stretch.constants),
    }


def misfits(vector: Values, stretch: Stretch, held: Held) -> Values:
    """Return all misfits over their 1-σ.

    Equation:
        All rows of `rows_by_kind`, in its order

    Args:
        vector: unknowns, shape (M,), or (M, m) of m vectors at once.
        stretch: what is known.
        held: what the pass holds.

    Returns:
        Shape (R,), or (R, m).
    """
    x = by_name(vector, len(held.intensity) + 1, len(stretch.readings.place))
    kinds = rows_by_kind(x, stretch, held)
    return np.array([row for rows in kinds.values() for row in rows])
