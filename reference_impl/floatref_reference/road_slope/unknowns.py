"""The unknown vector by names, where it starts, and the ranges that some of it is kept in."""

from typing import NamedTuple

import numpy as np

from floatref_reference.road_slope.symbols import Stretch, Values, Vector
from floatref_reference.road_slope.wheels import road_points

LEAST_GAIN, MOST_GAIN = 0.0005, 0.02
LEAST_CENTRE, MOST_CENTRE = -0.1, 1.1
LEAST_HZ, MOST_HZ = 0.7, 3.0
LEAST_DAMPING, MOST_DAMPING = 0.05, 0.8


class Unknowns(NamedTuple):
    """The parts of the unknown vector, in its order.

    Equation:
        z, s, r, θ, b, κ, λ, H, h_0, ln f, ln ζ

    Attributes:
        elevation: z_j of the road, m, shape (N,).
        slope: s_j of the road, shape (N,).
        height: r_k of the accelerometer, m, shape (K,).
        pitch: θ_k, rad, nose up, shape (K,).
        bias: b_k of the accelerometer, m/s², shape (K,).
        gain: κ, rad per m/s², shape ().
        lean: λ, rad, backward, shape ().
        centre: H, shape ().
        offset: h_0, m, shape ().
        log_hz: ln f, f in Hz, shape ().
        log_damping: ln ζ, shape ().
    """

    elevation: Values
    slope: Values
    height: Values
    pitch: Values
    bias: Values
    gain: Values
    lean: Values
    centre: Values
    offset: Values
    log_hz: Values
    log_damping: Values


def by_name(vector: Values, points: int, nodes: int) -> Unknowns:
    """Take the unknown vector apart.

    Equation:
        2N + 3K + 6 unknowns, in the order of `Unknowns`. Of numpy.arange it is the index of each,
        also in the covariance.

    Args:
        vector: shape (2N + 3K + 6,), or (2N + 3K + 6, m) of m vectors at once.
        points: N of the road.
        nodes: K in time.

    Returns:
        Its parts, which share memory with it.
    """
    z, s, r, theta, b, rest = np.split(vector, np.cumsum([points, points, nodes, nodes, nodes]))
    kappa, lean, centre, offset, log_hz, log_damping = rest
    return Unknowns(z, s, r, theta, b, kappa, lean, centre, offset, log_hz, log_damping)


def as_vector(parts: Unknowns) -> Vector:
    """Put the unknown vector together.

    Equation:
        The inverse of `by_name`

    Args:
        parts: real, of one vector.

    Returns:
        Shape (2N + 3K + 6,).
    """
    return np.concatenate([np.atleast_1d(np.asarray(part, np.float64)) for part in parts])


def start(stretch: Stretch) -> Vector:
    """Return what the first pass begins with.

    Equation:
        κ, λ, H, ln f and ln ζ as before the readings, all else 0

    Args:
        stretch: what is known.

    Returns:
        The unknown vector, shape (2N + 3K + 6,).
    """
    c, K = stretch.constants, len(stretch.readings.place)
    N = road_points(stretch).number
    parts = by_name(np.zeros(2 * N + 3 * K + 6), N, K)
    return as_vector(
        parts._replace(
            gain=np.asarray(c.gain.mean),
            lean=np.asarray(c.lean.mean),
            centre=np.asarray(c.centre.mean),
            log_hz=np.log(c.hz.mean),
            log_damping=np.log(c.damping.mean),
        )
    )


def kept_in_range(parts: Unknowns) -> Unknowns:
    """Keep κ, H, f and ζ in their ranges.

    Equation:
        0.0005 ≤ κ ≤ 0.02, -0.1 ≤ H ≤ 1.1, 0.7 Hz ≤ f ≤ 3 Hz, 0.05 ≤ ζ ≤ 0.8

    Args:
        parts: real.

    Returns:
        All unknowns, of which these four may be changed.
    """
    return parts._replace(
        gain=np.clip(parts.gain, LEAST_GAIN, MOST_GAIN),
        centre=np.clip(parts.centre, LEAST_CENTRE, MOST_CENTRE),
        log_hz=np.clip(parts.log_hz, np.log(LEAST_HZ), np.log(MOST_HZ)),
        log_damping=np.clip(parts.log_damping, np.log(LEAST_DAMPING), np.log(MOST_DAMPING)),
    )
