"""2.1.3 Roughness Profiles."""

import numpy as np
import numpy.typing as npt

from floatref_reference.chapter_2.section_2_1_1_iri import iri_trace
from floatref_reference.signals import Signal, mean, signal

BASE_LENGTH = 7.62


def short_interval_roughness(z: npt.ArrayLike, dx: float, base: float = BASE_LENGTH) -> Signal:
    """Compute the short-interval roughness profile.

    Equation:
        Section 2.1.3: rectify the trace of steps 1 to 3 of section 2.1.1, then average it from
        half a base length upstream to half a base length downstream. The base length is
        7.62 m; the "7.26" printed once is a slip. The window holds round(B/Δx) samples, the
        extra upstream one included if that is even, and is cut off at the ends of the profile.

    Args:
        z: elevation, m, shape (N,), N ≥ 2.
        dx: constant interval Δx, m.
        base: base length B, m.

    Returns:
        Roughness, m/km, shape (N-1,).
    """
    rectified = np.abs(iri_trace(z, dx))
    n = max(round(base / dx), 1)
    upstream = n // 2
    return signal(
        [mean(rectified[max(k - upstream, 0) : k - upstream + n]) for k in range(len(rectified))]
    )


def peak_roughness(z: npt.ArrayLike, dx: float, base: float = BASE_LENGTH) -> np.longdouble:
    """Find the severity of the worst localized roughness.

    Equation:
        Section 2.1.3: highest value of the short-interval roughness profile.

    Args:
        z: elevation, m, shape (N,), N ≥ 2.
        dx: constant interval Δx, m.
        base: base length B, m.

    Returns:
        Peak roughness, m/km.
    """
    return np.longdouble(short_interval_roughness(z, dx, base).max())
