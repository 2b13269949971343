"""The roughness of a network and its map: the summary of a batch as one drawing."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from floatref.plots.figure import check_suffix, legend, new_figure, save, title
from floatref.plots.network_columns import SUMMARY_COLUMNS, Segments, segments_of
from floatref.plots.network_places import (
    FLAGGED,
    VALID,
    count_of,
    draw_files,
    draw_map,
    quantity,
)
from floatref.values.arrays import FloatArray

if TYPE_CHECKING:
    from matplotlib.axes import Axes

__all__ = ["SUMMARY_COLUMNS", "draw_summary"]

HISTOGRAM_INCHES, MAP_INCHES, FILES_INCHES = 2.6, 5.6, 3.2
BINS = 60


def draw_summary(columns: Mapping[str, Sequence[Any]], path: Path) -> None:
    """Write a drawing of the summary of many files to ``path`` (.png, .pdf or .svg).

    ``columns`` are `SUMMARY_COLUMNS`, a row for each segment of each wheel path and one for each
    file that failed; lengths in m, roughness in m/km, positions in degrees. Above are the
    kilometres over the mean roughness index of valid points, the IRI for a single wheel path, with
    invalid lengths in their own colour. Below is a map of it; without positions the median and the
    range of each file, in order. Segments and files of which not all points are valid have a sign
    of their own. Raises InputError for columns that do not fit, if matplotlib is missing or
    ``path`` cannot be written.
    """
    path = Path(path)
    check_suffix(path)
    found = segments_of(columns)
    located = np.isfinite(found.latitude) & np.isfinite(found.longitude)
    lower = MAP_INCHES if located.any() else FILES_INCHES
    figure, axes = new_figure(2, 1, [HISTOGRAM_INCHES, lower], shared=False)
    top = _top(found.roughness)
    _draw_lengths(axes[0, 0], found, top)
    if located.any():
        draw_map(figure, axes[1, 0], found, located, top)
    else:
        draw_files(axes[1, 0], found, top)
    title(axes[0, 0], _title(found))
    save(figure, path)


def _top(roughness: FloatArray) -> float:
    """Return the largest drawn roughness, so that a few extreme segments do not hide the others."""
    known = roughness[np.isfinite(roughness)]
    if not known.size:
        return 1.0
    return float(max(min(known.max(), 2.0 * np.percentile(known, 98.0)), 0.1))


def _draw_lengths(ax: Axes, found: Segments, top: float) -> None:
    known = np.isfinite(found.roughness)
    place = np.minimum(found.roughness[known], np.nextafter(top, 0.0))
    length_m = np.nan_to_num(found.length_m)
    flagged = np.minimum(np.nan_to_num(found.flagged_m), length_m)
    # Segments without any valid stretch have no place on the axis, but they are part of the share.
    share = flagged.sum() / max(length_m.sum(), 1e-9)
    parts = {
        "valid": ((length_m - flagged)[known], VALID),
        f"not valid: {100.0 * share:.1f} %": (flagged[known], FLAGGED),
    }
    edges = np.linspace(0.0, top, BINS + 1)
    below = np.zeros(BINS)
    for label, (length, colour) in parts.items():
        height = np.histogram(place, edges, weights=length / 1000.0)[0]
        ax.bar(edges[:-1], height, top / BINS, below, align="edge", color=colour, label=label)
        below = below + height
    ax.set_xlim(0.0, top)
    ax.set_ylim(bottom=0.0)
    beyond = int((found.roughness > top).sum())
    more = f"; at the end: {count_of(beyond, 'segment')} above" if beyond else ""
    without_km = float(length_m[~known].sum()) / 1000.0
    more += f"; not drawn: {without_km:.1f} km without an IRI" if without_km else ""
    ax.set_xlabel(f"{quantity(found)} (m/km){more}")
    ax.set_ylabel("Length (km)")
    legend(ax)


def _title(found: Segments) -> str:
    failed, unknown = int(found.failed.sum()), int(np.isnan(found.roughness).sum())
    length_km = float(np.nansum(found.length_m)) / 1000.0
    parts = [
        count_of(len(found.names), "file") + (f" ({failed:,} failed)" if failed else ""),
        f"{length_km:,.1f} km",
        count_of(found.file.size, "segment") + (f" ({unknown:,} without IRI)" if unknown else ""),
    ]
    return ", ".join(parts)
