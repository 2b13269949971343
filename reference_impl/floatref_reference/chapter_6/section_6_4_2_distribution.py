"""6.4.2 and figure 6.5: autocorrelation of a sensor at rest, and tests for normality."""

import math

import numpy as np
import numpy.typing as npt

from floatref_reference.signals import Real, Signal, mean, samples, signal


def deviations(x: npt.ArrayLike) -> Signal:
    """Normalize a signal to a mean of 0 and a standard deviation of 1.

    Equation:
        Section 6.4.2, "normalized probability distributions": (x - mean)/σ, with 1/N in σ².

    Args:
        x: signal, shape (N,).

    Returns:
        Normalized signal, shape (N,).

    Raises:
        ValueError: if the signal does not vary.
    """
    x_k = signal(samples(x))
    centred = x_k - mean(x_k)
    sigma = np.sqrt(mean(centred**2))
    if sigma == 0:
        raise ValueError("a constant signal has no distribution to normalize")
    return signal(centred / sigma)


def autocorrelation(x: npt.ArrayLike, lags: int) -> Signal:
    """Compute the normalized autocorrelation.

    Equation:
        Figure 6.5: r_l = Σ_{k=0}^{N-1-l} (x_k - mean)(x_{k+l} - mean)/Σ (x_k - mean)².

    Args:
        x: signal, shape (N,).
        lags: greatest lag l, less than N.

    Returns:
        r_0 = 1 to r_lags, shape (lags + 1,); of white noise the others have a standard deviation
        of 1/√N.

    Raises:
        ValueError: if the signal does not vary or is too short.
    """
    u = deviations(x)
    if not 0 <= lags < len(u):
        raise ValueError(f"lags up to {lags} do not fit into {len(u)} samples")
    return signal([np.sum(u[: len(u) - lag] * u[lag:]) / len(u) for lag in range(lags + 1)])


def skew(x: npt.ArrayLike) -> np.longdouble:
    """Compute the skew of a distribution.

    Equation:
        Section 6.4.2: mean of the cubes of the normalized signal.

    Args:
        x: signal, shape (N,).

    Returns:
        Skew, 0 for a normal distribution.
    """
    return mean(deviations(x) ** 3)


def excess_kurtosis(x: npt.ArrayLike) -> np.longdouble:
    """Compute the excess kurtosis of a distribution.

    Equation:
        Section 6.4.2: mean of the fourth powers of the normalized signal, less 3.

    Args:
        x: signal, shape (N,).

    Returns:
        Excess kurtosis, 0 for a normal distribution.
    """
    return mean(deviations(x) ** 4) - 3


def normal_probability(u: Real) -> float:
    """Compute the cumulative normal distribution.

    Equation:
        Section 6.4.2, "normality": Φ(u) = (1 + erf(u/√2))/2.

    Args:
        u: deviation in standard deviations.

    Returns:
        Probability of a lesser one.
    """
    return (1 + math.erf(float(u) / math.sqrt(2))) / 2


def kolmogorov_smirnov(x: npt.ArrayLike) -> float:
    """Score a distribution by its greatest distance from a normal one.

    Equation:
        Section 6.4.2, Kolmogorov-Smirnov: D = sup |F_N - Φ|, with mean and σ of the signal itself.

    Args:
        x: signal, shape (N,).

    Returns:
        D, 0 to 1.
    """
    u = np.sort(deviations(x))
    n, greatest = len(u), 0.0
    for k in range(n):
        expected = normal_probability(u[k])
        greatest = max(greatest, (k + 1) / n - expected, expected - k / n)
    return greatest


def significance(D: float, n: int) -> float:
    """Compute how likely a score is for samples of a normal distribution.

    Equation:
        Section 6.4.2, "confidence that the distribution is not normal":
        2 Σ_{j≥1} (-1)^(j-1) exp(-2 j² n D²), the limit of many samples of a known distribution.
        Mean and σ of the samples themselves make a score less likely still.

    Args:
        D: Kolmogorov-Smirnov score.
        n: number of samples.

    Returns:
        Probability of a score above D.
    """
    exponent = 2 * n * D**2
    if exponent < 0.1:
        return 1.0
    signs = [1.0 if j % 2 else -1.0 for j in range(1, 30)]
    total = sum(sign * math.exp(-(j**2) * exponent) for j, sign in enumerate(signs, 1))
    return min(max(2 * total, 0.0), 1.0)
