"""A straightedge on two wheels, measured in the middle."""

import numpy.typing as npt

from floatref_reference.ride_measures.areas import areas_above
from floatref_reference.ride_measures.localized import Place
from floatref_reference.signals import Samples, samples


def half_length(dx: float, length: float) -> int:
    """Count the intervals from the middle to a wheel.

    Equation:
        n = round(L / (2 Δx)), at least 1

    Args:
        dx: constant interval Δx, m.
        length: length L, m.

    Returns:
        n.
    """
    return max(round(length / 2 / dx), 1)


def midpoint_deviation(z: npt.ArrayLike, dx: float, length: float = 3.048) -> Samples:
    """Measure how far the road rises above the straightedge.

    Equation:
        d(x_k) = z(x_k) - (z(x_{k-n}) + z(x_{k+n})) / 2

    Args:
        z: elevation, m, shape (N,).
        dx: constant interval Δx, m.
        length: length, m.

    Returns:
        d, m, for k from n to N-1-n.
    """
    z_x, n = samples(z), half_length(dx, length)
    return [z_x[k] - (z_x[k - n] + z_x[k + n]) / 2 for k in range(n, len(z_x) - n)]


def beyond_tolerance(
    z: npt.ArrayLike, dx: float, tolerance: float, length: float = 3.048
) -> list[Place]:
    """List where the deviation is larger than a tolerance, upwards or downwards.

    Equation:
        d(x_k) > tolerance, or -d(x_k) > tolerance; the two are areas of their own.

    Args:
        z: elevation, m, shape (N,).
        dx: constant interval Δx, m.
        tolerance: the tolerance, m.
        length: length, m.

    Returns:
        The areas, in order.
    """
    d, n = midpoint_deviation(z, dx, length), half_length(dx, length)
    found: list[Place] = []
    if d:
        for signed in (d, [-value for value in d]):
            for area in areas_above(signed, tolerance):
                first, last, peak = (n + k for k in area)
                found.append(Place(first * dx, last * dx, peak * dx, d[area.peak]))
    return sorted(found)
