"""The unknown vector by names, where it starts, and the ranges that some of it has to be in."""

from typing import NamedTuple

import numpy as np

from floatref_reference.road_slope.constants import Constants
from floatref_reference.road_slope.symbols import Stretch, Values, Vector
from floatref_reference.road_slope.wheels import road_points

GAINS = 0.0005, 0.02
CENTRES = -0.1, 1.1
STIFFNESSES = 6.0, 200.0
DAMPINGS = 0.1, 20.0
GYRATIONS = 0.4, 1.6
OF_NODES, SCALARS = 7, 8


class Unknowns(NamedTuple):
    """The parts of the unknown vector, in its order.

    Equation:
        z, s, r, θ, b, u, n, o, μ, κ, λ, H, ln K_f, ln K_r, ln C_f, ln C_r, ln γ

    Attributes:
        elevation: z_j of the road, m, shape (N,).
        slope: s_j of the road, shape (N,).
        height: r_k of the accelerometer, m, shape (K,).
        pitch: θ_k, rad, nose up, shape (K,).
        bias: b_k of the accelerometer, m/s², shape (K,).
        heave: u_k that the springs do not follow, m, shape (K,).
        nod: n_k, the same in pitch, rad, shape (K,).
        offset: o_k, height over the road at rest, m, shape (K,).
        moment: μ_k that pitches beside acceleration and gravity, m/s², shape (K,).
        gain: κ, rad per m/s², shape ().
        lean: λ, rad, backward, shape ().
        centre: H, shape ().
        log_front: ln K_f, K_f in 1/s², shape ().
        log_rear: ln K_r, K_r in 1/s², shape ().
        log_front_damping: ln C_f, C_f in 1/s, shape ().
        log_rear_damping: ln C_r, C_r in 1/s, shape ().
        log_gyration: ln γ, shape ().
    """

    elevation: Values
    slope: Values
    height: Values
    pitch: Values
    bias: Values
    heave: Values
    nod: Values
    offset: Values
    moment: Values
    gain: Values
    lean: Values
    centre: Values
    log_front: Values
    log_rear: Values
    log_front_damping: Values
    log_rear_damping: Values
    log_gyration: Values


def how_many(points: int, nodes: int) -> int:
    """Return how many unknowns there are.

    Equation:
        M = 2N + 7K + 8

    Args:
        points: N of the road.
        nodes: K in time.
    """
    return 2 * points + OF_NODES * nodes + SCALARS


def by_name(vector: Values, points: int, nodes: int) -> Unknowns:
    """Take the unknown vector apart.

    Equation:
        2N + 7K + 8 unknowns, in the order of `Unknowns`. Of numpy.arange it is the index of each,
        also in the covariance.

    Args:
        vector: shape (M,), or (M, m) of m vectors at once.
        points: N of the road.
        nodes: K in time.

    Returns:
        Its parts, which share memory with it.
    """
    sizes = [points, points] + [nodes] * OF_NODES
    *parts, scalars = np.split(vector, np.cumsum(sizes))
    return Unknowns(*parts, *scalars)


def as_vector(parts: Unknowns) -> Vector:
    """Put the unknown vector together.

    Equation:
        The inverse of `by_name`

    Args:
        parts: real, of one vector.

    Returns:
        Shape (M,).
    """
    return np.concatenate([np.atleast_1d(np.asarray(part, np.float64)) for part in parts])


def known_before(c: Constants) -> dict[str, tuple[float, float]]:
    """Return mean and 1-σ of the constants of a vehicle before the readings, by name, in order.

    Equation:
        K of ½ ω_0² γ_0² and C of ζ_0 ω_0 γ_0², ω_0 = 2π f_0: a body of even springs pitches so

    Args:
        c: constants.
    """
    omega = 2 * np.pi * c.hz
    stiffness = float(np.log(omega**2 * c.gyration**2 / 2)), c.stiffness_sigma
    damping = float(np.log(c.damping * omega * c.gyration**2)), c.damping_sigma
    return {
        "gain": (c.gain, c.gain_sigma),
        "lean": (c.lean_rad, c.lean_sigma_rad),
        "centre": (c.centre, c.centre_sigma),
        "log_front": stiffness,
        "log_rear": stiffness,
        "log_front_damping": damping,
        "log_rear_damping": damping,
        "log_gyration": (float(np.log(c.gyration)), c.gyration_sigma),
    }


def start(stretch: Stretch) -> Vector:
    """Return what the first pass begins with.

    Equation:
        The constants of the vehicle as before the readings, all else 0

    Args:
        stretch: what is known.

    Returns:
        The unknown vector, shape (M,).
    """
    means = [mean for mean, _ in known_before(stretch.constants).values()]
    others = how_many(road_points(stretch).number, len(stretch.readings.place)) - SCALARS
    return np.concatenate([np.zeros(others), means])


def kept_in_range(parts: Unknowns) -> Unknowns:
    """Keep κ, H, K, C and γ in their ranges.

    Equation:
        0.0005 ≤ κ ≤ 0.02, -0.1 ≤ H ≤ 1.1, 6 ≤ K ≤ 200, 0.1 ≤ C ≤ 20, 0.4 ≤ γ ≤ 1.6

    Args:
        parts: real.

    Returns:
        All unknowns, of which these seven may be changed.
    """
    K, C = np.log(STIFFNESSES), np.log(DAMPINGS)
    return parts._replace(
        gain=np.clip(parts.gain, *GAINS),
        centre=np.clip(parts.centre, *CENTRES),
        log_front=np.clip(parts.log_front, *K),
        log_rear=np.clip(parts.log_rear, *K),
        log_front_damping=np.clip(parts.log_front_damping, *C),
        log_rear_damping=np.clip(parts.log_rear_damping, *C),
        log_gyration=np.clip(parts.log_gyration, *np.log(GYRATIONS)),
    )
