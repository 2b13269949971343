"""A.2 with a cut-off of its own at each sample, as section 5.7 adjusts it.

The coefficients D_i and N_i belong to the sample whose output is computed; they multiply earlier
inputs and outputs as those are. Every function takes the signal x, the cut-off f_c at every
sample and the sampling period dt: Hz and s in time, 1/m and m in distance (A.5). The output has
the unit and the length of x.
"""

import numpy.typing as npt

from floatref_reference.appendix_a import initialization as a3
from floatref_reference.appendix_a import table_a_1 as a1
from floatref_reference.appendix_a.digitization import substitution
from floatref_reference.signals import ZERO, Real, Samples, Signal, samples, signal


def substitutions(f_c: npt.ArrayLike, dt: Real) -> Samples:
    """Compute the substitution c of Table A.1 at every sample.

    Equation:
        (A.11) c(t_k) = tan(π f_c(t_k) Δt)

    Args:
        f_c: cut-off frequency at every sample, Hz, shape (K,).
        dt: sampling period Δt, s.

    Returns:
        c(t_1) … c(t_K), dimensionless.

    Raises:
        ValueError: unless 0 < f_c Δt < 0.5 at every sample.
    """
    return [substitution(f_c_k, dt) for f_c_k in samples(f_c)]


def forward_varying(x: npt.ArrayLike, rows: list[a1.Coefficients], start: Samples) -> Samples:
    """Run a stage with coefficients of its own at each sample, earliest sample first.

    Equation:
        (A.9) with D_i(t_k) and N_i(t_k):
        y(t_k) = (Σ_{i=0}^n N_i(t_k) x(t_{k-i}) - Σ_{i=1}^n D_i(t_k) y(t_{k-i})) / D_0(t_k)

    Args:
        x: input signal, shape (K,).
        rows: rows of Table A.1 for t_1 … t_K.
        start: y(t_1) … y(t_n) of section A.3; only y(t_1) if K = 1.

    Returns:
        Output samples y(t_1) … y(t_K), in the unit of x.

    Raises:
        ValueError: unless every sample has its cut-off.
    """
    x_t, y, n = samples(x), list(start), len(rows[0].D) - 1
    if len(rows) != len(x_t):
        raise ValueError(f"{len(rows)} cut-offs do not fit a signal of {len(x_t)} samples")
    for k in range(n, len(x_t)):
        D, N = rows[k]
        right_side = ZERO
        for i in range(n + 1):
            right_side += N[i] * x_t[k - i]
        for i in range(1, n + 1):
            right_side -= D[i] * y[k - i]
        y.append(right_side / D[0])
    return y


def hpf_b3s2_varying_start(x: npt.ArrayLike, rows: list[a1.Coefficients]) -> Samples:
    """Initialize the second-order high-pass stage with a varying cut-off.

    Equation:
        (A.15) with the coefficients of the sample that is started:
        y(t_1) = -((D_1 + D_2) / D_0)(t_1) x(t_1), and
        y(t_2) = (N_0 x(t_2) + (N_1 + N_2) x(t_1) - (D_1 + D_2) y(t_1)) / D_0 with those of t_2

    Args:
        x: input signal, shape (K,).
        rows: rows HPF_B3S2 of Table A.1 for t_1 … t_K.

    Returns:
        [y(t_1), y(t_2)], in the unit of x; only y(t_1) if K = 1.
    """
    x_t = samples(x)
    y = a3.hpf_b3s2_start(x_t[:1], rows[0])
    if len(x_t) > 1 and len(rows) > 1:
        D, N = rows[1]
        y.append((N[0] * x_t[1] + (N[1] + N[2]) * x_t[0] - (D[1] + D[2]) * y[0]) / D[0])
    return y


def hpf_b3s1_varying(x: npt.ArrayLike, f_c: npt.ArrayLike, dt: Real) -> Signal:
    """Apply the first-order high-pass stage with a varying cut-off, forward.

    Equation:
        HPF_B3S1: (A.9), Table A.1 with c(t_k), start (A.14) with c(t_1):
        (1 + c_k) y_k = x_k - x_{k-1} + (1 - c_k) y_{k-1}

    Args:
        x: input signal, shape (K,).
        f_c: cut-off frequency at every sample, Hz, shape (K,).
        dt: sampling period Δt, s.

    Returns:
        Output signal, shape (K,), in the unit of x.

    Raises:
        ValueError: unless every sample has its cut-off and 0 < f_c Δt < 0.5.
    """
    rows = [a1.hpf_b3s1_coefficients(c_k) for c_k in substitutions(f_c, dt)]
    return signal(forward_varying(x, rows, a3.hpf_b3s1_start(x, rows[0])))


def hpf_b3s2_varying(x: npt.ArrayLike, f_c: npt.ArrayLike, dt: Real) -> Signal:
    """Apply the second-order high-pass stage with a varying cut-off, forward.

    Equation:
        HPF_B3S2: (A.9), Table A.1 with c(t_k), start (A.15) with c(t_1) and c(t_2):
        (1 + c + c²) y_k = x_k - 2 x_{k-1} + x_{k-2} - 2 (c² - 1) y_{k-1} - (1 - c + c²) y_{k-2}
        with c = c_k

    Args:
        x: input signal, shape (K,).
        f_c: cut-off frequency at every sample, Hz, shape (K,).
        dt: sampling period Δt, s.

    Returns:
        Output signal, shape (K,), in the unit of x.

    Raises:
        ValueError: unless every sample has its cut-off and 0 < f_c Δt < 0.5.
    """
    rows = [a1.hpf_b3s2_coefficients(c_k) for c_k in substitutions(f_c, dt)]
    return signal(forward_varying(x, rows, hpf_b3s2_varying_start(x, rows)))


def hpf_b3s1r_varying(x: npt.ArrayLike, f_c: npt.ArrayLike, dt: Real) -> Signal:
    """Apply the first-order high-pass stage with a varying cut-off, reverse.

    Equation:
        HPF_B3S1R: (A.10) and (A.18) with c(t_k), which are (A.9) and (A.14) from the latest
        sample to the earliest.

    Args:
        x: input signal, shape (K,).
        f_c: cut-off frequency at every sample, Hz, shape (K,).
        dt: sampling period Δt, s.

    Returns:
        Output signal, shape (K,), in the unit of x.

    Raises:
        ValueError: unless every sample has its cut-off and 0 < f_c Δt < 0.5.
    """
    return hpf_b3s1_varying(samples(x)[::-1], samples(f_c)[::-1], dt)[::-1]


def hpf_b3s2r_varying(x: npt.ArrayLike, f_c: npt.ArrayLike, dt: Real) -> Signal:
    """Apply the second-order high-pass stage with a varying cut-off, reverse.

    Equation:
        HPF_B3S2R: (A.10) and (A.19) mended with c(t_k), which are (A.9) and (A.15) from the
        latest sample to the earliest.

    Args:
        x: input signal, shape (K,).
        f_c: cut-off frequency at every sample, Hz, shape (K,).
        dt: sampling period Δt, s.

    Returns:
        Output signal, shape (K,), in the unit of x.

    Raises:
        ValueError: unless every sample has its cut-off and 0 < f_c Δt < 0.5.
    """
    return hpf_b3s2_varying(samples(x)[::-1], samples(f_c)[::-1], dt)[::-1]
