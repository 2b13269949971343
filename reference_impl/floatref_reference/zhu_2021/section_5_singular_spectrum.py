"""5 Experimental Study: singular spectrum analysis, which takes noise off the test data.

The print names the method; its four steps are here as they are commonly given, with the symbols of
that literature. L is the window there, no gain.
"""

import numpy as np
import numpy.typing as npt

from floatref_reference.zhu_2021.symbols import Matrix, Vector


def embedding(x: npt.ArrayLike, L: int) -> Matrix:
    """Lay lagged stretches of a series side by side.

    Equation:
        X[i, j] = x_{i+j} for i = 0 ... L-1, j = 0 ... K-1, K = N - L + 1

    Args:
        x: series, shape (N,).
        L: window length, samples.

    Returns:
        Trajectory matrix X, shape (L, K).

    Raises:
        ValueError: unless 2 <= L <= N/2.
    """
    series = np.asarray(x, np.float64)
    if not 2 <= L <= len(series) / 2:
        raise ValueError(f"a window of {L} samples does not fit a series of {len(series)}")
    K = len(series) - L + 1
    X = np.zeros((L, K))
    for i in range(L):
        for j in range(K):
            X[i, j] = series[i + j]
    return X


def decomposition(X: Matrix) -> tuple[Vector, Matrix]:
    """Find the directions in which the stretches vary.

    Equation:
        X Xᵀ U_i = λ_i U_i, λ_1 >= λ_2 >= ... >= 0

    Args:
        X: trajectory matrix, shape (L, K).

    Returns:
        λ, shape (L,), and U with U_i as column i, shape (L, L).
    """
    lambdas, U = np.linalg.eigh(X @ X.T)
    return np.maximum(lambdas[::-1], 0.0), U[:, ::-1]


def grouping(X: Matrix, U: Matrix, group: list[int]) -> Matrix:
    """Keep some of the elementary matrices.

    Equation:
        X_I = Σ_{i in I} U_i U_iᵀ X

    Args:
        X: trajectory matrix, shape (L, K).
        U: eigenvectors, shape (L, L).
        group: which ones, from 0.

    Returns:
        X_I, shape (L, K).
    """
    X_I = np.zeros_like(X)
    for i in group:
        X_I += np.outer(U[:, i], U[:, i] @ X)
    return X_I


def diagonal_averaging(X: Matrix) -> Vector:
    """Make a series of a matrix.

    Equation:
        x_k is the mean of all X[i, j] with i + j = k.

    Args:
        X: matrix, shape (L, K).

    Returns:
        Series, shape (L + K - 1,).
    """
    L, K = X.shape
    total, count = np.zeros(L + K - 1), np.zeros(L + K - 1)
    for i in range(L):
        for j in range(K):
            total[i + j] += X[i, j]
            count[i + j] += 1
    return total / count


def denoise(x: npt.ArrayLike, L: int, r: int) -> Vector:
    """Rebuild a series from its r strongest components.

    Equation:
        Section 5: embedding, decomposition, grouping of the first r, diagonal averaging.

    Args:
        x: series, shape (N,).
        L: window length, samples.
        r: number of components to keep, 1 to L.

    Returns:
        Series, shape (N,).

    Raises:
        ValueError: unless 2 <= L <= N/2 and 1 <= r <= L.
    """
    X = embedding(x, L)
    if not 1 <= r <= L:
        raise ValueError(f"{r} of {L} components cannot be retained")
    _, U = decomposition(X)
    return diagonal_averaging(grouping(X, U, list(range(r))))
