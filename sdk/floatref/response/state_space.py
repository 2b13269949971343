"""State-space form (9) of Zhu of a model, and its discretization (12) by matrix exponential."""

from dataclasses import dataclass
from enum import Enum
from math import isfinite

import numpy as np

from floatref.errors import InputError
from floatref.response.model import VehicleModel
from floatref.values.arrays import FloatArray


class Hold(Enum):
    """What the tyre forces do between two samples."""

    ZERO_ORDER = 0
    """They stay as they were at the first of them, as in (12) of Zhu."""
    FIRST_ORDER = 1
    """They change linearly."""


@dataclass(frozen=True, eq=False)
class Discrete:
    """States from one sample to the next: x⁺ = A_c·x + before·F + after·F⁺.

    With a hold of first order x⁺ needs the next forces. ξ = x - after·F does not:
    ξ⁺ = A_c·ξ + input·F as in (12) of Zhu, and readings G·x + J·F are G·ξ + (J + G·after)·F.

    Attributes:
        transition: A_c, shape (2n, 2n).
        before: influence of the forces F at the first sample, shape (2n, p), in SI units per N.
        after: influence of the forces F⁺ at the second; zero for a hold of order zero.
        step_s: time between the samples, in s.
    """

    transition: FloatArray
    before: FloatArray
    after: FloatArray
    step_s: float

    @property
    def input(self) -> FloatArray:
        """B_c of ξ⁺ = A_c·ξ + B_c·F, shape (2n, p); for a hold of order zero that of (12)."""
        return np.asarray(self.transition @ self.after + self.before)

    def feedthrough(self, output: FloatArray, direct: FloatArray) -> FloatArray:
        """Return J + G·after of ξ for G = ``output``, J = ``direct``; shape (m, p)."""
        return np.asarray(direct + output @ self.after)


def state_space(model: VehicleModel) -> tuple[FloatArray, FloatArray]:
    """Return (A, B) of x' = A·x + B·F with x = (q, q'), F in N, as in (9) of Zhu.

    A has the shape (2n, 2n), B the shape (2n, p).
    """
    size = len(model.freedoms)
    parts = np.hstack([model.stiffness, model.damping, model.selection])
    rates = np.linalg.solve(model.mass, parts)
    a = np.zeros((2 * size, 2 * size))
    a[:size, size:] = np.eye(size)
    a[size:] = -rates[:, : 2 * size]
    b = np.vstack([np.zeros((size, len(model.tyres))), rates[:, 2 * size :]])
    return a, b


def discretized(model: VehicleModel, step_s: float, hold: Hold = Hold.ZERO_ORDER) -> Discrete:
    """Return the model from sample to sample, ``step_s`` apart, exact for forces that ``hold``.

    The exponential of the matrix that the forces and their slope are added to serves a singular
    K too, for which [A_c - I]·A⁻¹·B of (12) of Zhu does not exist. Raises InputError for a step
    that is no finite number above zero.
    """
    if not (isfinite(step_s) and step_s > 0):
        raise InputError(
            f"model {model.name}: a time step of {step_s:g} s; give a finite number above zero"
        )
    transition, step, ramp = _responses(model, step_s)
    if hold is Hold.ZERO_ORDER:
        return Discrete(transition, step, np.zeros_like(step), step_s)
    return Discrete(transition, step - ramp, ramp, step_s)


def _responses(model: VehicleModel, step_s: float) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return A_c and what forces of 1 N, and from 0 to 1 N, have done after one step."""
    from scipy.linalg import expm

    a, b = state_space(model)
    states, inputs = b.shape
    # Velocities in m per step: the exponent is small then, and a step of 1 throughout.
    scale = np.repeat([1.0, step_s], states // 2)
    exponent = np.zeros((states + 2 * inputs, states + 2 * inputs))
    exponent[:states, :states] = step_s * scale[:, None] * a / scale
    exponent[:states, states : states + inputs] = step_s * scale[:, None] * b
    exponent[states : states + inputs, states + inputs :] = np.eye(inputs)
    top = expm(exponent)[:states] / scale[:, None]
    transition = top[:, :states] * scale
    return transition, top[:, states : states + inputs], top[:, states + inputs :]
