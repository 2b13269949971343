"""A small writer of line plots as inline SVG: panels above one another on one axis.

A picture is a string of at most a few ten kilobytes that depends on its numbers alone. Its
colours are those of the page's style sheet, by class.
"""

from dataclasses import dataclass
from html import escape as escaped

import numpy as np

from floatref.values.arrays import FloatArray
from floatref_conformance.render.scales import Scale, decimated, label, scale_of, ticks
from floatref_conformance.render.text import printable

WIDTH, LEFT, RIGHT, TOP, BOTTOM = 760.0, 64.0, 12.0, 30.0, 44.0
GAP = 16.0
"""Between two panels."""
TICKS_ALONG, TICKS_UP = 10, 4
MOST_POINTS = 800
"""Largest number of points that a line is drawn with."""


@dataclass(frozen=True, eq=False)
class Line:
    """One line; NaN interrupts it. ``style`` is the class of its colour and width."""

    label: str
    x: FloatArray
    y: FloatArray
    style: str


@dataclass(frozen=True, eq=False)
class Panel:
    """Lines on one vertical axis, with its name and unit; ``height`` is in pixels.

    With ``from_zero`` the axis begins at 0. It holds all values of the lines, or else those of
    ``held``; what lies beyond is not drawn.
    """

    label: str
    unit: str
    lines: tuple[Line, ...]
    height: float = 120.0
    from_zero: bool = False
    held: FloatArray | None = None


@dataclass(frozen=True)
class Shade:
    """Stretches of the horizontal axis that are shaded through all panels."""

    label: str
    stretches: tuple[tuple[float, float], ...]
    style: str


@dataclass(frozen=True)
class Mark:
    """A vertical line through all panels, with a word at its top."""

    at: float
    label: str


@dataclass(frozen=True, eq=False)
class Figure:
    """Panels above one another that share the horizontal axis from ``start`` to ``end``.

    ``name`` makes the ids in the page unique; ``title`` and ``description`` are read to those
    who do not see the picture.
    """

    name: str
    title: str
    description: str
    panels: tuple[Panel, ...]
    along: str
    start: float
    end: float
    shades: tuple[Shade, ...] = ()
    marks: tuple[Mark, ...] = ()


def drawn(figure: Figure) -> str:
    """Return ``figure`` as one SVG element; every text in it is escaped."""
    across = Scale(figure.start, figure.end, LEFT, WIDTH - RIGHT)
    tops = [TOP]
    for panel in figure.panels:
        tops.append(tops[-1] + panel.height + GAP)
    bottom = tops[-1] - GAP
    parts = [_opening(figure, bottom + BOTTOM)]
    parts += [_shade(shade, across, bottom) for shade in figure.shades]
    for panel, top in zip(figure.panels, tops, strict=False):
        parts += _panel(panel, across, top)
    parts += [_mark(mark, across, bottom) for mark in figure.marks]
    parts += [_ticks_along(figure, across, bottom), _legend(figure), "</svg>"]
    return "\n".join(part for part in parts if part)


def _opening(figure: Figure, height: float) -> str:
    name = _text(figure.name)
    return (
        f'<svg class="plot" viewBox="0 0 {_n(WIDTH)} {_n(height)}" role="img" '
        f'aria-labelledby="{name}-title {name}-desc">\n'
        f'<title id="{name}-title">{_text(figure.title)}</title>\n'
        f'<desc id="{name}-desc">{_text(figure.description)}</desc>'
    )


def _panel(panel: Panel, across: Scale, top: float) -> list[str]:
    bottom = top + panel.height
    held = [line.y for line in panel.lines] if panel.held is None else [panel.held]
    up = scale_of(held, bottom, top, panel.from_zero)
    grid, numbers = [], []
    for value in ticks(up.low, up.high, TICKS_UP):
        y = _n(up(value))
        grid.append(f"M{_n(across.first)} {y}H{_n(across.last)}")
        numbers.append(f'<text x="{_n(LEFT - 6)}" y="{y}" dy=".32em">{label(value)}</text>')
    middle = (top + bottom) / 2
    name = f"{panel.label} ({panel.unit})" if panel.unit else panel.label
    return [
        f'<path class="grid" d="{"".join(grid)}"/>',
        f'<g class="numbers up">{"".join(numbers)}</g>',
        f'<text class="axis" transform="translate(12 {_n(middle)}) rotate(-90)">'
        f"{_text(name)}</text>",
        *(_line(line, across, up) for line in panel.lines),
        f'<rect class="frame" x="{_n(across.first)}" y="{_n(top)}" '
        f'width="{_n(across.last - across.first)}" height="{_n(panel.height)}"/>',
    ]


