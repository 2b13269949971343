"""2.2 Signal Flow: signal interaction (2.2.1) and high-pass filtering (2.2.2)."""

import numpy as np
import numpy.typing as npt

from floatref_reference.appendix_a.filters import hpf_b3, hpf_b3x2
from floatref_reference.signals import STANDARD_GRAVITY, Real, Samples, Signal, samples, signal


def spatial_acceleration(a_zp: npt.ArrayLike, v_xp: npt.ArrayLike) -> Signal:
    """Convert temporal acceleration to spatial acceleration.

    Equation:
        Section 2.2.1, step 2: a_zp(x_k) / v_xp(x_k)². It holds at constant speed; a change
        of speed adds the term -(dz/dx) a_xp / v_xp², which the step leaves out.

    Args:
        a_zp: vertical acceleration with 1 g removed at a constant distance interval, m/s²,
            shape (K,).
        v_xp: forward speed at the same points, m/s, shape (K,), never zero.

    Returns:
        Spatial acceleration, 1/m, shape (K,).
    """
    return signal([a / v**2 for a, v in zip(samples(a_zp), samples(v_xp), strict=True)])


def floating_reference_height(a_zx: npt.ArrayLike, dx: float) -> Signal:
    """Integrate the spatial acceleration twice in the distance domain.

    Equation:
        Section 2.2.1, step 3, by the trapezoidal rule, from zero slope and zero height.

    Args:
        a_zx: spatial acceleration, 1/m, shape (K,).
        dx: constant distance interval Δx, m.

    Returns:
        Floating reference height, m, shape (K,).
    """
    return signal(_integral(_integral(samples(a_zx), dx), dx))


def _integral(x: Samples, dx: float) -> Samples:
    y = [np.longdouble(0)]
    for k in range(1, len(x)):
        y.append(y[k - 1] + (x[k] + x[k - 1]) / 2 * np.longdouble(dx))
    return y


def parabolic_rise(bias_g: Real, length: Real, v_xp: Real) -> np.longdouble:
    """Predict the false rise that a steady acceleration leaves.

    Equation:
        Section 2.2.2: a net acceleration a over the time t = L/v rises by a t²/2.

    Args:
        bias_g: net acceleration, in units of g.
        length: distance L, m.
        v_xp: constant speed, m/s.

    Returns:
        Rise at the end, m.
    """
    t = np.longdouble(length) / v_xp
    return bias_g * STANDARD_GRAVITY * t**2 / 2


def conventional_high_pass(z: npt.ArrayLike, dx: float, lambda_c: float = 91.44) -> Signal:
    """High-pass filter a profile in one direction, as it is done in real time.

    Equation:
        Section 2.2.2, figure 2.13: HPF_B3 with a cut-off wavelength of 91.44 m.

    Args:
        z: elevation, m, shape (K,).
        dx: constant distance interval Δx, m.
        lambda_c: cut-off wavelength, m.

    Returns:
        Filtered profile with a phase shift near λ_c, m, shape (K,).
    """
    return hpf_b3(z, 1 / np.longdouble(lambda_c), dx)


def bidirectional_high_pass(z: npt.ArrayLike, dx: float, lambda_c: float = 105.91) -> Signal:
    """High-pass filter a profile in both directions, without phase shift.

    Equation:
        Section 2.2.2, figure 2.14: HPF_B3x2; 105.91 m gives -3 dB at 91.44 m (A.22).

    Args:
        z: elevation, m, shape (K,).
        dx: constant distance interval Δx, m.
        lambda_c: cut-off wavelength of each third-order pass, m.

    Returns:
        Filtered profile, m, shape (K,).
    """
    return hpf_b3x2(z, 1 / np.longdouble(lambda_c), dx)
