"""Whether the innovations of a Kalman filter are as large as it expects: the NIS.

Bar-Shalom, Li and Kirubarajan, Estimation with Applications to Tracking and Navigation, Wiley 2001,
5.4.2, in the symbols of chapter 6.
"""

import math

import numpy as np
import numpy.typing as npt

from floatref_reference.appendix_c.symbols import Matrix, Vector

TERMS = 100_000
"""Most terms of the series of the chi-square distribution."""


def innovation(P: Matrix, y: Vector, h_x: Vector, H: Matrix, R: Matrix) -> tuple[Vector, Matrix]:
    """Compute the innovation of a measurement and its covariance.

    Equation:
        ν_k = y_k - h(x̂_{k|k-1}, 0) and S_k = H_k P_{k|k-1} H_kᵀ + R_k, whose inverse is in (6.13).
        Rows of missing measurements are omitted.

    Args:
        P: P_{k|k-1}, shape (ns, ns).
        y: measurements y_k, shape (nm,), NaN where one is missing.
        h_x: h(x̂_{k|k-1}, 0), shape (nm,).
        H: ∂h/∂x, shape (nm, ns).
        R: covariance of the measurement noise, shape (nm, nm).

    Returns:
        ν_k, shape (n,), and S_k, shape (n, n), of the n measurements that there are.
    """
    there = ~np.isnan(y)
    H_k = H[there]
    return y[there] - h_x[there], H_k @ P @ H_k.T + R[np.ix_(there, there)]


def nis(nu: Vector, S: Matrix) -> float:
    """Compute the normalized innovation squared.

    Equation:
        ε_k = ν_kᵀ S_k⁻¹ ν_k, of n degrees of freedom: its mean is n if the filter is consistent.

    Args:
        nu: ν_k, shape (n,).
        S: S_k, shape (n, n).

    Returns:
        ε_k.
    """
    return float(sum(z * z for z in normalized(nu, S)))


def normalized(nu: Vector, S: Matrix) -> Vector:
    """Compute the normalized innovations of measurements that are taken one after the other.

    Equation:
        With S = L Lᵀ, L lower triangular, z = L⁻¹ ν: z_i is the innovation of measurement i given
        those before it, over its own deviation. Their squares add up to ε.

    Args:
        nu: ν_k, shape (n,).
        S: S_k, shape (n, n).

    Returns:
        z, shape (n,).
    """
    n = len(nu)
    L, z = np.zeros((n, n)), np.zeros(n)
    for i in range(n):
        for j in range(i):
            L[i, j] = (S[i, j] - sum(L[i, m] * L[j, m] for m in range(j))) / L[j, j]
        L[i, i] = math.sqrt(S[i, i] - sum(L[i, m] ** 2 for m in range(i)))
        z[i] = (nu[i] - sum(L[i, m] * z[m] for m in range(i))) / L[i, i]
    return z


def mean_nis(z: npt.ArrayLike) -> float:
    """Compute the mean NIS per degree of freedom.

    Equation:
        ε̄ = 1/N Σ z_i². N ε̄ is chi-square distributed with N degrees of freedom if the z are
        independent and standard normal.

    Args:
        z: normalized innovations, shape (N,).

    Returns:
        ε̄.
    """
    values = np.asarray(z, np.float64)
    total = 0.0
    for value in values:
        total += float(value) ** 2
    return total / len(values)


def chi_square_below(x: float, n: int) -> float:
    """Compute the probability that a chi-square variable is below a value.

    Equation:
        P(n/2, x/2), the regularized lower incomplete gamma function, by its series
        P(a, t) = t^a e^-t / Γ(a + 1) Σ_m t^m / ((a + 1) … (a + m))

    Args:
        x: the value, above 0.
        n: degrees of freedom.

    Returns:
        The probability.
    """
    a, t = n / 2.0, x / 2.0
    term = total = 1.0
    for m in range(1, TERMS):
        term *= t / (a + m)
        total += term
        if term < 1e-17 * total:
            break
    return math.exp(a * math.log(t) - t - math.lgamma(a + 1.0)) * total
