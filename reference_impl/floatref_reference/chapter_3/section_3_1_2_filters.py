"""3.1.2 Profilers: the high-pass filters of Table 3.2, and sample and hold (3.3.7.1).

Print names the filters and has no equations of them. Third- and sixth-order Butterworth filters are
`conventional_high_pass` and `bidirectional_high_pass` of section 2.2.2. An anti-smoothing moving
average is what is left when the average is taken away. Of the cotangent filter neither order nor
poles are known: taken here are equal first-order sections whose constant is a cotangent, the
inverse of (A.11). Section 3.3.5.2 has that the filter is recursive and runs forward.
"""

from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from floatref_reference.appendix_a.designations import hpf_b3
from floatref_reference.signals import PI, Real, Samples, Signal, mean, samples, signal

LAMBDA_C = 91.44
"""Cut-off wavelength of Profilers 3, 4 and 6, m."""
BASE_LENGTH = 70.0
"""Base length of Profiler 5, m. Table 3.2 lists it as a cut-off wavelength; as a base length it
loses 3 dB at 92.7 m, close to the others."""
ORDER = 3
"""First-order sections of the cotangent filter: assumed, print has no number."""


class Filter(NamedTuple):
    """A row of Table 3.2.

    Args:
        profiler: number of the profiler.
        kind: name of its filter, "" for a profiler without one.
        length: cut-off wavelength, m; 0 without a filter.
    """

    profiler: int
    kind: str
    length: float


TABLE_3_2 = (
    Filter(1, "", 0.0),
    Filter(2, "", 0.0),
    Filter(3, "Butterworth, 3rd order", LAMBDA_C),
    Filter(4, "Butterworth, 6th order", LAMBDA_C),
    Filter(5, "moving average, anti-smoothing", BASE_LENGTH),
    Filter(6, "cotangent", LAMBDA_C),
)
"""Table 3.2."""


def half_width(dx: Real, base: Real = BASE_LENGTH) -> int:
    """Count the samples of a moving average to either side of its middle.

    Equation:
        Table 3.2, moving average: m = round((B/Δx - 1)/2), so that 2m + 1 samples cover B.

    Args:
        dx: constant interval Δx, m.
        base: base length B, m.

    Returns:
        m.
    """
    return max(round((float(base) / float(dx) - 1) / 2), 0)


def anti_smoothing(z: npt.ArrayLike, dx: Real, base: Real = BASE_LENGTH) -> Signal:
    """High-pass filter a profile by taking away its moving average.

    Equation:
        Table 3.2, "moving average, anti-smoothing":
        y(x_k) = z(x_k) - (z(x_{k-m}) + … + z(x_{k+m}))/(2m + 1). Near an end m is what fits.

    Args:
        z: elevation, m, shape (N,).
        dx: constant interval Δx, m.
        base: base length B, m.

    Returns:
        Filtered profile, m, shape (N,).
    """
    z_x, m = samples(z), half_width(dx, base)
    y: Samples = []
    for k in range(len(z_x)):
        reach = min(m, k, len(z_x) - 1 - k)
        y.append(z_x[k] - mean(z_x[k - reach : k + reach + 1]))
    return signal(y)


def anti_smoothing_response(wavelength: Real, dx: Real, base: Real = BASE_LENGTH) -> complex:
    """Compute gain and phase of the anti-smoothing filter.

    Equation:
        H = 1 - sin((2m + 1) πΔx/λ)/((2m + 1) sin(πΔx/λ)) of Table 3.2's filter: real, no phase.

    Args:
        wavelength: λ, m, more than 2 Δx.
        dx: constant interval Δx, m.
        base: base length B, m.

    Returns:
        H, dimensionless.
    """
    n, angle = 2 * half_width(dx, base) + 1, PI * np.longdouble(dx) / np.longdouble(wavelength)
    return complex(1 - np.sin(n * angle) / (n * np.sin(angle)))


def cotangent_constant(dx: Real, lambda_c: Real = LAMBDA_C, order: int = ORDER) -> np.longdouble:
    """Compute the constant of each section of the cotangent filter.

    Equation:
        κ = cot(πΔx/λ_c)/√(2^(1/n) - 1), so that n sections lose 3 dB at λ_c; of one section it is
        the inverse of c in (A.11). For Table 3.2, by assumption.

    Args:
        dx: constant interval Δx, m.
        lambda_c: cut-off wavelength λ_c, m.
        order: sections n.

    Returns:
        κ, dimensionless.
    """
    cotangent = 1 / np.tan(PI * np.longdouble(dx) / np.longdouble(lambda_c))
    return np.longdouble(cotangent / np.sqrt(2 ** (1 / np.longdouble(order)) - 1))


