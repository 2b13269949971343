"""Localized roughness, in both meanings of the word."""

from typing import NamedTuple

import numpy.typing as npt

from floatref_reference.chapter_2.section_2_1_3_roughness_profiles import (
    BASE_LENGTH,
    short_interval_roughness,
)
from floatref_reference.ride_measures.areas import areas_above
from floatref_reference.signals import Real, Samples, mean, samples

BUMP_LIMIT = 0.00381


class Place(NamedTuple):
    """Where a road is rough.

    Attributes:
        start: m from the first point.
        end: m from the first point.
        peak_at: m from the first point.
        peak: highest roughness, m/km, or largest deviation, m, negative for a dip.
    """

    start: float
    end: float
    peak_at: float
    peak: Real


def localized_roughness(
    z: npt.ArrayLike, dx: float, threshold: float, base: float = BASE_LENGTH
) -> list[Place]:
    """List the areas of localized roughness by continuous IRI.

    Equation: AASHTO R 54: areas in which the IRI over 7.62 m (25 ft), which is the short-interval
    roughness profile of section 2.1.3, exceeds a threshold. Value k belongs to the interval from
    x_k to x_{k+1}.

    Args:
        z: elevation, m, shape (N,).
        dx: constant interval Δx, m.
        threshold: the threshold, m/km.
        base: base length, m.

    Returns:
        The areas, in order.
    """
    roughness = short_interval_roughness(z, dx, base)
    return [
        Place(area.first * dx, (area.last + 1) * dx, (area.peak + 0.5) * dx, roughness[area.peak])
        for area in areas_above(roughness, threshold)
    ]


def half_window(dx: float, base: float) -> int:
    """Count the points of a centred moving average on one side of its centre.

    Equation:
        n = round(B / (2 Δx)), at least 1

    Args:
        dx: constant interval Δx, m.
        base: base length B, m.

    Returns:
        n.
    """
    return max(round(base / 2 / dx), 1)


def deviation(z: npt.ArrayLike, dx: float, base: float = BASE_LENGTH) -> Samples:
    """Compare a profile with its centred moving average.

    Equation: Tex-1001-S: d(x_k) = z(x_k) - (z(x_{k-n}) + … + z(x_{k+n})) / (2n + 1), where the
    whole window is on the profile.

    Args:
        z: mean elevation of both wheel paths, m, shape (N,).
        dx: constant interval Δx, m.
        base: base length, m.

    Returns:
        d, m, for k from n to N-1-n.
    """
    z_x, n = samples(z), half_window(dx, base)
    return [z_x[k] - mean(z_x[k - n : k + n + 1]) for k in range(n, len(z_x) - n)]


def bumps_and_dips(
    z: npt.ArrayLike, dx: float, limit: float = BUMP_LIMIT, base: float = BASE_LENGTH
) -> list[Place]:
    """List bumps and dips.

    Equation:
        Tex-1001-S: a bump is where d of `deviation` exceeds 0.150 in, a dip where -d does.

    Args:
        z: mean elevation of both wheel paths, m, shape (N,).
        dx: constant interval Δx, m.
        limit: the limit, m.
        base: base length, m.

    Returns:
        Bumps and dips, in order.
    """
    d, n = deviation(z, dx, base), half_window(dx, base)
    found: list[Place] = []
    if d:
        for signed in (d, [-value for value in d]):
            for area in areas_above(signed, limit):
                first, last, peak = (n + k for k in area)
                found.append(Place(first * dx, last * dx, peak * dx, d[area.peak]))
    return sorted(found)
