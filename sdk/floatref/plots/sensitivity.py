"""The change of every run's loss with each setting: a group of short lines for a setting."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import cycle
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from floatref.plots.figure import COLOURS, check_suffix, label_of, legend, new_figure, save, title

if TYPE_CHECKING:
    from matplotlib.axes import Axes

Curves = Mapping[str, tuple[Sequence[float], Sequence[float]]]
"""Factors on a value and the losses there, by run."""
WIDTH = 0.8
"""Width of the group of a setting, where 1 is the distance of groups."""
PANEL_INCHES = 4.2


def draw_sensitivity(settings: Mapping[str, Curves], path: Path) -> None:
    """Write a drawing of the losses of runs over changed settings to ``path`` (.png, .pdf, .svg).

    Every setting has a group of lines, one for each run, from the smallest factor on its value to
    the largest; the value itself is a dot. Raises InputError if matplotlib is missing or ``path``
    cannot be written.
    """
    path = Path(path)
    check_suffix(path)
    figure, axes = new_figure(1, 1, [PANEL_INCHES])
    ax = axes[0, 0]
    for place, curves in enumerate(settings.values()):
        _draw_group(ax, place, curves, labelled=place == 0)
    ax.set_xticks(range(len(settings)), list(settings), rotation=30, ha="right")
    ax.set_xlim(-0.5, len(settings) - 0.5)
    ax.set_ylim(bottom=0.0)
    ax.set_xlabel("")
    ax.set_ylabel("Loss: 1 - ρ, and the error of roughness")
    title(ax, f"Each setting times {_span(settings)}")
    legend(ax)
    save(figure, path)


def _draw_group(ax: Axes, place: int, curves: Curves, labelled: bool) -> None:
    for (name, (factors, losses)), colour in zip(curves.items(), cycle(COLOURS), strict=False):
        octaves = np.log2(np.asarray(factors))
        x = place + WIDTH / 2.0 * octaves / np.abs(octaves).max()
        label = label_of(name) if labelled else None
        ax.plot(x, losses, "-", color=colour, linewidth=1.2, label=label)
        ax.plot(x[octaves == 0], np.asarray(losses)[octaves == 0], ".", color=colour)


def _span(settings: Mapping[str, Curves]) -> str:
    factors = [f for curves in settings.values() for each, _ in curves.values() for f in each]
    return f"{min(factors):.2g} to {max(factors):.3g}" if factors else "nothing"
