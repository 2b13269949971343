"""2.3.1 Three Dimensional Kinematics.

Pitch θ comes first, roll ϕ second. s and c abbreviate sine and cosine. The superscript w is the
wander axis system, aligned with gravity and with the vehicle's heading; b is the body.
"""

import numpy as np
import numpy.typing as npt

from floatref_reference.signals import STANDARD_GRAVITY as G
from floatref_reference.signals import Signal


def body_fixed_acceleration(a_w: npt.ArrayLike, theta: npt.ArrayLike, phi: npt.ArrayLike) -> Signal:
    """Compute what body-fixed servo accelerometers measure.

    Equation:
        (2.17) a_xp^b = a_xp^w c_θ - (a_zp^w + g) s_θ
        a_yp^b = a_xp^w s_θ s_ϕ + a_yp^w c_ϕ + (a_zp^w + g) c_θ s_ϕ
        a_zp^b = a_xp^w s_θ c_ϕ - a_yp^w s_ϕ + (a_zp^w + g) c_θ c_ϕ - g

    Args:
        a_w: a_xp^w, a_yp^w, a_zp^w, m/s², shape (3,) or (3, N).
        theta: pitch, rad, nose down positive, scalar or shape (N,).
        phi: roll, rad, left side up positive, scalar or shape (N,).

    Returns:
        a_xp^b, a_yp^b and, with 1 g removed, a_zp^b, m/s², of the shape of a_w.
    """
    a_x, a_y, a_z = np.asarray(a_w, dtype=np.longdouble)
    s_t, c_t, s_p, c_p = _sines(theta, phi)
    return np.array(
        [
            a_x * c_t - (a_z + G) * s_t,
            a_x * s_t * s_p + a_y * c_p + (a_z + G) * c_t * s_p,
            a_x * s_t * c_p - a_y * s_p + (a_z + G) * c_t * c_p - G,
        ]
    )


def body_fixed_height(h_w: npt.ArrayLike, theta: npt.ArrayLike, phi: npt.ArrayLike) -> Signal:
    """Compute the range a height sensor measures above flat, smooth ground.

    Equation:
        (2.18) h^b = h^w / (c_θ c_ϕ)

    Args:
        h_w: vertical height h^w, m, scalar or shape (N,).
        theta: pitch, rad, scalar or shape (N,).
        phi: roll, rad, scalar or shape (N,).

    Returns:
        h^b, m.
    """
    _, c_t, _, c_p = _sines(theta, phi)
    return np.asarray(np.asarray(h_w, dtype=np.longdouble) / (c_t * c_p))


def vertical_acceleration_from_horizontal(
    a_zp_b: npt.ArrayLike,
    a_xp_w: npt.ArrayLike,
    a_yp_w: npt.ArrayLike,
    theta: npt.ArrayLike,
    phi: npt.ArrayLike,
) -> Signal:
    """Correct the vertical acceleration by known horizontal accelerations.

    Equation:
        (2.19) a_zp^w = (a_zp^b + g - a_xp^w s_θ c_ϕ + a_yp^w s_ϕ) / (c_θ c_ϕ) - g

    Args:
        a_zp_b: body-fixed vertical acceleration with 1 g removed, m/s².
        a_xp_w: longitudinal acceleration in wander axes, m/s².
        a_yp_w: lateral acceleration in wander axes, m/s².
        theta: pitch, rad.
        phi: roll, rad.

    Returns:
        a_zp^w, m/s².
    """
    a_z, a_x, a_y = (np.asarray(a, dtype=np.longdouble) for a in (a_zp_b, a_xp_w, a_yp_w))
    s_t, c_t, s_p, c_p = _sines(theta, phi)
    return np.asarray((a_z + G - a_x * s_t * c_p + a_y * s_p) / (c_t * c_p) - G)


def vertical_acceleration_from_body(
    a_b: npt.ArrayLike, theta: npt.ArrayLike, phi: npt.ArrayLike
) -> Signal:
    """Correct the vertical acceleration by all three body-fixed accelerometers.

    Equation:
        (2.20) a_zp^w = -a_xp^b s_θ + a_yp^b c_θ s_ϕ + (a_zp^b + g) c_θ c_ϕ - g

    Args:
        a_b: a_xp^b, a_yp^b and, with 1 g removed, a_zp^b, m/s², shape (3,) or (3, N).
        theta: pitch, rad.
        phi: roll, rad.

    Returns:
        a_zp^w, m/s².
    """
    a_x, a_y, a_z = np.asarray(a_b, dtype=np.longdouble)
    s_t, c_t, s_p, c_p = _sines(theta, phi)
    return np.asarray(-a_x * s_t + a_y * c_t * s_p + (a_z + G) * c_t * c_p - G)


def _sines(theta: npt.ArrayLike, phi: npt.ArrayLike) -> tuple[Signal, Signal, Signal, Signal]:
    t, p = np.asarray(theta, dtype=np.longdouble), np.asarray(phi, dtype=np.longdouble)
    return np.sin(t), np.cos(t), np.sin(p), np.cos(p)
