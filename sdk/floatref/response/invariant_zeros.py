"""Motions that leave every reading at zero: invariant zeros of a model with unknown inputs."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from floatref.response.state_space import Discrete
from floatref.values.arrays import FloatArray

NOTHING = 1e-9
"""Singular value, of a matrix with rows and columns of about 1, that is rounding."""
CIRCLE = 1e-6
"""What is nearer to 1 than this neither grows nor fades in a drive, and may be an exact 1."""
ROUNDS = 20

Matrix = NDArray[Any]


def null_space(matrix: Matrix) -> Matrix:
    """Return the directions that ``matrix`` takes to zero, as columns, shape (columns, nullity).

    Rows and columns are brought to about 1 before, so that units decide nothing; the columns
    returned are those of the matrix as given.
    """
    balanced, scale = _balanced(matrix)
    _, sizes, rows = np.linalg.svd(balanced)
    rank = int(np.sum(sizes > NOTHING))
    return np.asarray(scale[:, None] * rows[rank:].conj().T)


def lasting_motions(
    system: Discrete, output: FloatArray, direct: FloatArray
) -> list[tuple[complex, Matrix]]:
    """Return the invariant zeros λ of (A_c, B_c, G, J) on or outside the unit circle.

    For such λ there are a state x and forces F with A_c·x + B_c·F = λ·x and G·x + J·F = 0: a
    motion that goes as λᵏ, stays or grows, and that no reading tells. With each λ come its
    (x, F) as columns, shape (2n + p, k). For J of full column rank the zeros are among the
    eigenvalues of A_c - B_c·J⁺·G; 1 is tried besides, since a multiple one is computed inexactly.
    J is that of the hold, `Discrete.feedthrough`.
    """
    rows = 1.0 / _lengths(np.hstack([output, direct]), 1)[:, None]
    closed = system.transition - system.input @ np.linalg.pinv(rows * direct) @ (rows * output)
    candidates = np.linalg.eigvals(closed)
    tried = [1.0, *candidates[np.abs(candidates) > 1.0 - CIRCLE]]
    motions = [(z, null_space(_pencil(system, output, direct, z))) for z in tried]
    return [(z, motion) for z, motion in motions if motion.size]


def unseen_modes(system: Discrete, output: FloatArray) -> list[Matrix]:
    """Return the states x with A_c·x = λ·x and G·x = 0, shape (2n, k) for each of the λ."""
    nothing = np.zeros((len(output), 0))
    eigenvalues = [1.0, *np.linalg.eigvals(system.transition)]
    spaces = [null_space(_pencil(system, output, nothing, z)) for z in eigenvalues]
    return [space for space in spaces if space.size]


def _pencil(system: Discrete, output: FloatArray, direct: FloatArray, z: complex) -> Matrix:
    """Return [A_c - z·I, B_c; G, J], without B_c where J has no columns."""
    states = len(system.transition)
    above = np.hstack([system.transition - z * np.eye(states), system.input[:, : direct.shape[1]]])
    return np.vstack([above, np.hstack([output, direct])])


def _balanced(matrix: Matrix) -> tuple[Matrix, FloatArray]:
    """Return ``matrix`` with rows and columns of length 1, about, and the scale of columns."""
    balanced, scale = np.array(matrix), np.ones(matrix.shape[1])
    for _ in range(ROUNDS):
        balanced = balanced / _lengths(balanced, 1)[:, None]
        columns = _lengths(balanced, 0)
        balanced, scale = balanced / columns, scale / columns
    return balanced, scale


def _lengths(matrix: Matrix, axis: int) -> FloatArray:
    lengths = np.linalg.norm(matrix, axis=axis)
    return np.where(lengths > 0, lengths, 1.0)
