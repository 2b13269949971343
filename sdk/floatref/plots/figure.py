"""A figure without global state, and saving it complete or not at all."""

from __future__ import annotations

import warnings
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, Protocol

import numpy as np

from floatref.errors import InputError, missing_extra
from floatref.files.atomic import replace_file
from floatref.values.arrays import BoolArray, FloatArray, IndexArray

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

SUFFIXES = (".png", ".pdf", ".svg")
DOTS_PER_INCH = 130


def check_suffix(path: Path) -> None:
    """Raise InputError unless ``path`` ends as a drawing does."""
    if path.suffix.lower() not in SUFFIXES:
        raise InputError(f"{path}: not the name of a drawing; end it with {', '.join(SUFFIXES)}")


def check_drawing(path: Path) -> None:
    """Raise InputError now if writing a drawing to ``path`` would fail later."""
    check_suffix(path)
    new_figure(1, 1, [1.0])


def new_figure(
    rows: int,
    columns: int,
    heights: Sequence[float],
    shared: bool = True,
    widths: Sequence[float] | None = None,
) -> tuple[Figure, np.ndarray[tuple[int, int], np.dtype[np.object_]]]:
    """Return a figure and its axes, ``rows`` by ``columns``, on one distance axis if ``shared``.

    ``heights`` are in inches, one for each row; so are ``widths``, one for each column, if given.
    Raises InputError if matplotlib is missing.
    """
    try:
        import matplotlib.figure  # noqa: F401  # What follows may have been imported before.
        from matplotlib.backends.backend_agg import FigureCanvasAgg

        from floatref.plots.shown_figure import ShownFigure
    except ImportError as error:
        raise missing_extra("drawing needs matplotlib", "plot") from error
    usual = [11.0] if columns == 1 else [8.0] * columns
    width = sum(widths or usual)
    figure = ShownFigure(figsize=(width, sum(heights) + 0.8), layout="constrained")
    FigureCanvasAgg(figure)
    ratios = {"height_ratios": list(heights), "width_ratios": list(widths or usual)}
    axes = figure.subplots(rows, columns, sharex=shared, squeeze=False, gridspec_kw=ratios)
    for ax in axes.flat:
        dress(ax)
    for ax in axes[-1] if shared else ():
        ax.set_xlabel("Distance (m)")
    return figure, axes


def dress(ax: Axes) -> None:
    """Give ``ax`` a quiet grid and no box."""
    ax.grid(True, color="0.9", linewidth=0.6)
    ax.set_axisbelow(True)
    ax.spines[["top", "right"]].set_visible(False)
    ax.margins(x=0.0)
    ax.ticklabel_format(axis="both", useOffset=False)


def legend(ax: Axes) -> None:
    """Put the legend of ``ax`` above its right end, clear of the lines."""
    style: dict[str, Any] = {"frameon": False, "fontsize": "small", "borderaxespad": 0.2}
    drawn = ax.legend(loc="lower right", bbox_to_anchor=(1.0, 1.0), ncols=6, **style)
    for text in drawn.get_texts():
        text.set_parse_math(False)


def label_of(name: str) -> str:
    """Return ``name`` as a label that legends show; they omit names with a leading underscore."""
    return f" {name}" if name.startswith("_") else name


def title(ax: Axes, text: str) -> None:
    """Put ``text``, taken literally, above the left end of ``ax``."""
    ax.set_title(text, loc="left", fontsize="medium", parse_math=False)


def save(figure: Figure, path: Path) -> None:
    """Write ``figure`` to ``path``, replacing a file; InputError where that cannot be written."""
    check_suffix(path)
    with replace_file(path, overwrite=True) as beside, warnings.catch_warnings():
        # A name in letters that are missing in the font is drawn as boxes.
        warnings.filterwarnings("ignore", "Glyph .* missing", UserWarning)
        figure.savefig(beside, dpi=DOTS_PER_INCH, format=path.suffix.lower()[1:])


if TYPE_CHECKING:
    from matplotlib.axes import Axes

BINS = 3000
"""Largest number of stretches of a thinned line; each has its lowest and highest value."""

COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#56B4E9", "#E69F00")
REFERENCE_COLOUR = "0.25"
SHADE = "#F0C9C0"


class Places(Protocol):
    """The place of every point; those of a long line are never in memory together."""

    def __getitem__(self, index: IndexArray, /) -> FloatArray:
        """Return the places of the points ``index``."""


def thin(x: FloatArray, y: FloatArray, bins: int = BINS) -> tuple[FloatArray, FloatArray]:
    """Return points that draw the same line: of each stretch the lowest and the highest value.

    A stretch gives NaN only if all its values are NaN. Short lines are returned as they are.
    """
    if y.size <= 2 * bins:
        return x, y
    starts = np.linspace(0, y.size, bins, endpoint=False).astype(np.intp)
    low, high = np.fmin.reduceat(y, starts), np.fmax.reduceat(y, starts)
    middle = (x[starts] + x[np.append(starts[1:], y.size) - 1]) / 2.0
    return np.repeat(middle, 2), np.stack([low, high], axis=1).ravel()


def line(ax: Axes, x: FloatArray, y: FloatArray, **style: Any) -> None:
    """Draw ``y`` over ``x`` on ``ax``, thinned."""
    ax.plot(*thin(x, y), **{"linewidth": 0.9, **style})


def shade(ax: Axes, x: Places, invalid: BoolArray, label: str | None = None) -> None:
    """Shade the stretches of ``x`` where ``invalid`` is true, if any."""
    if not invalid.any():
        return
    starts = np.arange(0, invalid.size, max(1, -(-invalid.size // BINS)))
    lasts = np.append(starts[1:], invalid.size) - 1
    # A stretch with one invalid point is shaded; its outline is wide enough to see.
    ax.fill_between(
        (x[starts] + x[lasts]) / 2.0,
        0.0,
        1.0,
        where=np.logical_or.reduceat(invalid, starts).tolist(),
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
