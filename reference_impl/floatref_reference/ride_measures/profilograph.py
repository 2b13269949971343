"""A profilograph by its geometry, and its trace read by the rules of California Test 526.

The places of all wheels of a California profilograph are in ASTM E2955, which is not public. The
frame of two wheels is the reference line of 25 ft that public texts describe.
"""

import math

import numpy as np
import numpy.typing as npt

from floatref_reference.appendix_a.cut_off import low_pass_cut_off
from floatref_reference.appendix_a.filters import lpf_b3x2
from floatref_reference.ride_measures.areas import areas_above
from floatref_reference.ride_measures.localized import Place
from floatref_reference.signals import ZERO, Samples, mean, samples

WHEELS = (-3.81, 3.81)
FOOTPRINT = 0.6096
BLANKING_BAND = 0.00508
LEAST_HEIGHT = 0.000762
LEAST_LENGTH = 0.6096
ROUNDING = 0.00127
BUMP_HEIGHT = 0.00762
BUMP_LENGTH = 7.62


def trace(
    z: npt.ArrayLike, dx: float, wheels: tuple[float, ...] = WHEELS, footprint: float = FOOTPRINT
) -> tuple[int, Samples]:
    """Roll a profilograph along a road.

    Equation: t(x_k) = s(x_k) - (s(x_{k+n_1}) + … + s(x_{k+n_W})) / W, n_w = round(place of wheel w
    / Δx), and s the elevation through LPF_B3x2 (A.1) with -3 dB at the footprint (A.21), unless its
    cut-off is not above two intervals.

    Args:
        z: elevation, m, shape (N,).
        dx: constant interval Δx, m.
        wheels: places of the frame's wheels from the recording wheel, m, on both sides of it.
        footprint: wavelength, m; 0 for no low-pass.

    Returns:
        Index of the first point under the recording wheel, and t, m.
    """
    z_x = samples(z)
    road = [value - z_x[0] for value in z_x]
    if footprint > 0:
        f_c = low_pass_cut_off(1 / np.longdouble(footprint))
        if 1 / f_c > 2 * dx:
            road = samples(lpf_b3x2(road, f_c, dx))
    n = [round(place / dx) for place in wheels]
    first, end = max(0, -min(n)), len(road) - max(0, max(n))
    found: Samples = []
    for k in range(first, end):
        total = ZERO
        for n_w in n:
            total += road[k + n_w]
        found.append(road[k] - total / len(n))
    return first, found


def scallops(t: Samples, dx: float, band: float = BLANKING_BAND) -> Samples:
    """Measure the scallops of one segment of a trace.

    Equation: California Test 526: what is outside the blanking band, here centred on the mean of
    the trace, counts from 0.03 in and 2 ft on; heights are rounded to 0.05 in.

    Args:
        t: trace, m, shape (N,).
        dx: constant interval Δx, m.
        band: height of the blanking band, m.

    Returns:
        Rounded heights, m, those above the band first.
    """
    centre, found = mean(t), []
    for side in (1, -1):
        outside = [side * (value - centre) - np.longdouble(band) / 2 for value in t]
        for area in areas_above(outside, 0):
            height, length = outside[area.peak], (area.last - area.first + 1) * dx
            if height >= LEAST_HEIGHT and length > LEAST_LENGTH - 1e-9:
                found.append(np.longdouble(math.floor(height / ROUNDING + 0.5)) * ROUNDING)
    return found


def profile_index(t: Samples, dx: float, band: float = BLANKING_BAND) -> np.longdouble:
    """Compute the profile index of one segment.

    Equation:
        California Test 526: PI = Σ h / length

    Args:
        t: trace, m, shape (N,).
        dx: constant interval Δx, m.
        band: height of the blanking band, m.

    Returns:
        PI, m/km.
    """
    return np.longdouble(1000 * sum(scallops(t, dx, band), ZERO) / (len(t) * np.longdouble(dx)))


def height_above_base(t: Samples, k: int, span: int) -> np.longdouble:
    """Measure how far a point of the trace is above the base that the template is placed on.

    Equation:
        The template of California Test 526 has a length of 25 ft: the largest of
        min(t_k - t_a, t_k - t_b) over all a ≤ k ≤ b with b - a ≤ span.

    Args:
        t: trace, m, shape (N,).
        k: index of the point.
        span: length of the template in intervals.

    Returns:
        The height, m.
    """
    best = ZERO
    for a in range(max(k - span, 0), k + 1):
        rise = t[k] - t[a]
        if rise > best:
            for b in range(k, min(a + span, len(t) - 1) + 1):
                best = max(best, min(rise, t[k] - t[b]))
    return best


def must_grind(t: Samples, dx: float, height: float = BUMP_HEIGHT) -> list[Place]:
    """List what must be ground.

    Equation:
        Areas in which `height_above_base` exceeds 0.3 in.

    Args:
        t: trace, m, shape (N,).
        dx: constant interval Δx, m.
        height: height of the template, m.

    Returns:
        The areas, in order; places in m from the first value of the trace.
    """
    span = max(round(BUMP_LENGTH / dx), 2)
    heights = [height_above_base(t, k, span) for k in range(len(t))]
    return [
        Place(area.first * dx, area.last * dx, area.peak * dx, heights[area.peak])
        for area in areas_above(heights, height)
    ]
