"""The published tables beside ours, as heat maps."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from floatref.errors import InputError, missing_extra
from floatref.files.atomic import check_target, replace_file
from floatref.files.owners import own_name
from floatref.files.sources import real_path
from floatref_conformance.table.cells import Cell, ComparisonTable
from floatref_conformance.table.passes import FITTED
from floatref_conformance.table.published import PRINTED_FLOOR, published_table
from floatref_conformance.table.scores import Scores

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.colors import Normalize
    from matplotlib.figure import Figure

DOTS_PER_INCH = 110
MISSING = "0.85"
ScoresOf = Callable[[Cell], Scores | None]


@dataclass(frozen=True)
class _Quantity:
    """A figure of a cell, the ends of its colours, and how it is written into its field."""

    label: str
    value: Callable[[Scores], float]
    text: Callable[[float], str]
    lowest: float
    highest: float
    logarithmic: bool
    colours: str

    def norm(self) -> Normalize:
        """Return the scale of the colours, which stay those of its ends beyond them."""
        from matplotlib.colors import LogNorm, Normalize

        kind = LogNorm if self.logarithmic else Normalize
        return kind(self.lowest, self.highest, clip=True)


QUANTITIES = (
    _Quantity(
        "Cross correlation",
        lambda scores: scores.cross_correlation,
        lambda value: f"{value:.2f}" if value > PRINTED_FLOOR else "<.2",
        PRINTED_FLOOR,
        1.0,
        False,
        "viridis",
    ),
    _Quantity(
        "Peak roughness (m/km)",
        lambda scores: scores.peak_m_per_km,
        lambda value: f"{value:.1f}" if value < 99.95 else f"{value:.0f}",
        2.0,
        2000.0,
        True,
        "magma_r",
    ),
)
SIDES: tuple[tuple[str, ScoresOf], ...] = (
    ("ours", lambda cell: cell.mean),
    ("Karamihas 2021", lambda cell: None if cell.published is None else cell.published.scores),
)


def check_picture(path: Path) -> None:
    """Raise InputError now if a picture to ``path`` would be refused later.

    To know it, a file is made beside ``path`` and removed again.
    """
    if path.suffix.lower() != ".png":
        raise InputError(f"{path}: not the name of a PNG picture; end it with .png")
    check_target(path, overwrite=True)
    try:
        if path.is_dir():
            raise InputError(f"{path}: is a folder; give the name of a file to write")
        beside = real_path(path).parent / own_name()
        try:
            beside.touch(exist_ok=False)
        finally:
            beside.unlink(missing_ok=True)
    except OSError as error:
        raise InputError(
            f"{path}: cannot be written ({error.strerror}); choose another folder or name"
        ) from error
    new_figure(1.0, 1.0)


def draw_comparison_maps(table: ComparisonTable, path: Path) -> None:
    """Write heat maps of ``table`` to ``path``: ours on the left, print on the right.

    Above the cross correlation, below the peak of the short-interval roughness profile on a
    logarithmic scale; both sides share their colours. Grey is what was not published, * a cell to
    which the slip is fitted. Raises
    InputError where matplotlib is missing or ``path`` cannot be written.
    """
    columns, rows = len(table.settings.pipelines), len(table.settings.runs)
    figure = new_figure(6.0 + 0.9 * columns, 4.0 + 0.5 * rows)
    axes = figure.subplots(len(QUANTITIES), len(SIDES), squeeze=False, sharex=True, sharey=True)
    for pair, quantity in zip(axes, QUANTITIES, strict=True):
        norm = quantity.norm()
        for ax, (side, scores_of) in zip(pair, SIDES, strict=True):
            _draw_map(ax, table, scores_of, quantity, norm)
            ax.set_title(f"{quantity.label}, {side}", loc="left", fontsize="medium")
        figure.colorbar(pair[0].images[0], ax=list(pair), pad=0.01)
    for ax in axes[-1]:
        ax.set_xticks(range(columns), _columns(table), rotation=60, ha="right", fontsize="small")
    for ax in axes[:, 0]:
        ax.set_yticks(range(rows), table.settings.runs, fontsize="small")
    with replace_file(path, overwrite=True) as beside:
        figure.savefig(beside, dpi=DOTS_PER_INCH, format="png")


def new_figure(width: float, height: float) -> Figure:
    """Return a figure of ``width`` by ``height`` inches; InputError if matplotlib is missing."""
    try:
        from matplotlib.backends.backend_agg import FigureCanvasAgg
        from matplotlib.figure import Figure
    except ImportError as error:
        raise missing_extra("drawing needs matplotlib", "plot") from error
    figure = Figure(figsize=(width, height), layout="constrained")
    FigureCanvasAgg(figure)
    return figure


def _draw_map(
    ax: Axes, table: ComparisonTable, scores_of: ScoresOf, quantity: _Quantity, norm: Normalize
) -> None:
    """Draw one quantity of every cell, its value written into its field."""
    from matplotlib import colormaps

    runs, colours = table.settings.runs, colormaps[quantity.colours]
    side_is_ours = scores_of is SIDES[0][1]
    values = np.full((len(runs), len(table.settings.pipelines)), np.nan)
    for column, pipeline in enumerate(table.settings.pipelines):
        for cell in table.of_pipeline(pipeline):
            scores = scores_of(cell)
            if scores is None:
                continue
            row, value = runs.index(cell.run), quantity.value(scores)
            values[row, column] = value
            dark = np.dot(colours(norm(value))[:3], (0.3, 0.6, 0.1)) < 0.5
            mark = "*" if side_is_ours and (cell.pipeline, cell.run) in FITTED else ""
            ax.text(
                column, row, quantity.text(value) + mark,
                ha="center", va="center", fontsize="x-small", color="white" if dark else "black",
            )  # fmt: skip
    ax.set_facecolor(MISSING)
    ax.imshow(np.ma.masked_invalid(values), norm=norm, cmap=colours, aspect="auto")


def _columns(table: ComparisonTable) -> list[str]:
    """Return the names of the pipelines, each with its table in print."""
    numbers = {name: published_table(name) for name in table.settings.pipelines}
    return [name if number is None else f"{name} ({number})" for name, number in numbers.items()]
