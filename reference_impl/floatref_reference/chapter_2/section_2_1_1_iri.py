"""2.1.1 International Roughness Index (IRI): the four steps.

The printed text leaves some conventions open. These are the ones used here:

- Step 2 averages round(0.25 m / Δx) slopes; it is omitted at Δx = 0.25 m and above, and where
  the window holds one slope only. Smoothed slope i is the mean of slopes i … i+n-1; near the
  end, of the slopes that remain. The shift by half a window is constant and moves nothing else.
- The slope is held constant over an interval, which makes the state transition exact.
- The car starts at the mean slope of the first 11 m, both masses at rest relative to it.
- The average runs over all steps, the whole profile being one segment.
"""

import numpy as np
import numpy.typing as npt

from floatref_reference.chapter_2.section_2_1_1_golden_car import suspension_stroke
from floatref_reference.signals import Signal, mean, samples, signal

BASE_LENGTH = 0.25
START_LENGTH = 11.0


def slope(z: npt.ArrayLike, dx: float) -> Signal:
    """Convert the elevation profile to a slope profile.

    Equation:
        Step 1: s(x_k) = (z(x_{k+1}) - z(x_k)) / Δx

    Args:
        z: elevation, m, shape (N,), N ≥ 2.
        dx: constant interval Δx, m.

    Returns:
        Slope, m/m, shape (N-1,).

    Raises:
        ValueError: if the profile has one point or the interval is not positive.
    """
    z_x = samples(z)
    if len(z_x) < 2 or not dx > 0:
        raise ValueError(f"a slope needs two points and a positive interval: {len(z_x)}, {dx}")
    return signal([(z_x[k + 1] - z_x[k]) / np.longdouble(dx) for k in range(len(z_x) - 1)])


def moving_average(s: npt.ArrayLike, dx: float, base: float = BASE_LENGTH) -> Signal:
    """Smooth the slope profile like the tyre that envelops short features.

    Equation:
        Step 2, with n = round(B/Δx): y(x_k) = (s(x_k) + … + s(x_{k+n-1})) / n

    Args:
        s: slope, m/m, shape (K,).
        dx: constant interval Δx, m.
        base: base length B, m; 0 leaves the step out.

    Returns:
        Smoothed slope, m/m, shape (K,).
    """
    s_x, n = samples(s), round(base / dx)
    if dx >= base or n <= 1:
        return signal(s_x)
    return signal([mean(s_x[k : k + n]) for k in range(len(s_x))])


def start_slope(z: npt.ArrayLike, dx: float, length: float = START_LENGTH) -> np.longdouble:
    """Measure the slope on which the car starts.

    Equation:
        (z(x_1 + 11 m) - z(x_1)) / 11 m, at the point nearest to 11 m or at the last one.

    Args:
        z: elevation, m, shape (N,), N ≥ 2.
        dx: constant interval Δx, m.
        length: start length, m.

    Returns:
        Mean slope, m/m.
    """
    z_x = samples(z)
    n = min(max(round(length / dx), 1), len(z_x) - 1)
    return (z_x[n] - z_x[0]) / (n * np.longdouble(dx))


def iri_trace(z: npt.ArrayLike, dx: float, speed_kmh: float = 80.0) -> Signal:
    """Compute the signal that the IRI averages and that cross correlation compares.

    Equation:
        Steps 1 to 3 of section 2.1.1.

    Args:
        z: elevation, m, shape (N,), N ≥ 2.
        dx: constant interval Δx, m.
        speed_kmh: simulated speed, km/h.

    Returns:
        Signed spatial velocity across the suspension, m/km, shape (N-1,).
    """
    smoothed = moving_average(slope(z, dx), dx)
    return 1000 * suspension_stroke(smoothed, dx, start_slope(z, dx), speed_kmh)


def iri(z: npt.ArrayLike, dx: float, speed_kmh: float = 80.0) -> np.longdouble:
    """Compute the IRI of a whole profile.

    Equation:
        Section 2.1.1, step 4: average rectified value of the trace of steps 1 to 3.

    Args:
        z: elevation, m, shape (N,), N ≥ 2.
        dx: constant interval Δx, m.
        speed_kmh: simulated speed, km/h; other than 80 gives the GCARS.

    Returns:
        IRI, m/km.
    """
    return mean(np.abs(iri_trace(z, dx, speed_kmh)))
