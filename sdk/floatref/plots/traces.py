"""Lines and shading of long profiles, thinned to what a drawing can show."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from floatref.errors import InputError
from floatref.measures import iri, short_interval_roughness
from floatref.values.arrays import BoolArray, FloatArray

if TYPE_CHECKING:
    from matplotlib.axes import Axes

BINS = 3000
"""Most stretches that a line is thinned to; each keeps its lowest and its highest value."""

COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#56B4E9", "#E69F00")
REFERENCE_COLOUR = "0.25"
SHADE = "#F0C9C0"


def thinned(x: FloatArray, y: FloatArray, bins: int = BINS) -> tuple[FloatArray, FloatArray]:
    """Return points that draw the same line: of each stretch the lowest and the highest value.

    NaN counts only where a stretch has nothing else. Short lines are returned as they are.
    """
    if y.size <= 2 * bins:
        return x, y
    starts = np.linspace(0, y.size, bins, endpoint=False).astype(np.intp)
    low, high = np.fmin.reduceat(y, starts), np.fmax.reduceat(y, starts)
    middle = (x[starts] + x[np.append(starts[1:], y.size) - 1]) / 2.0
    return np.repeat(middle, 2), np.stack([low, high], axis=1).ravel()


def line(ax: Axes, x: FloatArray, y: FloatArray, **style: Any) -> None:
    """Draw ``y`` over ``x`` on ``ax``, thinned."""
    ax.plot(*thinned(x, y), **{"linewidth": 0.9, **style})


def shade(ax: Axes, x: FloatArray, invalid: BoolArray, label: str | None = None) -> None:
    """Shade the stretches of ``x`` where ``invalid`` is true; nothing if there are none."""
    if not invalid.any():
        return
    places, share = thinned(x, invalid.astype(np.float64))
    # Of a stretch with one bad point the highest value is 1; its outline is wide enough to see.
    ax.fill_between(
        places,
        0.0,
        1.0,
        where=share > 0,
        step="mid",
        color=SHADE,
        linewidth=1.0,
        transform=ax.get_xaxis_transform(),
        zorder=0.5,
        label=label,
    )


def in_readable_unit(*elevations: FloatArray) -> tuple[float, str]:
    """Return the factor from m and the unit in which ``elevations`` are drawn: mm or m."""
    spans = [np.nanmax(z) - np.nanmin(z) for z in elevations if np.isfinite(z).any()]
    return (1000.0, "mm") if max(spans, default=0.0) < 0.5 else (1.0, "m")


def roughness(elevation: FloatArray, interval_m: float) -> tuple[FloatArray, float]:
    """Return short-interval roughness profile and IRI in m/km; NaN for a profile without them."""
    try:
        return short_interval_roughness(elevation, interval_m), iri(elevation, interval_m)
    except InputError:
        return np.full(max(elevation.size - 1, 0), np.nan), float("nan")
