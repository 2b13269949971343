"""6.4.4 Tuning (Table 6.1), and noise that does not depend on the time step."""

import math

import numpy as np

from floatref_reference.appendix_c.symbols import Vector
from floatref_reference.chapter_6.section_6_3_2_inertial_sensors import G

DT = 1 / 16_000
"""Time step Δt of section 6.5, s."""
DEGREE = math.pi / 180
SIGMA_GPS: tuple[float, float, float, float] = (0.012, 0.03, 0.12 * DEGREE, 0.2 * DEGREE)
"""Table 6.1, measurement: σ_rz (printed there as σ_pz) in m, σ_vz in m/s, σ_θ and σ_φ in rad."""
SIGMA_PROCESS: tuple[float, float, float, float, float, float, float] = (
    6e-4 * G,
    7.7e-3 * DEGREE,
    7.7e-3 * DEGREE,
    0.0,
    5e-8,
    4.2e-6 * DEGREE,
    2.2e-4 * DEGREE,
)
"""Table 6.1, process, in the order of (C.5): σ_a in m/s², σ_ω1, σ_ω2 and σ_ω3 in rad/s, σ_a' in
m/s², σ_ω'1 and σ_ω'2 in rad/s, each per time step of 1/16,000 s.

The random walks are printed in m/s³ and deg/s². (C.6) adds them to a drift in m/s² or rad/s as they
are, with 1 where the others have Δt, so here they are steps of that drift. The time constants
confirm it: with GPS heights, white acceleration noise acts at 0.13 rad/s and the walk at
0.13 rad/s. Were the walk a rate to be multiplied by Δt, or a density in m/s^(5/2), it would act at
0.005 or 0.03 rad/s and tuning it would have had no effect.
"""


def per_step_white(S: float, dt: float) -> float:
    """Convert the density of white noise to the standard deviation of a reading.

    Equation:
        Table 6.1 gives σ per time step. White noise of density S, held over each step as in (6.47),
        adds S² t to the variance of its integral within t if σ = S/√Δt.

    Args:
        S: density, in the unit of the signal per √Hz; S² is two-sided, and S the N_A of (6.53).
        dt: time step Δt, s.

    Returns:
        σ, in the unit of the signal.
    """
    return S / math.sqrt(dt)


def per_step_walk(K: float, dt: float) -> float:
    """Convert the density of a random walk to the standard deviation of a step.

    Equation:
        Table 6.1 gives σ' per time step. With (6.38) and the 1 of (C.6) the variance of a drift
        grows by K² t within t if σ' = K √Δt.

    Args:
        K: density, in the unit of the signal per √s; the K_A of (6.53).
        dt: time step Δt, s.

    Returns:
        σ', in the unit of the signal.
    """
    return K * math.sqrt(dt)


def densities(sigma: tuple[float, ...] = SIGMA_PROCESS, dt: float = DT) -> Vector:
    """Convert the process noise of one time step to densities.

    Equation:
        Table 6.1 at Δt = 1/16,000 s: S = σ √Δt of the accelerometers and gyroscopes,
        K = σ'/√Δt of the random walks. The printed 7.7e-3 deg/s are those of readings at 100 Hz,
        each of which lasts 160 steps, so S here is √160 times less than (6.54).

    Args:
        sigma: standard deviations per step in the order of (C.5), shape (7,).
        dt: time step Δt, s.

    Returns:
        S of a, ω1, ω2, ω3, then K of a, ω1, ω2: m/s²/√Hz, three in rad/s/√Hz, m/s²/√s, two in
        rad/s/√s, shape (7,).
    """
    root = math.sqrt(dt)
    return np.array([*(s * root for s in sigma[:4]), *(s / root for s in sigma[4:])])


def per_step(density: tuple[float, ...] | Vector, dt: float) -> Vector:
    """Convert densities to the process noise of a time step of any length.

    Equation:
        Table 6.1, as `densities`, the other way.

    Args:
        density: S of a, ω1, ω2, ω3, then K of a, ω1, ω2, shape (7,).
        dt: time step Δt, s.

    Returns:
        Standard deviations per step in the order of (C.5), shape (7,).
    """
    white = [per_step_white(float(S), dt) for S in density[:4]]
    walk = [per_step_walk(float(K), dt) for K in density[4:]]
    return np.array([*white, *walk])
