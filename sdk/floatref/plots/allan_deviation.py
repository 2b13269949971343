"""Allan deviations of sensors at rest over cluster time, with the curves fitted to them."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import cycle
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from floatref.measures.allan.at_rest import ChannelNoise
from floatref.measures.allan.noise_fit import NoiseCoefficients
from floatref.plots.figure import COLOURS, check_suffix, label_of, legend, new_figure, save, title

if TYPE_CHECKING:
    from matplotlib.axes import Axes

QUANTITIES = {
    "rad/s": "Angular rate",
    "m/s^2": "Specific force",
    "m": "Height",
    "m/s": "Velocity",
    "rad": "Angle",
}
SYMBOLS = dict(zip(NoiseCoefficients._fields, "RKBNQ", strict=True))
PANEL_INCHES = 3.0


def draw_allan(found: Sequence[ChannelNoise], path: Path) -> None:
    """Write a drawing of the Allan deviations ``found`` to ``path`` (.png, .pdf or .svg).

    One panel for each unit, logarithmic on both axes: the measured deviation with its standard
    uncertainty shaded, and dashed the curve (6.53) with the letters of its coefficients, each in
    the middle of the cluster times where its term is the largest. Raises InputError if matplotlib
    is missing or ``path`` cannot be written.
    """
    path = Path(path)
    check_suffix(path)
    units = list(dict.fromkeys(noise.unit for noise in found))
    figure, axes = new_figure(len(units), 1, [PANEL_INCHES] * len(units))
    for ax, unit in zip(axes[:, 0], units, strict=True):
        ax.set_xscale("log")
        ax.set_yscale("log")
        panel = [noise for noise in found if noise.unit == unit]
        for noise, colour in zip(panel, cycle(COLOURS), strict=False):
            _draw_measured(ax, noise, colour)
            _draw_curve(ax, noise, colour)
        ax.set_ylabel(f"{QUANTITIES.get(unit, 'Signal')}\n({unit.replace('^2', '²')})")
        legend(ax)
    title(axes[0, 0], "Allan deviation; dashed: fitted")
    axes[-1, 0].set_xlabel("Cluster time (s)")
    save(figure, path)


def _draw_measured(ax: Axes, noise: ChannelNoise, colour: str) -> None:
    time, deviation = noise.allan.cluster_s, noise.allan.deviation
    name = label_of(str(noise.id))
    ax.plot(time, deviation, ".", color=colour, markersize=4.0, label=name)
    fitted, scatter = noise.fit.allan, noise.fit.scatter
    # The error of a deviation is a factor, equally likely up and down, so never below zero.
    low, high = fitted.deviation * np.exp(-scatter), fitted.deviation * np.exp(scatter)
    ax.fill_between(fitted.cluster_s, low, high, color=colour, alpha=0.2, linewidth=0.0)


def _draw_curve(ax: Axes, noise: ChannelNoise, colour: str) -> None:
    """Draw the curve where it was fitted, and the letters of its terms."""
    coefficients = noise.fit.coefficients
    ax.plot(noise.fit.allan.cluster_s, noise.fit.deviation, "--", color=colour, linewidth=1.0)
    for term, symbol in SYMBOLS.items():
        reach = noise.fit.dominates(term)
        if reach is not None:
            middle = float(np.sqrt(np.prod(reach)))
            height = float(coefficients.deviation(np.array([middle]))[0])
            style: dict[str, Any] = {"ha": "center", "va": "bottom", "color": colour}
            ax.text(middle, 1.08 * height, symbol, **style)
