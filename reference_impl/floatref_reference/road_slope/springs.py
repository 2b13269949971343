"""The body as a half car on two springs: the misfits of its bounce and its pitch."""

from math import sqrt
from typing import NamedTuple

import numpy as np

from floatref_reference.road_slope.along import jolts, sharp_acceleration
from floatref_reference.road_slope.middles import bent, mean, middles, rate
from floatref_reference.road_slope.symbols import Places, Stretch, Values
from floatref_reference.road_slope.unknowns import Unknowns
from floatref_reference.road_slope.wheels import passed_over, slopes_under_wheels


class HalfCar(NamedTuple):
    """The body over its mass, each of shape () or (m,).

    Equation:
        a_f = H L, a_r = (1 - H) L, c = d_f - H L, ρ = γ L/2

    Attributes:
        front: K_f, 1/s².
        rear: K_r, 1/s².
        front_damping: C_f, 1/s.
        rear_damping: C_r, 1/s.
        to_front: a_f from the centre of gravity to the front axle, m.
        to_rear: a_r from the rear axle to the centre of gravity, m.
        ahead: c of the centre of gravity ahead of the accelerometer, m.
        radius: ρ of gyration, m.
    """

    front: Values
    rear: Values
    front_damping: Values
    rear_damping: Values
    to_front: Values
    to_rear: Values
    ahead: Values
    radius: Values


def half_car(x: Unknowns, at: Places) -> HalfCar:
    """Return the body that the unknowns describe.

    Args:
        x: unknowns.
        at: places of axles and accelerometer.
    """
    L = at.front - at.rear
    return HalfCar(
        front=np.exp(x.log_front),
        rear=np.exp(x.log_rear),
        front_damping=np.exp(x.log_front_damping),
        rear_damping=np.exp(x.log_rear_damping),
        to_front=x.centre * L,
        to_rear=(1 - x.centre) * L,
        ahead=at.lever + at.front - x.centre * L,
        radius=np.exp(x.log_gyration) * L / 2,
    )


def compressions(x: Unknowns, stretch: Stretch, axle: float) -> list[Values]:
    """Return how far the springs of an axle are compressed.

    Equation:
        δ_k = z̄_k(x_i) - r_k - d_i θ_k + o_k, d_i = l + x_i

    Args:
        x: unknowns.
        stretch: what is known.
        axle: x_i, ahead of the laser, m.

    Returns:
        δ_k at all K nodes, m.
    """
    road, ahead = passed_over(x.elevation, stretch, axle), stretch.places.lever + axle
    nodes = range(len(road))
    return [road[k] - x.height[k] - ahead * x.pitch[k] + x.offset[k] for k in nodes]


def pushes(
    x: Unknowns, stretch: Stretch, axle: float, stiffness: Values, damping: Values
) -> list[Values]:
    """Return what the springs of an axle push the body with, over its mass.

    Equation:
        φ_i = K_i ⟨δ_i⟩ + C_i ⟨δ̇_i⟩

    Args:
        x: unknowns.
        stretch: what is known.
        axle: x_i, ahead of the laser, m.
        stiffness: K_i, 1/s².
        damping: C_i, 1/s.

    Returns:
        φ_i at the middles, m/s².
    """
    delta, interval = compressions(x, stretch, axle), stretch.constants.interval_s
    return [
        stiffness * mean(delta, k) + damping * rate(delta, k, interval) for k in middles(stretch)
    ]


def pushes_of_both(x: Unknowns, stretch: Stretch) -> list[tuple[int, Values, Values]]:
    """Return the middles k with φ_f and φ_r in m/s²."""
    body, at = half_car(x, stretch.places), stretch.places
    front = pushes(x, stretch, at.front, body.front, body.front_damping)
    rear = pushes(x, stretch, at.rear, body.rear, body.rear_damping)
    return list(zip(middles(stretch), front, rear, strict=True))


def bounce_rows(x: Unknowns, stretch: Stretch, loose: float = 1.0) -> list[Values]:
    """Return the misfits of the bounce, at the middles.

    Equation:
        D_k(r) + c D_k(θ) - φ_f - φ_r - D_k(u), variance (σ_v0 + σ_v1 V_k)²/Δ + (ι_v J_k)²

    Args:
        x: unknowns.
        stretch: what is known.
        loose: factor of the 1-σ.
    """
    c, interval, jolt = stretch.constants, stretch.constants.interval_s, jolts(stretch)
    ahead, rows = half_car(x, stretch.places).ahead, []
    for k, front, rear in pushes_of_both(x, stretch):
        lifted = bent(x.height, k, interval) + ahead * bent(x.pitch, k, interval)
        density = c.bounce + c.bounce_speed * stretch.readings.speed[k]
        sigma = sqrt(density**2 / interval + (c.jolt_bounce * jolt[k]) ** 2)
        rows.append((lifted - front - rear - bent(x.heave, k, interval)) / (loose * sigma))
    return rows


def moment_per_force(x: Unknowns, at: Places) -> Values:
    """Return what a specific force along the road turns the body by.

    Equation:
        M = κ L²/(ρ² (1/K_f + 1/K_r))

    Args:
        x: unknowns.
        at: places of axles and accelerometer.

    Returns:
        M, rad/s² per m/s², shape () or (m,).
    """
    body, L = half_car(x, at), at.front - at.rear
    M: Values = x.gain * L**2 / (body.radius**2 * (1 / body.front + 1 / body.rear))
    return M


def pitch_rows(x: Unknowns, stretch: Stretch, loose: float = 1.0) -> list[Values]:
    """Return the misfits of the pitch, at the middles.

    Equation:
        D_k(θ) - (H L/ρ²) φ_f + ((1 - H) L/ρ²) φ_r - M (ã_k + g ⟨β⟩_k + ⟨μ⟩_k) - D_k(n),
        variance (σ_p0 + σ_p1 V_k)²/Δ + (ι_p J_k)²

    Args:
        x: unknowns.
        stretch: what is known.
        loose: factor of the 1-σ.
    """
    c, interval, jolt = stretch.constants, stretch.constants.interval_s, jolts(stretch)
    body, M = half_car(x, stretch.places), moment_per_force(x, stretch.places)
    beta, sharp = slopes_under_wheels(x.elevation, stretch), sharp_acceleration(stretch)
    rows = []
    for k, front, rear in pushes_of_both(x, stretch):
        turned = (body.to_front * front - body.to_rear * rear) / body.radius**2
        force = sharp[k] + c.gravity * mean(beta, k) + mean(x.moment, k)
        free = bent(x.pitch, k, interval) - bent(x.nod, k, interval)
        density = c.swing + c.swing_speed * stretch.readings.speed[k]
        sigma = sqrt(density**2 / interval + (c.jolt_pitch * jolt[k]) ** 2)
        rows.append((free - turned - M * force) / (loose * sigma))
    return rows
