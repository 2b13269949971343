"""Q of (12) of Zhu: disturbances of a model besides the forces of its tyres, in one step."""

from collections.abc import Mapping
from math import ceil, isfinite, log2, pi

import numpy as np

from floatref.errors import InputError
from floatref.values.arrays import FloatArray
from floatref.vehicle_response.models.model import VehicleModel
from floatref.vehicle_response.models.state_space import Hold, discretize, state_space

CLASSES = "ABCDEFGH"
CLASS_A = 16e-6
"""Geometric mean of G_q(n0) of class A of ISO 8608, in m³; each class has four times the last."""
REFERENCE_WAVE_NUMBER = 0.1
"""n0 of (14) of Zhu, in cycles/m."""


def disturbance_of(
    model: VehicleModel, step_s: float, densities: Mapping[str, float]
) -> FloatArray:
    """Return Q, shape (2n, 2n), of white forces on freedoms, exact over ``step_s``.

    ``densities`` has the force on each freedom by name, in N/√Hz, or N·m/√Hz for an angle; white
    noise of density S has the standard deviation S·√f when sampled at f. The others have no force.
    Raises InputError for an unknown freedom, a density that is negative or not finite, or a step
    that is not above zero.
    """
    discretize(model, step_s)
    size = len(model.freedoms)
    squares = np.zeros(size)
    for name, density in densities.items():
        if not (isfinite(density) and density >= 0):
            raise InputError(
                f"model {model.name}: the density of the force on the {name} is {density:g}; "
                "give a finite number, zero or above, in N/√Hz or N·m/√Hz"
            )
        squares[model.index(name)] = density**2
    a, _ = state_space(model)
    accelerated = np.linalg.inv(model.mass)
    # In velocities of m per step the exponent is small.
    scale = np.repeat([1.0, step_s], size)
    intensity = np.zeros_like(a)
    intensity[size:, size:] = accelerated * squares @ accelerated.T
    both = step_s * scale[:, None] * intensity * scale
    covariance = _gather(step_s * scale[:, None] * a / scale, both) / scale / scale[:, None]
    return np.asarray(0.5 * (covariance + covariance.T))


def hold_error_of(
    model: VehicleModel,
    step_s: float,
    speed_mps: float,
    road_class: str,
    hold: Hold = Hold.ZERO_ORDER,
) -> FloatArray:
    """Return Q, shape (2n, 2n), of the change of forces between samples that ``hold`` neglects.

    The road is white in its rate, (15) of Zhu without n1, with the geometric mean of class
    ``road_class`` of ISO 8608, "A" to "H", at a speed in m/s. To first order in the step: a force
    of random walk differs from a constant one by a ramp, and a third of the ramp's square for the
    bridge between its ends; from one that is linear by the bridge alone. The errors of the tyres
    are independent. Raises InputError for an unknown class, or a speed or step that is not above
    zero.
    """
    if len(road_class) != 1 or road_class not in CLASSES:
        raise InputError(f"ISO 8608 class {road_class}: unknown; choose one of A to H")
    if not (isfinite(speed_mps) and speed_mps > 0):
        raise InputError(
            f"model {model.name}: a speed of {speed_mps:g} m/s; give a finite number above zero"
        )
    ramp = discretize(model, step_s, Hold.FIRST_ORDER).after
    level = CLASS_A * 4.0 ** CLASSES.index(road_class)
    # Half of the one-sided density, for the variance of a walk is that over both signs.
    rate = (2 * pi * REFERENCE_WAVE_NUMBER) ** 2 * level * speed_mps / 2
    springs = np.array([tyre.stiffness**2 * step_s for tyre in model.tyres])
    dampers = np.array([2 * tyre.damping**2 / step_s for tyre in model.tyres])
    share = 4 / 3 if hold is Hold.ZERO_ORDER else 1 / 3
    return np.asarray(share * rate * (ramp * (springs + dampers)) @ ramp.T)


def _gather(rate: FloatArray, intensity: FloatArray) -> FloatArray:
    """Return ∫ exp(rate·t)·intensity·exp(rateᵀ·t) dt from 0 to 1, all of shape (s, s)."""
    from scipy.linalg import expm

    # Van Loan: the exponential of [[-A, W], [0, Aᵀ]] has Q behind its lower right part. It holds
    # parts that decay backwards, too: in parts of the step they are at most e.
    halvings = max(0, ceil(log2(np.linalg.norm(rate, 1))))
    block = np.block([[-rate, intensity], [np.zeros_like(rate), rate.T]])
    whole, size = expm(block / 2**halvings), len(rate)
    moved = whole[size:, size:].T
    covariance = moved @ whole[:size, size:]
    for _ in range(halvings):
        covariance = covariance + moved @ covariance @ moved.T
        moved = moved @ moved
    return np.asarray(covariance)
