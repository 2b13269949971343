"""6.4.1 Allan Variance."""

import numpy as np
import numpy.typing as npt

from floatref_reference.signals import PI, ZERO, Real, Samples, Signal, mean, samples, signal


def cluster_average(omega: npt.ArrayLike, k: int, n: int) -> np.longdouble:
    """Average a cluster of consecutive samples.

    Equation:
        (6.49) Ω̄_k(nΔt) = (1/n) Σ_{j=k}^{k+n-1} Ω_j

    Args:
        omega: signal Ω, shape (N,).
        k: index of the cluster's first sample, 0 being the first of the signal.
        n: samples in the cluster.

    Returns:
        Ω̄_k in the unit of Ω.
    """
    return mean(samples(omega)[k : k + n])


def differences(N: int, n: int) -> int:
    """Count the pairs of adjacent clusters that overlap with the next by all but one sample.

    Equation:
        (6.50) N - 2n + 1

    Args:
        N: samples of the signal.
        n: samples in a cluster.

    Returns:
        Number of pairs, at least 1.

    Raises:
        ValueError: if n is not positive, or two clusters do not fit into the signal.
    """
    if not 1 <= n <= N // 2:
        raise ValueError(f"clusters of {n} samples do not fit twice into {N} samples")
    return N - 2 * n + 1


def allan_variance(omega: npt.ArrayLike, n: int) -> np.longdouble:
    """Compute the overlapping Allan variance from adjacent cluster averages.

    Equation:
        (6.50) σ_A²(nΔt) = 1/(2(N - 2n + 1)) Σ_{k=1}^{N-2n+1} (Ω̄_{k+n} - Ω̄_k)²

    Args:
        omega: signal Ω, shape (N,).
        n: samples in a cluster.

    Returns:
        σ_A²(nΔt) in the unit of Ω squared.

    Raises:
        ValueError: if two clusters do not fit into the signal.
    """
    omega_j = samples(omega)
    pairs, total = differences(len(omega_j), n), ZERO
    for k in range(pairs):
        total += (cluster_average(omega_j, k + n, n) - cluster_average(omega_j, k, n)) ** 2
    return total / (2 * pairs)


def integrated(omega: npt.ArrayLike, dt: Real) -> Signal:
    """Integrate a signal by rectangles.

    Equation:
        (6.51) θ_k = Δt Σ_{j=1}^k Ω_j, and θ_0 = 0, which (6.52) needs at k = 1.

    Args:
        omega: signal Ω, shape (N,).
        dt: sampling period Δt, s.

    Returns:
        θ_0 to θ_N, shape (N + 1,), in the unit of Ω times s.
    """
    theta: Samples = [ZERO]
    for omega_j in samples(omega):
        theta.append(theta[-1] + np.longdouble(dt) * omega_j)
    return signal(theta)


def allan_variance_of_integral(theta: npt.ArrayLike, n: int, dt: Real) -> np.longdouble:
    """Compute the overlapping Allan variance from the integrated signal.

    Equation:
        (6.52) σ_A²(nΔt) = 1/(2(N - 2n + 1)) 1/(nΔt)²
        Σ_{k=1}^{N-2n+1} (θ_{k+2n-1} - 2θ_{k+n-1} + θ_{k-1})²

    Args:
        theta: θ_0 to θ_N of (6.51), shape (N + 1,).
        n: samples in a cluster.
        dt: sampling period Δt, s.

    Returns:
        σ_A²(nΔt) in the unit of Ω squared.

    Raises:
        ValueError: if two clusters do not fit into the signal.
    """
    theta_k = samples(theta)
    pairs, total = differences(len(theta_k) - 1, n), ZERO
    for k in range(1, pairs + 1):
        total += (theta_k[k + 2 * n - 1] - 2 * theta_k[k + n - 1] + theta_k[k - 1]) ** 2
    return total / (2 * pairs) / (n * np.longdouble(dt)) ** 2


def modelled_variance(
    tau: Real, R_A: Real = 0.0, K_A: Real = 0.0, B_A: Real = 0.0, N_A: Real = 0.0, Q_A: Real = 0.0
) -> np.longdouble:
    """Compute the Allan variance of a signal with five kinds of noise.

    Equation:
        (6.53) σ_A²(nΔt) = R_A² (nΔt)²/2 + K_A² nΔt/3 + 2 B_A² ln(2)/π + N_A²/(nΔt) + 3 Q_A²/(nΔt)².
        It is in section 6.4.2, and gives each kind of noise in the unit of Ω times a power
        of s, here for Ω in rad/s.

    Args:
        tau: cluster time nΔt, s.
        R_A: ramp instability, rad/s².
        K_A: rate random walk, rad/s^(3/2).
        B_A: bias instability, rad/s.
        N_A: angle random walk, rad/√s.
        Q_A: quantization, rad.

    Returns:
        σ_A²(nΔt), rad²/s².
    """
    t = np.longdouble(tau)
    ramp, walk = np.longdouble(R_A) ** 2 * t**2 / 2, np.longdouble(K_A) ** 2 * t / 3
    bias = 2 * np.longdouble(B_A) ** 2 * np.log(np.longdouble(2)) / PI
    white, quantized = np.longdouble(N_A) ** 2 / t, 3 * np.longdouble(Q_A) ** 2 / t**2
    return np.longdouble(ramp + walk + bias + white + quantized)