def cotangent(z: npt.ArrayLike, dx: Real, lambda_c: Real = LAMBDA_C, order: int = ORDER) -> Signal:
    """High-pass filter a profile by the cotangent filter, forward.

    Equation:
        Table 3.2, "cotangent", by assumption; each section is
        y(x_k) = (κ (x_k - x_{k-1}) + (κ - 1) y(x_{k-1}))/(κ + 1), from y = 0.

    Args:
        z: elevation, m, shape (N,).
        dx: constant interval Δx, m.
        lambda_c: cut-off wavelength λ_c, m.
        order: sections n.

    Returns:
        Filtered profile, m, shape (N,).
    """
    kappa, y = cotangent_constant(dx, lambda_c, order), samples(z)
    for _ in range(order):
        x, y = y, [np.longdouble(0)]
        for k in range(1, len(x)):
            y.append((kappa * (x[k] - x[k - 1]) + (kappa - 1) * y[k - 1]) / (kappa + 1))
    return signal(y)


def cotangent_response(
    wavelength: Real, dx: Real, lambda_c: Real = LAMBDA_C, order: int = ORDER
) -> complex:
    """Compute gain and phase of the cotangent filter.

    Equation:
        H = (ju/(1 + ju))^n with u = κ tan(πΔx/λ): gain (u²/(1 + u²))^(n/2), phase n atan(1/u). Of
        Table 3.2's filter, by assumption.

    Args:
        wavelength: λ, m, more than 2 Δx.
        dx: constant interval Δx, m.
        lambda_c: cut-off wavelength λ_c, m.
        order: sections n.

    Returns:
        H, dimensionless; a positive phase means ahead.
    """
    kappa = cotangent_constant(dx, lambda_c, order)
    u = float(kappa * np.tan(PI * np.longdouble(dx) / np.longdouble(wavelength)))
    return complex((1j * u / (1 + 1j * u)) ** order)


def butterworth_response(
    wavelength: Real, dx: Real, lambda_c: Real = LAMBDA_C, both_ways: bool = False
) -> complex:
    """Compute gain and phase of the Butterworth filters of Profilers 3 and 4.

    Equation:
        (A.1) at s = j tan(πΔx/λ) with ω_a = tan(πΔx/λ_c), the bilinear transformation (A.6); in
        both directions |H|², as Profiler 4's sixth order in Table 3.2.

    Args:
        wavelength: λ, m, more than 2 Δx.
        dx: constant interval Δx, m.
        lambda_c: cut-off wavelength λ_c of the third-order pass, m.
        both_ways: whether the filter runs forward and back.

    Returns:
        H, dimensionless.
    """
    s, omega_a = (
        float(np.tan(PI * np.longdouble(dx) / np.longdouble(length)))
        for length in (wavelength, lambda_c)
    )
    H = hpf_b3(1j * s, omega_a)
    return complex(abs(H) ** 2) if both_ways else H


def sample_and_hold(z: npt.ArrayLike, v: npt.ArrayLike, v_hold: Real) -> Signal:
    """Hold a profile while the profiler is slow.

    Equation:
        Section 3.3.7.1, Profilers 1 and 6: the elevation is "held at a constant value" below a
        speed that print does not have, which "eliminated the step change", so that what follows
        goes on from the held value. y(x_k) = y(x_{k-1}) + z(x_k) - z(x_{k-1}) where
        v(x_k) ≥ v_hold, else y(x_{k-1}).

    Args:
        z: elevation, m, shape (N,).
        v: speed at the same points, m/s, shape (N,).
        v_hold: speed below which the elevation is held, m/s.

    Returns:
        Profile, m, shape (N,).
    """
    z_x, v_x = samples(z), samples(v)
    y: Samples = [z_x[0]]
    for k in range(1, len(z_x)):
        y.append(y[k - 1] + (z_x[k] - z_x[k - 1] if v_x[k] >= v_hold else 0))
    return signal(y)


def held_length(v_hold: Real, deceleration: Real, acceleration: Real) -> np.longdouble:
    """Compute over which length a stop is held.

    Equation:
        Section 3.3.7.1: v_hold²/2 (1/a_0 + 1/a_1), braking and setting off steadily.

    Args:
        v_hold: speed below which the elevation is held, m/s.
        deceleration: before the stop, m/s², positive.
        acceleration: after it, m/s².

    Returns:
        Length of the flat area, m.
    """
    v = np.longdouble(v_hold)
    return v**2 / 2 * (1 / np.longdouble(deceleration) + 1 / np.longdouble(acceleration))
