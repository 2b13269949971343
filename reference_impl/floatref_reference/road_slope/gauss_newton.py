"""Least squares by dense matrices, pass by pass, and the covariance of all unknowns."""

from typing import NamedTuple

import numpy as np

from floatref_reference.road_slope.held import Held, first_held, held_after, loosened
from floatref_reference.road_slope.rows import misfits
from floatref_reference.road_slope.symbols import Matrix, Stretch, Vector
from floatref_reference.road_slope.unknowns import (
    Unknowns,
    as_vector,
    by_name,
    kept_in_range,
    start,
)
from floatref_reference.road_slope.wheels import road_points

TINY = 1e-30
"""Complex step: its square is nothing beside 1, so that no digits are lost."""
TRIES = 5
FEWEST_PASSES, WHOLE, MOST_PASSES = 7, 10, 40
SETTLED = 3e-4
"""Change of θ in rad."""


class Answer(NamedTuple):
    """What least squares found.

    Equation:
        cov = (JᵀJ)⁻¹

    Attributes:
        unknowns: by name.
        held: g_j, β_k and steps of o_k after the last pass, and the factor 1.
        covariance: of the unknown vector, shape (M, M); `unknowns.by_name` of numpy.arange(M) has
            the indices.
        passes: how many were made.
        change: largest |Δθ| of the last pass's step before it was halved, rad.
    """

    unknowns: Unknowns
    held: Held
    covariance: Matrix
    passes: int
    change: float


def jacobian(vector: Vector, stretch: Stretch, held: Held) -> Matrix:
    """Return the derivatives of all misfits by the complex step.

    Equation:
        ∂m/∂x_i = Im m(x + iε e_i)/ε

    Args:
        vector: unknowns, shape (M,).
        stretch: what is known.
        held: what the pass holds.

    Returns:
        J, shape (R, M).
    """
    stepped = vector[:, np.newaxis] + 1j * TINY * np.eye(len(vector))
    return np.asarray(np.imag(misfits(stepped, stretch, held)) / TINY)


def full_step(vector: Vector, stretch: Stretch, held: Held) -> Vector:
    """Return the step of Gauss and Newton.

    Equation:
        min |m + J δ|² by J = QR: R δ = -Qᵀ m

    Args:
        vector: unknowns, shape (M,).
        stretch: what is known.
        held: what the pass holds.

    Returns:
        δ, shape (M,).
    """
    Q, R = np.linalg.qr(jacobian(vector, stretch, held))
    return np.asarray(np.linalg.solve(R, -Q.T @ misfits(vector, stretch, held)))


def squares(vector: Vector, stretch: Stretch, held: Held) -> float:
    """Return the sum of squares of all misfits."""
    return float(np.sum(misfits(vector, stretch, held) ** 2))


def after_step(vector: Vector, step: Vector, stretch: Stretch, held: Held) -> Vector:
    """Go along a step as far as the sum of squares does not grow.

    Equation:
        x + δ/2ⁿ in its ranges, with the least n of 0 to 3 of which S ≤ 1.001 S(x) + 1, else n = 4

    Args:
        vector: unknowns, shape (M,).
        step: δ, shape (M,).
        stretch: what is known.
        held: what the pass holds.

    Returns:
        New unknowns, shape (M,).
    """
    N, K = len(held.intensity) + 1, len(stretch.readings.place)
    most = 1.001 * squares(vector, stretch, held) + 1
    for halvings in range(TRIES):
        new = as_vector(kept_in_range(by_name(vector + step / 2**halvings, N, K)))
        if squares(new, stretch, held) <= most:
            break
    return new


def covariance(vector: Vector, stretch: Stretch, held: Held) -> Matrix:
    """Return the covariance of all unknowns.

    Equation:
        (JᵀJ)⁻¹ = R⁻¹ R⁻ᵀ with J = QR

    Args:
        vector: unknowns, shape (M,).
        stretch: what is known.
        held: what the pass holds.

    Returns:
        Shape (M, M).
    """
    root = np.linalg.inv(np.linalg.qr(jacobian(vector, stretch, held), "r"))
    return np.asarray(root @ root.T)


def least_squares(stretch: Stretch) -> Answer:
    """Find all unknowns of a stretch.

    Equation:
        Pass by pass a step, and then g_j, β_k and steps of o_k of the new unknowns, which the next
        pass holds; half of the step after ten passes; until no θ changes by 0.3 mrad by a whole
        step in the seventh pass or later, or forty are made

    Args:
        stretch: what is known; the work grows with the cube of its length.
    """
    N, K = road_points(stretch).number, len(stretch.readings.place)
    x, held = start(stretch), first_held(stretch)
    passes, change = 0, np.inf
    while passes < FEWEST_PASSES or (passes < MOST_PASSES and change >= SETTLED):
        step = full_step(x, stretch, held)
        x = after_step(x, step if passes < WHOLE else step / 2, stretch, held)
        passes, change = passes + 1, float(np.max(np.abs(by_name(step, N, K).pitch)))
        held = held_after(x, stretch, loosened(passes))
    return Answer(by_name(x, N, K), held, covariance(x, stretch, held), passes, change)
