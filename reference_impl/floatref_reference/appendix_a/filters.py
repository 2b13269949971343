"""The designated filter stages and filter sets of appendix A.

Every function takes the signal x, the cut-off f_c and the sampling period dt. In the time
domain these are Hz and s. In the distance domain (A.5) they are the inverse cut-off wavelength
f_c = 1/λ_c in 1/m and dt = Δx in m. The output has the unit and the length of x.

A stage driven by c = tan(π f_c Δt) itself is `forward` or `backward` of `digitization` with a row
of `table_a_1` and its start from `initialization`.
"""

import numpy.typing as npt

from floatref_reference.appendix_a import initialization as a3
from floatref_reference.appendix_a import table_a_1 as a1
from floatref_reference.appendix_a.digitization import backward, forward, substitution
from floatref_reference.signals import Real, Signal, signal


def lpf_b3s1(x: npt.ArrayLike, f_c: Real, dt: Real) -> Signal:
    """Apply the first-order low-pass stage, forward.

    Equation:
        LPF_B3S1: (A.9), Table A.1, start (A.12).

    Args:
        x: input signal, shape (K,).
        f_c: cut-off frequency, Hz.
        dt: sampling period Δt, s.

    Returns:
        Output signal, shape (K,), in the unit of x.
    """
    row = a1.lpf_b3s1_coefficients(substitution(f_c, dt))
    return signal(forward(x, row, a3.lpf_b3s1_start(x, row)))


def lpf_b3s2(x: npt.ArrayLike, f_c: Real, dt: Real) -> Signal:
    """Apply the second-order low-pass stage, forward.

    Equation:
        LPF_B3S2: (A.9), Table A.1, start (A.13).

    Args:
        x: input signal, shape (K,).
        f_c: cut-off frequency, Hz.
        dt: sampling period Δt, s.

    Returns:
        Output signal, shape (K,), in the unit of x.
    """
    row = a1.lpf_b3s2_coefficients(substitution(f_c, dt))
    return signal(forward(x, row, a3.lpf_b3s2_start(x, row)))


def lpf_b3s1r(x: npt.ArrayLike, f_c: Real, dt: Real) -> Signal:
    """Apply the first-order low-pass stage, reverse.

    Equation:
        LPF_B3S1R: (A.10), Table A.1, start (A.16).

    Args:
        x: input signal, shape (K,).
        f_c: cut-off frequency, Hz.
        dt: sampling period Δt, s.

    Returns:
        Output signal, shape (K,), in the unit of x.
    """
    row = a1.lpf_b3s1_coefficients(substitution(f_c, dt))
    return signal(backward(x, row, a3.lpf_b3s1r_start(x, row)))


def lpf_b3s2r(x: npt.ArrayLike, f_c: Real, dt: Real) -> Signal:
    """Apply the second-order low-pass stage, reverse.

    Equation:
        LPF_B3S2R: (A.10), Table A.1, start (A.17).

    Args:
        x: input signal, shape (K,).
        f_c: cut-off frequency, Hz.
        dt: sampling period Δt, s.

    Returns:
        Output signal, shape (K,), in the unit of x.
    """
    row = a1.lpf_b3s2_coefficients(substitution(f_c, dt))
    return signal(backward(x, row, a3.lpf_b3s2r_start(x, row)))


def hpf_b3s1(x: npt.ArrayLike, f_c: Real, dt: Real) -> Signal:
    """Apply the first-order high-pass stage, forward.

    Equation:
        HPF_B3S1: (A.9), Table A.1, start (A.14).

    Args:
        x: input signal, shape (K,).
        f_c: cut-off frequency, Hz.
        dt: sampling period Δt, s.

    Returns:
        Output signal, shape (K,), in the unit of x.
    """
    row = a1.hpf_b3s1_coefficients(substitution(f_c, dt))
    return signal(forward(x, row, a3.hpf_b3s1_start(x, row)))


