"""What every pipeline bears and where it breaks: a map of pipelines against conditions."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from floatref.files.atomic import replace_file
from floatref_conformance.table.comparison_picture import DOTS_PER_INCH, new_figure
from floatref_conformance.table.families.family_table import FamilyTable, summarize

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.image import AxesImage

STEPS = (0.0, 0.5, 0.8, 0.92, 0.95, 0.98, 1.0)
"""Ends of the colours: 0.92 and 0.98 are those of AASHTO R 56-14."""
LEAST_WIDTH = 10.0
"""In inches: the line below the maps needs it."""
COLOURS = "RdYlBu"
"""Red to blue: people who do not tell red from green tell these."""
AXES = (("true", "Along the true distance"), ("encoder", "Along the encoder's distance"))


def draw_families(table: FamilyTable, path: Path) -> None:
    """Write a picture of ``table`` to ``path``: pipelines in rows, conditions in columns.

    Above along the true distance, below along the encoder's. Colour and number are the 10th
    percentile of the cross correlation; a black frame marks where valid points are wrong on some
    drive, along both axes. Raises InputError where matplotlib is missing or ``path`` cannot be
    written.
    """
    settings = table.settings
    columns, rows = len(settings.conditions), len(settings.pipelines)
    figure = new_figure(max(4.0 + 0.52 * columns, LEAST_WIDTH), 3.2 + 0.6 * rows)
    panels = figure.subplots(len(AXES), 1, squeeze=False, sharex=True)[:, 0]
    for ax, (axis, title) in zip(panels, AXES, strict=True):
        image = _draw_map(ax, table, axis)
        ax.set_title(f"{title}: 10th percentile of the cross correlation", loc="left")
        ax.set_yticks(range(rows), settings.pipelines, fontsize="small")
    panels[-1].set_xticks(
        range(columns), [c.name for c in settings.conditions], rotation=60, ha="right",
        fontsize="small",
    )  # fmt: skip
    bar = figure.colorbar(image, ax=list(panels), pad=0.01, ticks=STEPS, spacing="uniform")
    bar.ax.set_yticklabels([f"{step:g}" for step in STEPS])
    figure.supxlabel(
        "Black frame: on some drive the IRI of points marked valid is wrong by more than 5 % and "
        "0.1 m/km, along both distances",
        fontsize="small",
    )
    with replace_file(path, overwrite=True) as beside:
        figure.savefig(beside, dpi=DOTS_PER_INCH, format="png")


def _draw_map(ax: Axes, table: FamilyTable, axis: str) -> AxesImage:
    """Draw the cells of one axis, frames and families included."""
    from matplotlib import colormaps
    from matplotlib.colors import BoundaryNorm
    from matplotlib.patches import Rectangle

    conditions, pipelines = table.settings.conditions, table.settings.pipelines
    values = np.array(
        [
            [
                getattr(summarize(table.of(p, c)), axis).cross_correlation_percentile_10
                for c in conditions
            ]
            for p in pipelines
        ]
    )
    colours = colormaps[COLOURS]
    norm = BoundaryNorm(STEPS, colours.N)
    image = ax.imshow(np.clip(values, 0.0, 1.0), norm=norm, cmap=colours, aspect="auto")
    wrong = {(path.pipeline, path.condition) for path in table.wrong()}
    for row, pipeline in enumerate(pipelines):
        for column, condition in enumerate(conditions):
            value = values[row, column]
            dark = np.dot(colours(norm(max(value, 0.0)))[:3], (0.3, 0.6, 0.1)) < 0.5
            ax.text(
                column, row, _text(value), ha="center", va="center", fontsize="x-small",
                color="white" if dark else "black",
            )  # fmt: skip
            if (pipeline, condition) in wrong:
                corner = (column - 0.46, row - 0.44)
                ax.add_patch(Rectangle(corner, 0.92, 0.88, fill=False, lw=1.6, ec="black"))
    _separate_families(ax, table)
    return image


def _text(value: float) -> str:
    """Return a correlation without its leading zero, and 1 only where it is rounded to it."""
    if value < 0.005:
        return "0"
    return f"{value:.3f}".lstrip("0") if value >= 0.9 else f"{value:.2f}".lstrip("0")


def _separate_families(ax: Axes, table: FamilyTable) -> None:
    """Draw a line between families, and the name of each above its columns."""
    names = [c.family for c in table.settings.conditions]
    for first in (n for n, name in enumerate(names) if n == 0 or names[n - 1] != name):
        if first:
            ax.axvline(first - 0.5, color="white", lw=4)
        ax.text(first - 0.4, -0.65, names[first], fontsize="small", fontweight="bold", va="bottom")
    ax.title.set_position((0.0, 1.0))
    ax.set_ylim(len(table.settings.pipelines) - 0.5, -1.5)
