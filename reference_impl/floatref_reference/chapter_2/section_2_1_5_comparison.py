"""2.1.5 Objective Trace Comparison: cross correlation (2.1.5.1) and filtering (2.1.5.2)."""

from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from floatref_reference.appendix_a.filters import hpf_b3x2, lpf_b3x2
from floatref_reference.chapter_2.section_2_1_1_iri import iri_trace, slope
from floatref_reference.signals import Signal, samples, signal

WAVEBANDS = {"short": (0.14, 1.6), "medium": (1.6, 8.0), "long": (8.0, 65.6)}


class Agreement(NamedTuple):
    """The best match of two filtered profiles.

    Args:
        score: agreement score (2.16), -1 to 1.
        rho_max: highest correlation coefficient (2.14), -1 to 1.
        gamma: amplitude factor (2.15) at that offset, 0 to 1.
        x_off: offset, m; positive where q lies farther along than p.
    """

    score: np.longdouble
    rho_max: np.longdouble
    gamma: np.longdouble
    x_off: float


def overlap(p: npt.ArrayLike, q: npt.ArrayLike, i: int) -> tuple[Signal, Signal]:
    """Pair the samples of two profiles at an offset.

    Equation:
        p(x_k) and q(x_{k+i}) of (2.13), for every k at which both exist.

    Args:
        p: filtered profile, shape (N_p,).
        q: filtered profile, shape (N_q,), from the same first distance.
        i: offset in samples.

    Returns:
        The paired stretches of p and q, of one length.

    Raises:
        ValueError: if the profiles do not overlap at this offset.
    """
    p_x, q_x = signal(samples(p)), signal(samples(q))
    first, last = max(0, -i), min(len(p_x), len(q_x) - i)
    if last <= first:
        raise ValueError(f"profiles of {len(p_x)} and {len(q_x)} points lie apart at offset {i}")
    return p_x[first:last], q_x[first + i : last + i]


def cross_correlation(p: npt.ArrayLike, q: npt.ArrayLike, i: int) -> np.longdouble:
    """Estimate the cross-correlation function at one offset.

    Equation:
        (2.13), the sampled form of (2.12): R_pq(iΔx) = (1/N) Σ p(x_k) q(x_{k+i})

    Args:
        p: filtered profile, shape (N_p,).
        q: filtered profile, shape (N_q,), from the same first distance.
        i: offset in samples.

    Returns:
        R_pq, in the unit of p times that of q.
    """
    p_x, q_x = overlap(p, q, i)
    return np.longdouble(np.sum(p_x * q_x) / len(p_x))


def standard_deviation(p: npt.ArrayLike) -> np.longdouble:
    """Compute the standard deviation that normalizes the correlation.

    Equation:
        σ_p of (2.14): σ_p² = (1/N) Σ (p(x_k) - μ_p)²

    Args:
        p: filtered profile, shape (N,).

    Returns:
        σ_p, in the unit of p.
    """
    p_x = signal(samples(p))
    deviation = p_x - np.sum(p_x) / len(p_x)
    return np.longdouble(np.sqrt(np.sum(deviation * deviation) / len(p_x)))


def correlation(p: npt.ArrayLike, q: npt.ArrayLike, i: int) -> np.longdouble:
    """Compute the correlation coefficient at one offset.

    Equation:
        (2.14), with the factor 1/N that is missing in print:
        ρ_pq(iΔx) = Σ (p(x_k) - μ_p) (q(x_{k+i}) - μ_q) / (N σ_p σ_q), with mean and standard
        deviation over the overlap.

    Args:
        p: filtered profile, shape (N_p,).
        q: filtered profile, shape (N_q,), from the same first distance.
        i: offset in samples.

    Returns:
        ρ_pq, -1 to 1; 0 where a profile does not vary.
    """
    p_x, q_x = overlap(p, q, i)
    p_hat, q_hat = p_x - np.sum(p_x) / len(p_x), q_x - np.sum(q_x) / len(q_x)
    sigma_pq = standard_deviation(p_x) * standard_deviation(q_x)
    if sigma_pq == 0:
        return np.longdouble(0)
    return cross_correlation(p_hat, q_hat, 0) / sigma_pq


def amplitude_factor(p: npt.ArrayLike, q: npt.ArrayLike, i: int) -> np.longdouble:
    """Penalize a difference in overall roughness.

    Equation:
        (2.15) γ = min(σ_p, σ_q) / max(σ_p, σ_q), over the overlap.

    Args:
        p: filtered profile, shape (N_p,).
        q: filtered profile, shape (N_q,), from the same first distance.
        i: offset in samples.

    Returns:
        γ, 0 to 1; 1 where neither profile varies.
    """
    sigma = [standard_deviation(part) for part in overlap(p, q, i)]
    return min(sigma) / max(sigma) if max(sigma) > 0 else np.longdouble(1)


def agreement(p: npt.ArrayLike, q: npt.ArrayLike, dx: float, max_offset: float = 1.0) -> Agreement:
    """Score the agreement of two filtered profiles.

    Equation:
        (2.16) score = ρ_max γ, with ρ_max over the whole-sample offsets within the limit and
        γ at the offset of ρ_max. Equal maxima: the most negative offset.

    Args:
        p: filtered profile, shape (N_p,).
        q: filtered profile, shape (N_q,), from the same first distance.
        dx: constant interval Δx of both, m.
        max_offset: largest offset to either side, m.

    Returns:
        Score, ρ_max, γ and offset.
    """
    limit = int(max_offset / dx + 1e-9)
    rho_max, best = np.longdouble(-np.inf), 0
    for i in range(-limit, limit + 1):
        rho = correlation(p, q, i)
        if rho > rho_max:
            rho_max, best = rho, i
    gamma = amplitude_factor(p, q, best)
    return Agreement(rho_max * gamma, rho_max, gamma, best * dx)


def filtered(z: npt.ArrayLike, dx: float, waveband: str = "iri") -> Signal:
    """Filter a profile ahead of the comparison.

    Equation:
        Section 2.1.5.2. "iri": steps 1 to 3 of section 2.1.1. "short", "medium", "long": slope,
        then HPF_B3x2 at the longest and LPF_B3x2 at the shortest wavelength of the band,
        these limits being the cut-off settings λ_c.

    Args:
        z: elevation, m, shape (N,), N ≥ 2.
        dx: constant interval Δx, m; less than half the shortest wavelength of the band.
        waveband: "iri", "short", "medium" or "long".

    Returns:
        Filtered profile, shape (N-1,): m/km for "iri", m/m otherwise.
    """
    if waveband == "iri":
        return iri_trace(z, dx)
    shortest, longest = (np.longdouble(limit) for limit in WAVEBANDS[waveband])
    return lpf_b3x2(hpf_b3x2(slope(z, dx), 1 / longest, dx), 1 / shortest, dx)
