"""The roughness of a network by place: a map of its segments, or its files in order."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from floatref.plots.figure import COLOURS, legend, title
from floatref.plots.network_columns import Segments
from floatref.values.arrays import BoolArray

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.collections import PathCollection
    from matplotlib.figure import Figure

NAMED = 24
"""Largest number of file names below the drawing; more would overlap."""
LONGEST_NAME = 28
COLOUR_MAP = "turbo"
"""Smooth roads are blue and rough ones dark red; both are visible on white."""
VALID, FLAGGED, UNKNOWN = COLOURS[0], COLOURS[1], "0.7"


PARTLY = "not all points valid"
"""What a legend says of the sign of such segments and files."""


def draw_map(figure: Figure, ax: Axes, found: Segments, located: BoolArray, top: float) -> None:
    """Draw the segments that are ``located`` on ``ax``, in colours up to ``top`` in m/km.

    Dots are segments whose points are all valid, crosses those with others; grey dots have no IRI
    of valid points.
    """
    known = np.isfinite(found.roughness)
    size = float(np.clip(4000.0 / located.sum(), 3.0, 40.0))
    style: dict[str, Any] = {"s": size, "rasterized": True}
    plain, rough = located & ~known, located & known
    ax.scatter(
        found.longitude[plain], found.latitude[plain], color=UNKNOWN, linewidths=0.0, **style
    )
    _draw_dots(ax, found, rough & found.marked, top, marker="x", linewidths=0.8, **style)
    dots = _draw_dots(ax, found, rough & ~found.marked, top, linewidths=0.0, **style)
    _explain_signs(ax, bool(plain.any()), bool((rough & found.marked).any()))
    bar = figure.colorbar(dots, ax=ax, shrink=0.9, extend="max" if _beyond(found, top) else None)
    bar.set_label(f"{quantity(found)} (m/km)")
    _scale_map(ax, found, located)


def _draw_dots(
    ax: Axes, found: Segments, chosen: BoolArray, top: float, **style: Any
) -> PathCollection:
    """Draw the ``chosen`` segments, the roughest last, on top: they matter most."""
    order = np.flatnonzero(chosen)[np.argsort(found.roughness[chosen], kind="stable")]
    return ax.scatter(
        found.longitude[order],
        found.latitude[order],
        c=found.roughness[order],
        cmap=COLOUR_MAP,
        vmin=0.0,
        vmax=top,
        **style,
    )


def _explain_signs(ax: Axes, some_unknown: bool, some_marked: bool) -> None:
    """Put the signs that are drawn into a legend, if there are others than dots."""
    if some_marked:
        ax.plot([], [], "x", color="0.3", label=PARTLY)
    if some_unknown:
        ax.plot([], [], "o", color=UNKNOWN, markeredgewidth=0.0, label="no IRI of valid points")
    if some_marked or some_unknown:
        legend(ax)


def _scale_map(ax: Axes, found: Segments, located: BoolArray) -> None:
    middle = float(np.median(found.latitude[located]))
    # One degree of longitude is shorter than one of latitude by this factor.
    ax.set_aspect(1.0 / max(np.cos(np.radians(middle)), 0.01), adjustable="datalim")
    ax.margins(0.05)
    ax.set_xlabel("Longitude (°)")
    ax.set_ylabel("Latitude (°)")
    if unplaced := int((~located).sum()):
        title(ax, f"{unplaced} of {count_of(located.size, 'segment')} without a position")


def _beyond(found: Segments, top: float) -> bool:
    return bool((found.roughness > top).any())


def draw_files(ax: Axes, found: Segments, top: float) -> None:
    """Draw median and range of every file on ``ax``, up to ``top`` in m/km.

    Medians of files of which not all points are valid are open circles.
    """
    known = np.flatnonzero(np.isfinite(found.roughness))
    order = known[np.argsort(found.file[known], kind="stable")]
    files, starts = np.unique(found.file[order], return_index=True)
    groups = (
        [np.sort(g) for g in np.split(found.roughness[order], starts[1:])] if files.size else []
    )
    ax.vlines(files, [g[0] for g in groups], [g[-1] for g in groups], color="0.75", label="range")
    medians = np.array([float(np.median(g)) for g in groups])
    partly = np.isin(files, found.file[found.marked])
    style: dict[str, Any] = {"linestyle": "", "color": VALID, "markersize": 4.0}
    ax.plot(files[~partly], medians[~partly], marker=".", label="median", **style)
    if partly.any():
        open_style = {**style, "markerfacecolor": "white", "label": f"median, {PARTLY}"}
        ax.plot(files[partly], medians[partly], marker="o", **open_style)
    bad = np.flatnonzero(found.failed)
    if bad.size:
        ax.plot(bad, np.zeros(bad.size), "x", color=FLAGGED, clip_on=False, label="failed")
    ax.set_ylim(0.0, 1.05 * top)
    ax.set_xlim(-0.5, max(len(found.names), 1) - 0.5)
    ax.set_ylabel(f"{quantity(found)}\n(m/km)")
    ax.set_xlabel("File, in the order of the summary")
    if len(found.names) <= NAMED:
        labels = [_short(name) for name in found.names]
        ax.set_xticks(range(len(labels)), labels, rotation=30, ha="right", parse_math=False)
        ax.set_xlabel("")
    legend(ax)


def _short(name: str) -> str:
    return name if len(name) <= LONGEST_NAME else f"…{name[1 - LONGEST_NAME :]}"


def quantity(found: Segments) -> str:
    """Return what the roughness of the segments is, for the label of an axis."""
    paired = found.paired[np.isfinite(found.roughness)]
    if not paired.any():
        return "IRI of valid points"
    index = "Mean roughness index of valid points"
    return index if paired.all() else f"{index}, or IRI"


def count_of(number: int, what: str) -> str:
    """Return ``number`` and ``what``, in the plural unless it is one."""
    return f"{number:,} {what}{'' if number == 1 else 's'}"