def _line(line: Line, across: Scale, up: Scale) -> str:
    """Return the path of ``line``; a point between two missing ones is a dot."""
    inside = (line.x >= across.low) & (line.x <= across.high)
    inside &= (line.y >= up.low) & (line.y <= up.high)
    strokes = decimated(np.where(inside, line.y, np.nan), MOST_POINTS)
    path = []
    for stroke in strokes:
        points = [f"{_n(across(line.x[k]))} {_n(up(line.y[k]))}" for k in stroke]
        path.append(f"M{points[0]}" + ("L" + " ".join(points[1:]) if points[1:] else "h0"))
    return f'<path class="line {line.style}" d="{"".join(path)}"/>' if path else ""


def _shade(shade: Shade, across: Scale, bottom: float) -> str:
    rectangles = []
    for start, end in shade.stretches:
        left, right = (across(min(max(x, across.low), across.high)) for x in (start, end))
        width = max(right - left, 1.0)
        rectangles.append(f"M{_n(left)} {_n(TOP)}h{_n(width)}V{_n(bottom)}h{_n(-width)}z")
    return f'<path class="{shade.style}" d="{"".join(rectangles)}"/>' if rectangles else ""


def _mark(mark: Mark, across: Scale, bottom: float) -> str:
    if not across.low <= mark.at <= across.high:
        return ""
    x = across(mark.at)
    side, dx = ("end", -4.0) if x > (across.first + across.last) / 2 else ("start", 4.0)
    return (
        f'<path class="mark" d="M{_n(x)} {_n(TOP)}V{_n(bottom)}"/>'
        f'<text class="marked" x="{_n(x + dx)}" y="{_n(TOP + 11)}" text-anchor="{side}">'
        f"{_text(mark.label)}</text>"
    )


def _ticks_along(figure: Figure, across: Scale, bottom: float) -> str:
    values = ticks(across.low, across.high, TICKS_ALONG)
    strokes = "".join(f"M{_n(across(value))} {_n(bottom)}v4" for value in values)
    numbers = "".join(
        f'<text x="{_n(across(value))}" y="{_n(bottom + 17)}">{label(value)}</text>'
        for value in values
    )
    middle = (across.first + across.last) / 2
    return (
        f'<path class="tick" d="{strokes}"/><g class="numbers along">{numbers}</g>'
        f'<text class="axis" x="{_n(middle)}" y="{_n(bottom + 36)}">{_text(figure.along)}</text>'
    )


def _legend(figure: Figure) -> str:
    """Return the names of the lines and shades in one row above the panels."""
    entries: dict[str, str] = {}
    for panel in figure.panels:
        if len(panel.lines) > 1:
            entries |= {line.label: f"line {line.style}" for line in panel.lines}
    shown = [shade for shade in figure.shades if shade.stretches]
    parts, x = [], LEFT
    for name, style in (*entries.items(), *((shade.label, shade.style) for shade in shown)):
        sample = f"M{_n(x)} 14h18" if style.startswith("line") else f"M{_n(x)} 8h18v12h-18z"
        parts.append(f'<path class="{style}" d="{sample}"/>')
        parts.append(f'<text x="{_n(x + 24)}" y="14" dy=".32em">{_text(name)}</text>')
        x += 48 + 5.8 * len(name)
    return f'<g class="legend">{"".join(parts)}</g>' if parts else ""


def _text(text: str) -> str:
    return escaped(printable(text))


def _n(value: float) -> str:
    """Return a coordinate with one decimal and no needless zero."""
    text = f"{value:.1f}"
    return "0" if text in ("-0.0", "0.0") else text.removesuffix(".0")
