"""A linear system whose inputs are sampled, exact for inputs that are polynomials in between."""

from math import factorial
from typing import NamedTuple

import numpy as np

from floatref.values.arrays import FloatArray


class Sampled(NamedTuple):
    """x⁺ = transition·x + Σ taps[j]·w⁺⁻ʲ: w⁺ is the input at the end of the step, w at its begin.

    Attributes:
        transition: shape (s, s).
        taps: shape (degree + 1, s, m), the newest input first.
    """

    transition: FloatArray
    taps: FloatArray


def sampled(matrix: FloatArray, inputs: FloatArray, step_s: float, degree: int) -> Sampled:
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
    """Return what makes derivatives at a step's begin of values at its end and before."""
    places = 1.0 - np.arange(degree + 1)
    powers = [places**order / factorial(order) for order in range(degree + 1)]
    return np.linalg.inv(np.stack(powers, axis=1))
