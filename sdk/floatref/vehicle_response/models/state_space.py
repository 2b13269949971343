"""State-space form (9) of Zhu of a model, and its discretization (12) by matrix exponential."""

from dataclasses import dataclass
from enum import Enum
from math import factorial, isfinite
from typing import NamedTuple

import numpy as np

from floatref.errors import InputError
from floatref.values.arrays import FloatArray
from floatref.vehicle_response.models.model import VehicleModel


class Hold(Enum):
    """The tyre forces between two samples."""

    ZERO_ORDER = 0
    """They are constant at the value of the first sample, as in (12) of Zhu."""
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


def discretize(model: VehicleModel, step_s: float, hold: Hold = Hold.ZERO_ORDER) -> Discrete:
    """Return the model from sample to sample, ``step_s`` apart, exact for forces that ``hold``.

    The exponential of the matrix that the forces and their slope are added to serves a singular
    K too, for which [A_c - I]·A⁻¹·B of (12) of Zhu does not exist. Raises InputError for a step
    that is not a finite number above zero.
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
    """Return A_c and the response after one step to forces of 1 N, and from 0 to 1 N."""
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


class Sampled(NamedTuple):
    """x⁺ = transition·x + Σ taps[j]·w⁺⁻ʲ: w⁺ is the input at the end of the step, w at its begin.

    Attributes:
        transition: shape (s, s).
        taps: shape (degree + 1, s, m), the newest input first.
    """

    transition: FloatArray
    taps: FloatArray


def sample(matrix: FloatArray, inputs: FloatArray, step_s: float, degree: int) -> Sampled:
    """Return x' = ``matrix``·x + ``inputs``·w from sample to sample.

    ``matrix`` has the shape (s, s), ``inputs`` (s, m). Between two samples w is the polynomial of
    ``degree`` through the newest samples, so nothing is delayed; 1 is linear. The exponential of
    the matrix that w and its derivatives are added to is exact for that, however stiff the system
    is, and needs no inverse.
    """
    from scipy.linalg import expm

    size, width = inputs.shape
    chain = size + width * np.arange(degree + 2)
    exponent = np.zeros((chain[-1], chain[-1]))
    exponent[:size, :size] = step_s * matrix
    exponent[:size, size : chain[1]] = step_s * inputs
    exponent[size : chain[-2], chain[1] :] = np.eye(width * degree)
    power = expm(exponent)[:size]
    per_derivative = np.stack([power[:, begin : begin + width] for begin in chain[:-1]])
    taps = np.einsum("ij,ism->jsm", _derivatives(degree), per_derivative)
    return Sampled(power[:, :size], taps)


def stationary_sigma(
    system: Sampled, noise: FloatArray, of_state: FloatArray, of_input: FloatArray
) -> FloatArray:
    """Return the standard deviations of ``of_state``·x + ``of_input``·w under white noise.

    ``noise`` holds those of the inputs, shape (m,); ``of_state`` has the shape (r, s),
    ``of_input`` (r, m). The system must be stable.
    """
    from scipy.linalg import solve_discrete_lyapunov

    held, size, width = system.taps.shape
    # The newest inputs are states as well: those of the system depend on them.
    whole = np.zeros((size + held * width, size + held * width))
    whole[:size, :size] = system.transition
    whole[:size, size:-width] = np.hstack(list(system.taps[1:]))
    whole[size + width :, size:-width] = np.eye((held - 1) * width)
    later = np.zeros(((held - 1) * width, width))
    enters = np.vstack([system.taps[0], np.eye(width), later]) * noise
    covariance = solve_discrete_lyapunov(whole, enters @ enters.T)
    seen = np.hstack([of_state, of_input, np.zeros((of_state.shape[0], later.shape[0]))])
    return np.asarray(np.sqrt(np.diag(seen @ covariance @ seen.T)))


def _derivatives(degree: int) -> FloatArray:
    """Return the matrix from values at a step's end and before to derivatives at its begin."""
    places = 1.0 - np.arange(degree + 1)
    powers = [places**order / factorial(order) for order in range(degree + 1)]
    return np.linalg.inv(np.stack(powers, axis=1))
