"""The roughness of a network and its map: the summary of a batch as one drawing."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from floatref.plots.figure import COLOURS, check_suffix, legend, new_figure, save, title
from floatref.plots.network_columns import SUMMARY_COLUMNS, Segments, segments_of
from floatref.values.arrays import BoolArray, FloatArray

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

__all__ = ["SUMMARY_COLUMNS", "draw_summary"]

HISTOGRAM_INCHES, MAP_INCHES, FILES_INCHES = 2.6, 5.6, 3.2
BINS = 60
NAMED = 24
"""Largest number of file names below the drawing; more would overlap."""
LONGEST_NAME = 28
COLOUR_MAP = "turbo"
"""Smooth roads are blue and rough ones dark red; both are visible on white."""
VALID, FLAGGED, UNKNOWN = COLOURS[0], COLOURS[1], "0.7"


def draw_summary(columns: Mapping[str, Sequence[Any]], path: Path) -> None:
    """Write a drawing of the summary of many files to ``path`` (.png, .pdf or .svg).

    ``columns`` are `SUMMARY_COLUMNS`, a row for each segment of each wheel path and one for each
    file that failed; lengths in m, roughness in m/km, positions in degrees. Above are the
    kilometres over the mean roughness index, the IRI for a single wheel path, with invalid lengths
    in their own colour. Below is a map of it; without positions the median and the range of each
    file, in order. Raises InputError for columns that do not fit, if matplotlib is missing or
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
        _draw_map(figure, axes[1, 0], found, located, top)
    else:
        _draw_files(axes[1, 0], found, top)
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
    length_m = np.nan_to_num(found.length_m[known])
    flagged = np.minimum(np.nan_to_num(found.flagged_m[known]), length_m)
    share = flagged.sum() / max(length_m.sum(), 1e-9)
    parts = {
        "valid": (length_m - flagged, VALID),
        f"not valid: {100.0 * share:.1f} %": (flagged, FLAGGED),
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
    more = f"; at the end: {_count(beyond, 'segment')} above" if beyond else ""
    ax.set_xlabel(f"{_quantity(found)} (m/km){more}")
    ax.set_ylabel("Length (km)")
    legend(ax)


def _draw_map(figure: Figure, ax: Axes, found: Segments, located: BoolArray, top: float) -> None:
    known = np.isfinite(found.roughness)
    size = float(np.clip(4000.0 / located.sum(), 3.0, 40.0))
    style: dict[str, Any] = {"s": size, "linewidths": 0.0, "rasterized": True}
    plain, rough = located & ~known, located & known
    ax.scatter(found.longitude[plain], found.latitude[plain], color=UNKNOWN, **style)
    # The roughest last, on top: they matter most.
    order = np.flatnonzero(rough)[np.argsort(found.roughness[rough], kind="stable")]
    dots = ax.scatter(
        found.longitude[order],
        found.latitude[order],
        c=found.roughness[order],
        cmap=COLOUR_MAP,
        vmin=0.0,
        vmax=top,
        **style,
    )
    bar = figure.colorbar(dots, ax=ax, shrink=0.9, extend="max" if _beyond(found, top) else None)
    bar.set_label(f"{_quantity(found)} (m/km)")
    middle = float(np.median(found.latitude[located]))
    # One degree of longitude is shorter than one of latitude by this factor.
    ax.set_aspect(1.0 / max(np.cos(np.radians(middle)), 0.01), adjustable="datalim")
    ax.margins(0.05)
    ax.set_xlabel("Longitude (°)")
    ax.set_ylabel("Latitude (°)")
    if unplaced := int((~located).sum()):
        title(ax, f"{unplaced} of {_count(located.size, 'segment')} without a position")


def _beyond(found: Segments, top: float) -> bool:
    return bool((found.roughness > top).any())


def _draw_files(ax: Axes, found: Segments, top: float) -> None:
    known = np.flatnonzero(np.isfinite(found.roughness))
    order = known[np.argsort(found.file[known], kind="stable")]
    files, starts = np.unique(found.file[order], return_index=True)
    groups = (
        [np.sort(g) for g in np.split(found.roughness[order], starts[1:])] if files.size else []
    )
    ax.vlines(files, [g[0] for g in groups], [g[-1] for g in groups], color="0.75", label="range")
    medians = [float(np.median(g)) for g in groups]
    ax.plot(files, medians, ".", color=VALID, markersize=4.0, label="median")
    bad = np.flatnonzero(found.failed)
    if bad.size:
        ax.plot(bad, np.zeros(bad.size), "x", color=FLAGGED, clip_on=False, label="failed")
    ax.set_ylim(0.0, 1.05 * top)
    ax.set_xlim(-0.5, max(len(found.names), 1) - 0.5)
    ax.set_ylabel(f"{_quantity(found)}\n(m/km)")
    ax.set_xlabel("File, in the order of the summary")
    if len(found.names) <= NAMED:
        labels = [_short(name) for name in found.names]
        ax.set_xticks(range(len(labels)), labels, rotation=30, ha="right", parse_math=False)
        ax.set_xlabel("")
    legend(ax)


def _short(name: str) -> str:
    return name if len(name) <= LONGEST_NAME else f"…{name[1 - LONGEST_NAME :]}"


def _quantity(found: Segments) -> str:
    known = np.isfinite(found.roughness)
    if not found.paired[known].any():
        return "IRI"
    return "Mean roughness index" if found.paired[known].all() else "Mean roughness index, or IRI"


def _title(found: Segments) -> str:
    failed, unknown = int(found.failed.sum()), int(np.isnan(found.roughness).sum())
    length_km = float(np.nansum(found.length_m)) / 1000.0
    parts = [
        _count(len(found.names), "file") + (f" ({failed:,} failed)" if failed else ""),
        f"{length_km:,.1f} km",
        _count(found.file.size, "segment") + (f" ({unknown:,} without IRI)" if unknown else ""),
    ]
    return ", ".join(parts)


def _count(number: int, what: str) -> str:
    return f"{number:,} {what}{'' if number == 1 else 's'}"
