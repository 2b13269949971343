"""A recording in a notebook or a file: a panel for each quantity, and where samples are missing."""

from __future__ import annotations

from typing import TYPE_CHECKING

from floatref.plots.figure import COLOURS, label_of, legend, new_figure, shade, title
from floatref.plots.long_lines import Reduced, Times
from floatref.values.parts.shown_units import SHOWN, kind_of_channel
from floatref.values.recording import Channel, Recording

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

PANEL_INCHES = 1.25


def recording_figure(
    recording: Recording,
    units: str | None = None,
    heading: str | None = None,
    origin_s: float = 0.0,
) -> Figure:
    """Return a figure with a panel for each quantity over time in s, a line for each wheel path.

    Times at which a sample is missing are shaded; they count from ``origin_s``. Without ``units``
    quantities are in SI units; with "si" or "us" in those that pictures show, such as mm, ° or in.
    ``heading`` stands above all panels. Raises InputError if matplotlib is missing.
    """
    quantities = dict.fromkeys(channel.id.name for channel in recording.channels)
    figure, axes = new_figure(len(quantities), 1, [PANEL_INCHES] * len(quantities))
    for ax, name in zip(axes[:, 0], quantities, strict=True):
        _draw_quantity(ax, [c for c in recording.channels if c.id.name == name], units, origin_s)
    axes[-1, 0].set_xlabel("Time (s)")
    if heading:
        figure.suptitle(heading, x=0.01, ha="left", parse_math=False)
    return figure


def _draw_quantity(ax: Axes, channels: list[Channel], units: str | None, origin_s: float) -> None:
    """Draw the ``channels`` of one quantity, which have one unit, and shade what is missing."""
    lines = [Reduced.of(Times(c.clock, origin_s), c.values) for c in channels]
    factor, unit = _unit_of(channels[0], lines, units)
    for number, (channel, line) in enumerate(zip(channels, lines, strict=True)):
        marker = "." if channel.values.size == 1 else None
        label = label_of(channel.id.track or "vehicle")
        line.draw(ax, factor, label=label, color=COLOURS[number % len(COLOURS)], marker=marker)
    gaps = [line for line in lines if line.missing.any()]
    for number, line in enumerate(gaps):
        # One entry in the legend: labels that begin with an underscore have none.
        shade(ax, line.places, line.missing, "_missing" if number else "missing")
    name = channels[0].id.name
    title(ax, f"{name} ({unit})" if unit else name)
    if gaps or any(channel.id.track for channel in channels):
        legend(ax)


def _unit_of(channel: Channel, lines: list[Reduced], units: str | None) -> tuple[float, str]:
    """Return the factor from the SI unit of ``channel``, and the unit that is shown."""
    if units is None:
        return 1.0, channel.unit
    spans = [line.span for line in lines if line.span]
    shown = SHOWN[kind_of_channel(channel.id.name, spans)][units]
    return shown.factor, shown.text
