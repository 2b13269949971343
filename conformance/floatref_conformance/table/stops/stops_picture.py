"""Drawn stops as dots: the cross correlation of every wheel path, pipeline by pipeline."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from floatref.files.atomic import replace_file
from floatref_conformance.table.comparison_picture import DOTS_PER_INCH, new_figure
from floatref_conformance.table.stops.stop_settings import STOP_ROADS
from floatref_conformance.table.stops.stop_table import StopTable, summary

if TYPE_CHECKING:
    from matplotlib.axes import Axes

TICKS = (0.0, 0.5, 0.8, 0.9, 0.95, 0.98, 0.99, 0.995, 0.998, 0.999)
HIGHEST = 0.9995
"""Cross correlations beyond this are drawn there; those below 0 are drawn at 0."""
MARKERS = ("o", "s", "^")
ROW = 0.8
"""Part of a pipeline's row that its dots take."""


def draw_stops(table: StopTable, path: Path) -> None:
    """Write a picture of ``table`` to ``path``: one row for each pipeline.

    Across lies the cross correlation with the truth, on a logarithmic scale of its distance to
    one. A dot is a wheel path, its colour and its line within the row the vehicle, its shape the
    road; a long bar is the median, a short one the first percentile. Raises InputError where
    matplotlib is missing or ``path`` cannot be written.
    """
    pipelines = table.settings.pipelines
    figure = new_figure(11.0, 2.0 + 0.62 * len(pipelines))
    ax = figure.subplots()
    ax.set_xscale("log")
    ax.set_xlim(1.1, 0.9 * (1.0 - HIGHEST))
    for row, pipeline in enumerate(pipelines):
        _draw_row(ax, table, pipeline, row)
    ax.set_xticks([1.0 - tick for tick in TICKS], [f"{tick:g}" for tick in TICKS])
    ax.minorticks_off()
    ax.set_yticks(range(len(pipelines)), pipelines, fontsize="small")
    ax.set_ylim(len(pipelines) - 0.5, -0.5)
    ax.grid(axis="x", color="0.9")
    ax.set_axisbelow(True)
    ax.set_xlabel("Cross correlation with the truth around the stop")
    _draw_legend(ax, table)
    with replace_file(path, overwrite=True) as beside:
        figure.savefig(beside, dpi=DOTS_PER_INCH, format="png")


def _draw_row(ax: Axes, table: StopTable, pipeline: str, row: int) -> None:
    """Draw the wheel paths of one pipeline, and two bars for all of them."""
    vehicles = table.settings.vehicles
    for number, vehicle in enumerate(vehicles):
        height = row + ROW * ((number + 0.5) / len(vehicles) - 0.5)
        for road, marker in zip(STOP_ROADS, MARKERS, strict=True):
            found = table.of(pipeline, vehicle, road.kind)
            lacking = [_distance_to_one(path.scores.cross_correlation) for path in found]
            heights = np.full(len(lacking), height)
            ax.plot(lacking, heights, marker, color=f"C{number}", ms=3.5, alpha=0.7, mew=0)
    together = summary(table.of(pipeline))
    for value, length in (
        (together.cross_correlation_median, 1.0),
        (together.cross_correlation_percentile_1, 0.5),
    ):
        ends = (row - length * ROW / 2, row + length * ROW / 2)
        ax.plot([_distance_to_one(value)] * 2, ends, color="black", lw=1.2)


def _draw_legend(ax: Axes, table: StopTable) -> None:
    """Draw the colours of the vehicles and the shapes of the roads above the rows."""
    handles = [
        *(
            ax.plot([], [], "o", color=f"C{number}", label=name)[0]
            for number, name in enumerate(table.settings.vehicles)
        ),
        *(
            ax.plot([], [], marker, color="0.4", label=f"{r.name}, {r.iri_m_per_km:g} m/km")[0]
            for r, marker in zip(STOP_ROADS, MARKERS, strict=True)
        ),
        ax.plot([], [], "|", color="black", ms=14, label="median")[0],
        ax.plot([], [], "|", color="black", ms=7, label="1st percentile")[0],
    ]
    ax.legend(
        handles=handles, ncols=5, loc="lower left", bbox_to_anchor=(0.0, 1.01), fontsize="small",
        frameon=False,
    )  # fmt: skip


def _distance_to_one(cross_correlation: float) -> float:
    """Return one less ``cross_correlation``, within the picture's ends."""
    return 1.0 - min(max(cross_correlation, 0.0), HIGHEST)
