"""A recording in a notebook: a panel for each quantity, and where samples are missing."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from floatref.plots.figure import COLOURS, label_of, legend, line, new_figure, shade, title
from floatref.values.recording import Channel, Recording

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

PANEL_INCHES = 1.25


def recording_figure(recording: Recording) -> Figure:
    """Return a figure with a panel for each quantity over time in s, a line for each wheel path.

    Times at which a sample is missing are shaded. Raises InputError if matplotlib is missing.
    """
    quantities = dict.fromkeys(channel.id.name for channel in recording.channels)
    figure, axes = new_figure(len(quantities), 1, [PANEL_INCHES] * len(quantities))
    for ax, name in zip(axes[:, 0], quantities, strict=True):
        _draw_quantity(ax, [c for c in recording.channels if c.id.name == name])
    axes[-1, 0].set_xlabel("Time (s)")
    return figure


def _draw_quantity(ax: Axes, channels: list[Channel]) -> None:
    """Draw the ``channels`` of one quantity, which have one unit, and shade what is missing."""
    for number, channel in enumerate(channels):
        marker = "." if channel.values.size == 1 else None
        style = {"color": COLOURS[number % len(COLOURS)], "marker": marker}
        label = label_of(channel.id.track or "vehicle")
        line(ax, channel.times_s, channel.values, label=label, **style)
    gaps = [channel for channel in channels if np.isnan(channel.values).any()]
    for number, channel in enumerate(gaps):
        # One entry in the legend: labels that begin with an underscore have none.
        label = "_missing" if number else "missing"
        shade(ax, channel.times_s, np.isnan(channel.values), label)
    first = channels[0]
    title(ax, f"{first.id.name} ({first.unit})" if first.unit else first.id.name)
    if gaps or any(channel.id.track for channel in channels):
        legend(ax)
