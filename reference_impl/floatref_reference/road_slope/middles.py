"""Second differences, means and rates at the middles, nodes with a neighbour on both sides."""

from collections.abc import Sequence

from floatref_reference.road_slope.symbols import Stretch, Values, Vector, has_both_sides

Series = Sequence[Values] | Vector
"""One value for each node."""


def middles(stretch: Stretch) -> list[int]:
    """Return the nodes with a neighbour at Δ on both sides.

    Equation:
        0 < k < K-1, and no standstill was cut beside k

    Args:
        stretch: what is known.
    """
    return [k for k in range(len(stretch.readings.place)) if has_both_sides(stretch, k)]


def bent(y: Series, k: int, interval: float) -> Values:
    """Return the second difference.

    Equation:
        D_k(y) = (y_{k-1} - 2 y_k + y_{k+1})/Δ²

    Args:
        y: values at all nodes, of shape () or (m,) each.
        k: a middle.
        interval: Δ, s.

    Returns:
        D_k(y), per s², shape () or (m,).
    """
    difference: Values = (y[k - 1] - 2 * y[k] + y[k + 1]) / interval**2
    return difference


def mean(y: Series, k: int) -> Values:
    """Return the mean of what is smooth, with the shares that the second difference has.

    Equation:
        ⟨y⟩_k = (y_{k-1} + 10 y_k + y_{k+1})/12

    Args:
        y: values at all nodes, of shape () or (m,) each.
        k: a middle.

    Returns:
        ⟨y⟩_k, shape () or (m,).
    """
    shared: Values = (y[k - 1] + 10 * y[k] + y[k + 1]) / 12
    return shared


def rate(y: Series, k: int, interval: float) -> Values:
    """Return the mean rate.

    Equation:
        ⟨ẏ⟩_k = (y_{k+1} - y_{k-1})/(2Δ)

    Args:
        y: values at all nodes, of shape () or (m,) each.
        k: a middle.
        interval: Δ, s.

    Returns:
        ⟨ẏ⟩_k, per s, shape () or (m,).
    """
    change: Values = (y[k + 1] - y[k - 1]) / (2 * interval)
    return change
