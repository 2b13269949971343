"""A.2 Digitization: bilinear transform and the difference equations."""

import cmath
from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from floatref_reference.appendix_a.table_a_1 import Coefficients
from floatref_reference.signals import PI, ZERO, Real, Samples, samples


def bilinear(z: complex, dt: float) -> complex:
    """Express the Laplace operator by a delay of one sample.

    Equation:
        (A.6) s = (2/Δt) (1 - z^-1) / (1 + z^-1)

    Args:
        z: the z-domain variable, dimensionless.
        dt: sampling period Δt, s (or distance interval, m).

    Returns:
        s, rad/s (or rad/m).
    """
    return 2 / dt * (1 - 1 / z) / (1 + 1 / z)


def analog_cut_off(f_c: Real, dt: Real) -> np.longdouble:
    """Warp the digital cut-off frequency to the analog one.

    Equation:
        (A.7) ω_a = (2/Δt) tan(π f_c Δt)

    Args:
        f_c: digital cut-off frequency, Hz (or 1/λ_c, 1/m).
        dt: sampling period Δt, s (or distance interval, m).

    Returns:
        ω_a, rad/s (or rad/m).
    """
    return 2 / np.longdouble(dt) * substitution(f_c, dt)


def substitution(f_c: Real, dt: Real) -> np.longdouble:
    """Compute the substitution c of Table A.1.

    Equation:
        (A.11) c = tan(π f_c Δt)

    Args:
        f_c: digital cut-off frequency, Hz (or 1/λ_c, 1/m).
        dt: sampling period Δt, s (or distance interval, m).

    Returns:
        c, dimensionless.

    Raises:
        ValueError: unless 0 < f_c Δt < 0.5, since no stable filter exists elsewhere.
    """
    cycles = np.longdouble(f_c) * np.longdouble(dt)
    if not 0 < cycles < 0.5:
        raise ValueError(f"f_c Δt = {cycles} lies outside 0 to 0.5: sample more finely")
    return np.longdouble(np.tan(PI * cycles))


def transfer_function(coefficients: Coefficients, f: float, dt: float) -> complex:
    """Evaluate the digitized stage at a frequency.

    Equation:
        (A.8) with z = exp(j 2π f Δt)

    Args:
        coefficients: row of Table A.1.
        f: frequency, Hz (or wave number, 1/m).
        dt: sampling period Δt, s (or distance interval, m).

    Returns:
        H(z), dimensionless.
    """
    z = cmath.exp(2j * cmath.pi * f * dt)
    numerator = sum(float(N_i) * z**-i for i, N_i in enumerate(coefficients.N))
    denominator = sum(float(D_i) * z**-i for i, D_i in enumerate(coefficients.D))
    return numerator / denominator


def forward(
    x: npt.ArrayLike, coefficients: Coefficients, start: Sequence[np.longdouble]
) -> Samples:
    """Run a stage from the earliest sample to the latest.

    Equation:
        (A.9) y(t_k) = (Σ_{i=0}^n N_i x(t_{k-i}) - Σ_{i=1}^n D_i y(t_{k-i})) / D_0,
        k = n+1, …, K

    Args:
        x: input signal, shape (K,).
        coefficients: row of Table A.1.
        start: y(t_1) … y(t_n) of section A.3; only y(t_1) if K = 1.

    Returns:
        Output samples y(t_1) … y(t_K), in the unit of x.
    """
    D, N = coefficients
    x_t, y, n = samples(x), list(start), len(D) - 1
    for k in range(n, len(x_t)):
        right_side = ZERO
        for i in range(n + 1):
            right_side += N[i] * x_t[k - i]
        for i in range(1, n + 1):
            right_side -= D[i] * y[k - i]
        y.append(right_side / D[0])
    return y


def backward(
    x: npt.ArrayLike, coefficients: Coefficients, start: Sequence[np.longdouble]
) -> Samples:
    """Run a stage from the latest sample to the earliest.

    Equation:
        (A.10) y(t_k) = (Σ_{i=0}^n N_i x(t_{k+i}) - Σ_{i=1}^n D_i y(t_{k+i})) / D_0,
        k = K-n, …, 1

    Args:
        x: input signal, shape (K,).
        coefficients: row of Table A.1.
        start: y(t_K) … y(t_{K-n+1}) of section A.3, latest first; only y(t_K) if K = 1.

    Returns:
        Output samples y(t_1) … y(t_K), in the unit of x.
    """
    D, N = coefficients
    x_t, n = samples(x), len(D) - 1
    K = len(x_t)
    y = [ZERO] * K
    y[K - len(start) :] = reversed(start)
    for k in range(K - n - 1, -1, -1):
        right_side = ZERO
        for i in range(n + 1):
            right_side += N[i] * x_t[k + i]
        for i in range(1, n + 1):
            right_side -= D[i] * y[k + i]
        y[k] = right_side / D[0]
    return y
