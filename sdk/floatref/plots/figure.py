"""A figure without global state, and saving it complete or not at all."""

from __future__ import annotations

import warnings
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from floatref.errors import InputError
from floatref.files.atomic import replacing_file

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
    """Raise InputError now if a drawing to ``path`` would be refused later."""
    check_suffix(path)
    new_figure(1, 1, [1.0])


def new_figure(
    rows: int, columns: int, heights: Sequence[float], shared: bool = True
) -> tuple[Figure, np.ndarray[tuple[int, int], np.dtype[np.object_]]]:
    """Return a figure and its axes, ``rows`` by ``columns``, on one distance axis if ``shared``.

    ``heights`` are in inches, one for each row. Raises InputError if matplotlib is missing.
    """
    try:
        from matplotlib.backends.backend_agg import FigureCanvasAgg
        from matplotlib.figure import Figure
    except ImportError as error:
        raise InputError("drawing needs matplotlib; run: pip install 'floatref[plot]'") from error
    figure = Figure(
        figsize=(11.0 if columns == 1 else 8.0 * columns, sum(heights) + 0.8), layout="constrained"
    )
    FigureCanvasAgg(figure)
    ratios = {"height_ratios": list(heights)}
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
    """Put the legend of ``ax`` above its right end, off the lines."""
    style: dict[str, Any] = {"frameon": False, "fontsize": "small", "borderaxespad": 0.2}
    drawn = ax.legend(loc="lower right", bbox_to_anchor=(1.0, 1.0), ncols=6, **style)
    for text in drawn.get_texts():
        text.set_parse_math(False)


def shown_name(name: str) -> str:
    """Return ``name`` as a label that legends do not leave out: they do after an underscore."""
    return f" {name}" if name.startswith("_") else name


def title(ax: Axes, text: str) -> None:
    """Put ``text``, taken literally, above the left end of ``ax``."""
    ax.set_title(text, loc="left", fontsize="medium", parse_math=False)


def save(figure: Figure, path: Path) -> None:
    """Write ``figure`` to ``path``, replacing a file; InputError where that cannot be written."""
    check_suffix(path)
    with replacing_file(path, overwrite=True) as beside, warnings.catch_warnings():
        # A name in letters that the font lacks is drawn as boxes.
        warnings.filterwarnings("ignore", "Glyph .* missing", UserWarning)
        figure.savefig(beside, dpi=DOTS_PER_INCH, format=path.suffix.lower()[1:])
