"""Attitude of the body from an inertial unit and the encoder, and the vertical acceleration.

Gravity shows the angles slowly, the rates show them fast. In bins of some hundredths of a second,
p and q are what gravity says; a smooth line through them gives θ_L and φ_L, about which the sines
are linear and with which the rates of the body become those of the angles. What gravity says less
what the rates integrate to is smoothed by a line once more, and taken back to every sample.

Both lines are local: least squares with Gaussian weights, symmetric in time, so they shift no phase
and a constant bias of a rate, which makes a ramp of the angle, drops out. NaN means missing.
"""

import math
from typing import NamedTuple

import numpy as np

from floatref_reference.chapter_2.section_2_3_1_kinematics import vertical_acceleration_from_body
from floatref_reference.chapter_6.section_6_2_frames import pitch_rate, roll_rate
from floatref_reference.road_prior.lines import between, bins, local_line, whole_bins
from floatref_reference.road_prior.symbols import Matrix, Vector

G = 9.80665
STEEP = 0.5


class Unit(NamedTuple):
    """What one wheel path's accelerometers, the rates and the encoder recorded.

    Equation:
        f = Cᵀ(a + g) and ω of (6.25), in body axes

    Attributes:
        f: specific force along body X, Y and Z, m/s², shape (3, N).
        omega: angular rates about them, rad/s, shape (3, N).
        distance: of the encoder, m, shape (N,).
        dt: time between samples, s.
    """

    f: Matrix
    omega: Matrix
    distance: Vector
    dt: float


class Smoothing(NamedTuple):
    """How the angles are smoothed.

    Equation:
        w = exp(-τ²/(2σ²)) up to 4 σ

    Attributes:
        every: samples of a bin.
        near_s: σ of the line through the angles by gravity, s.
        far_s: σ of the line through its difference to the integrated rates, s.
        patience: number of bins in a row without rates that no line crosses.
    """

    every: int
    near_s: float
    far_s: float
    patience: int


def gravity(unit: Unit, every: int) -> tuple[Vector, Vector]:
    """Compute what gravity says, bin by bin.

    Equation:
        f_x = V' - g s_θ and f_y = V ω_z + g c_θ s_φ of a vehicle that moves along its X axis:
        p = (V' - f_x)/g is s_θ, q = (f_y - V ω_z)/g is c_θ s_φ; V and V' are central differences
        of the distance

    Args:
        unit: the recording.
        every: samples of a bin.

    Returns:
        p and q.
    """
    h = every * unit.dt
    s, x, y, r = (bins(v, every) for v in (unit.distance, unit.f[0], unit.f[1], unit.omega[2]))
    p, q = np.full((2, len(s)), np.nan)
    for b in range(1, len(s) - 1):
        p[b] = ((s[b + 1] - 2 * s[b] + s[b - 1]) / h**2 - x[b]) / G
        q[b] = (y[b] - (s[b + 1] - s[b - 1]) / (2 * h) * r[b]) / G
    return p, q


def slow_angles(p_l: float, q_l: float) -> tuple[float, float]:
    """Compute pitch and roll from what gravity says.

    Equation:
        s_θ = p, c_θ s_φ = q, no more than 30°; level where that is unknown

    Args:
        p_l: smoothed p.
        q_l: smoothed q.

    Returns:
        θ_L and φ_L, rad.
    """
    p_l, q_l = (0.0 if math.isnan(v) else v for v in (p_l, q_l))
    theta = math.asin(min(STEEP, max(-STEEP, p_l)))
    return theta, math.asin(min(STEEP, max(-STEEP, q_l / math.cos(theta))))


def integrated(unit: Unit, slow: list[tuple[float, float]], every: int) -> Matrix:
    """Integrate the rates of the angles from zero.

    Equation:
        (6.27) and (6.28) with the slow angles on the right-hand side, by trapezoids; a rate that is
        missing is that of the sample before

    Args:
        unit: the recording.
        slow: θ_L and φ_L of every bin.
        every: samples of a bin.

    Returns:
        Θ and Φ, rad, shape (2, N).
    """
    angles, latest = np.zeros((2, unit.f.shape[1])), (0.0, 0.0)
    for k in range(unit.f.shape[1]):
        theta, phi = slow[k // every]
        rate = latest
        if not np.isnan(unit.omega[:, k]).any():
            _, omega_y, omega_z = unit.omega[:, k]
            rate = pitch_rate(phi, omega_y, omega_z), roll_rate(theta, phi, unit.omega[:, k])
        for i in (0, 1) if k else ():
            angles[i, k] = angles[i, k - 1] + unit.dt * (latest[i] + rate[i]) / 2
        latest = rate
    return angles


def attitude(unit: Unit, smoothing: Smoothing) -> tuple[Matrix, list[bool]]:
    """Compute the attitude at all samples.

    Equation:
        θ = Θ + line(θ_L + (p - p_L)/c_θ - Θ), φ = Φ + line(φ_L + (q - q_L)/(c_θ c_φ) - Φ), where
        the lines go through bins

    Args:
        unit: the recording.
        smoothing: how.

    Returns:
        θ and φ, rad, shape (2, N), and of every bin whether gravity gives them.
    """
    every, h = smoothing.every, smoothing.every * unit.dt
    gravities = gravity(unit, every)
    always, n = np.zeros(len(gravities[0])), len(gravities[0])
    lines = [
        [local_line(y, b, smoothing.near_s / h, always, math.inf) for b in range(n)]
        for y in gravities
    ]
    slow = [slow_angles(p_l, q_l) for p_l, q_l in zip(*lines, strict=True)]
    fast = integrated(unit, slow, every)
    known_rates = np.sum([bins(row, every) for row in unit.omega], axis=0)
    silent: Vector = np.isnan(known_rates).astype(np.float64)
    angles, known = np.empty_like(fast), [True] * n
    for i, y in enumerate(gravities):
        mean = whole_bins(fast[i], every)
        off = np.empty(n)
        for b, (theta, phi) in enumerate(slow):
            slope = math.cos(theta) * (math.cos(phi) if i else 1.0)
            off[b] = (theta, phi)[i] + (y[b] - lines[i][b]) / slope - mean[b]
            off[b] = math.nan if silent[b] else off[b]
        back = []
        for b in range(n):
            value = local_line(off, b, smoothing.far_s / h, silent, smoothing.patience)
            known[b] = known[b] and not math.isnan(value)
            back.append(-mean[b] if math.isnan(value) else value)
        for k in range(fast.shape[1]):
            angles[i, k] = fast[i, k] + between(back, k, every)
    return angles, known


def level(unit: Unit, smoothing: Smoothing) -> Vector:
    """Compute the vertical acceleration.

    Equation:
        (2.20) a_zp^w = -a_xp^b s_θ + a_yp^b c_θ s_ϕ + (a_zp^b + g) c_θ c_ϕ - g with the attitude;
        a horizontal force that is missing is that of a body at rest

    Args:
        unit: the recording.
        smoothing: how.

    Returns:
        Vertical acceleration, m/s², shape (N,), NaN where that along Z is missing.
    """
    angles, _ = attitude(unit, smoothing)
    found = []
    for k, (theta, phi) in enumerate(angles.T):
        rest = -G * math.sin(theta), G * math.cos(theta) * math.sin(phi)
        x, y = (r if np.isnan(v) else v for v, r in zip(unit.f[:2, k], rest, strict=True))
        up = vertical_acceleration_from_body([x, y, unit.f[2, k] - G], theta, phi)
        found.append(float(up))
    return np.array(found)
