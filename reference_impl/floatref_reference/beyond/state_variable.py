"""High-pass stages with a varying cut-off whose states are the integrals, over distance.

A second-order stage in analog form divides its input into three signals, x = hp + bp + lp, of
which two are integrals with the cut-off ω inside:

    bp' = ω hp,  lp' = ω bp,  hence  hp' = x' - ω hp - ω bp

The slope that hp has beside x' falls with ω. The literal form of a varying filter (A.9) keeps the
slope of its output instead: as c falls to 0 it tends to y_k - y_{k-1} = y_{k-1} - y_{k-2}. At a
stop the cut-off wavelength of section 5.7 is a few points and behind it a hundred metres, so a
slope of several per metre continues until that long wavelength lets it decay. With the states as
the integrals a step decays with the phase ∫ ω dx, for any course of ω.

At a constant cut-off both forms are the filter of appendix A. The functions here run in reverse,
take the cut-off at every sample, and start as section A.3 starts.
"""

import numpy.typing as npt

from floatref_reference.appendix_a import initialization as a3
from floatref_reference.appendix_a import table_a_1 as a1
from floatref_reference.appendix_a.varying import substitutions
from floatref_reference.signals import Real, Samples, Signal, samples, signal


def _signal_and_substitutions(
    x: npt.ArrayLike, f_c: npt.ArrayLike, dt: Real
) -> tuple[Samples, Samples]:
    x_t, c = samples(x), substitutions(f_c, dt)
    if len(c) != len(x_t):
        raise ValueError(f"{len(c)} cut-offs do not fit a signal of {len(x_t)} samples")
    return x_t, c


def hpf_b3s2r_state_variable(x: npt.ArrayLike, f_c: npt.ArrayLike, dt: Real) -> Signal:
    """Apply the second-order high-pass stage as a state-variable filter, reverse.

    Equation:
        x = hp + bp + lp, bp' = ω hp, lp' = ω bp, each integral by the trapezoidal rule from the
        latest sample to the earliest, with ω = (2/Δt) c, (A.7) and (A.11):
        bp_k = s_1 + c_k hp_k, s_1 = bp_{k+1} + c_{k+1} hp_{k+1},
        lp_k = s_2 + c_k bp_k, s_2 = lp_{k+1} + c_{k+1} bp_{k+1},
        hp_k = (x_k - s_2 - (1 + c_k) s_1) / (1 + c_k + c_k²).
        Start: hp_K = y(t_K) of (A.19) mended, bp_K = (c_K - 1) hp_K, lp_K = x_K - c_K hp_K, which
        give its y(t_{K-1}) at a constant cut-off.

    Args:
        x: input signal, shape (K,).
        f_c: cut-off frequency at every sample, Hz (or 1/λ_c, 1/m), shape (K,).
        dt: sampling period Δt, s (or distance interval, m).

    Returns:
        The output hp, shape (K,), in the unit of x.

    Raises:
        ValueError: unless every sample has its cut-off and 0 < f_c Δt < 0.5.
    """
    x_t, c = _signal_and_substitutions(x, f_c, dt)
    hp = a3.hpf_b3s2r_start(x_t[-1:], a1.hpf_b3s2_coefficients(c[-1]))
    bp, lp = (c[-1] - 1) * hp[0], x_t[-1] - c[-1] * hp[0]
    for k in range(len(x_t) - 2, -1, -1):
        s_1 = bp + c[k + 1] * hp[-1]
        s_2 = lp + c[k + 1] * bp
        hp.append((x_t[k] - s_2 - (1 + c[k]) * s_1) / (1 + c[k] + c[k] ** 2))
        bp = s_1 + c[k] * hp[-1]
        lp = s_2 + c[k] * bp
    return signal(hp[::-1])


def hpf_b3s1r_state_variable(x: npt.ArrayLike, f_c: npt.ArrayLike, dt: Real) -> Signal:
    """Apply the first-order high-pass stage as a state-variable filter, reverse.

    Equation:
        x = hp + lp, lp' = ω hp by the trapezoidal rule from the latest sample to the earliest,
        with ω = (2/Δt) c, (A.7) and (A.11): lp_k = s + c_k hp_k, s = lp_{k+1} + c_{k+1} hp_{k+1},
        hp_k = (x_k - s) / (1 + c_k). Start: hp_K = y(t_K) of (A.18), lp_K = x_K - hp_K.

    Args:
        x: input signal, shape (K,).
        f_c: cut-off frequency at every sample, Hz (or 1/λ_c, 1/m), shape (K,).
        dt: sampling period Δt, s (or distance interval, m).

    Returns:
        The output hp, shape (K,), in the unit of x.

    Raises:
        ValueError: unless every sample has its cut-off and 0 < f_c Δt < 0.5.
    """
    x_t, c = _signal_and_substitutions(x, f_c, dt)
    hp = a3.hpf_b3s1r_start(x_t, a1.hpf_b3s1_coefficients(c[-1]))
    lp = x_t[-1] - hp[0]
    for k in range(len(x_t) - 2, -1, -1):
        s = lp + c[k + 1] * hp[-1]
        hp.append((x_t[k] - s) / (1 + c[k]))
        lp = s + c[k] * hp[-1]
    return signal(hp[::-1])