def hpf_b3s2(x: npt.ArrayLike, f_c: Real, dt: Real) -> Signal:
    """Apply the second-order high-pass stage, forward.

    Equation:
        HPF_B3S2: (A.9), Table A.1, start (A.15).

    Args:
        x: input signal, shape (K,).
        f_c: cut-off frequency, Hz.
        dt: sampling period Δt, s.

    Returns:
        Output signal, shape (K,), in the unit of x.
    """
    row = a1.hpf_b3s2_coefficients(substitution(f_c, dt))
    return signal(forward(x, row, a3.hpf_b3s2_start(x, row)))


def hpf_b3s1r(x: npt.ArrayLike, f_c: Real, dt: Real) -> Signal:
    """Apply the first-order high-pass stage, reverse.

    Equation:
        HPF_B3S1R: (A.10), Table A.1, start (A.18).

    Args:
        x: input signal, shape (K,).
        f_c: cut-off frequency, Hz.
        dt: sampling period Δt, s.

    Returns:
        Output signal, shape (K,), in the unit of x.
    """
    row = a1.hpf_b3s1_coefficients(substitution(f_c, dt))
    return signal(backward(x, row, a3.hpf_b3s1r_start(x, row)))


def hpf_b3s2r(x: npt.ArrayLike, f_c: Real, dt: Real) -> Signal:
    """Apply the second-order high-pass stage, reverse.

    Equation:
        HPF_B3S2R: (A.10), Table A.1, start (A.19) mended.

    Args:
        x: input signal, shape (K,).
        f_c: cut-off frequency, Hz.
        dt: sampling period Δt, s.

    Returns:
        Output signal, shape (K,), in the unit of x.
    """
    row = a1.hpf_b3s2_coefficients(substitution(f_c, dt))
    return signal(backward(x, row, a3.hpf_b3s2r_start(x, row)))


def lpf_b3(x: npt.ArrayLike, f_c: Real, dt: Real) -> Signal:
    """Apply the third-order low-pass filter, forward.

    Equation:
        LPF_B3 (A.1): LPF_B3S1, then LPF_B3S2.

    Args:
        x: input signal, shape (K,).
        f_c: cut-off frequency, Hz.
        dt: sampling period Δt, s.

    Returns:
        Output signal, shape (K,), in the unit of x.
    """
    return lpf_b3s2(lpf_b3s1(x, f_c, dt), f_c, dt)


def lpf_b3x2(x: npt.ArrayLike, f_c: Real, dt: Real) -> Signal:
    """Apply the sixth-order low-pass set, without phase shift.

    Equation:
        LPF_B3x2 (A.1): LPF_B3S1, LPF_B3S2R, LPF_B3S1R, LPF_B3S2, in this order.

    Args:
        x: input signal, shape (K,).
        f_c: cut-off frequency, Hz.
        dt: sampling period Δt, s.

    Returns:
        Output signal, shape (K,), in the unit of x.
    """
    y = lpf_b3s1(x, f_c, dt)
    y = lpf_b3s2r(y, f_c, dt)
    y = lpf_b3s1r(y, f_c, dt)
    return lpf_b3s2(y, f_c, dt)


def hpf_b3(x: npt.ArrayLike, f_c: Real, dt: Real) -> Signal:
    """Apply the third-order high-pass filter, forward.

    Equation:
        HPF_B3 (A.1): HPF_B3S1, then HPF_B3S2.

    Args:
        x: input signal, shape (K,).
        f_c: cut-off frequency, Hz.
        dt: sampling period Δt, s.

    Returns:
        Output signal, shape (K,), in the unit of x.
    """
    return hpf_b3s2(hpf_b3s1(x, f_c, dt), f_c, dt)


def hpf_b3x2(x: npt.ArrayLike, f_c: Real, dt: Real) -> Signal:
    """Apply the sixth-order high-pass set, without phase shift.

    Equation:
        HPF_B3x2 (A.1): HPF_B3S1, HPF_B3S2R, HPF_B3S1R, HPF_B3S2, in this order.

    Args:
        x: input signal, shape (K,).
        f_c: cut-off frequency, Hz.
        dt: sampling period Δt, s.

    Returns:
        Output signal, shape (K,), in the unit of x.
    """
    y = hpf_b3s1(x, f_c, dt)
    y = hpf_b3s2r(y, f_c, dt)
    y = hpf_b3s1r(y, f_c, dt)
    return hpf_b3s2(y, f_c, dt)
