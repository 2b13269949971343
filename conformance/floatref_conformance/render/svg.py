"""A small writer of line plots as inline SVG: panels above one another on one axis.

A picture is a string of at most a few ten kilobytes that depends on its numbers alone. Its
colours are those of the page's style sheet, by class.
"""

from dataclasses import dataclass
from html import escape as escaped

import numpy as np

from floatref.values.arrays import FloatArray
from floatref_conformance.render.scales import Scale, decimate, label, scale_of, ticks
from floatref_conformance.render.text import printable

WIDTH, LEFT, RIGHT, TOP, BOTTOM = 760.0, 64.0, 12.0, 30.0, 44.0
GAP = 16.0
"""Between two panels."""
TICKS_ALONG, TICKS_UP = 10, 4
MOST_POINTS = 800
"""Largest number of points that a line is drawn with."""
DOTS = ("dot", "square")
"""Styles of lines that are single points."""


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
    """A vertical line through all panels, with a label at its top."""

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
    numbered: tuple[float, ...] = ()


def draw_figure(figure: Figure) -> str:
    """Return ``figure`` as one SVG element; every text in it is escaped."""
    across = Scale(figure.start, figure.end, LEFT, WIDTH - RIGHT)
    tops = [TOP]
    for panel in figure.panels:
        tops.append(tops[-1] + panel.height + GAP)
    bottom = tops[-1] - GAP
    parts = [open_picture(figure.name, figure.title, figure.description, bottom + BOTTOM)]
    parts += [_shade(shade, across, bottom) for shade in figure.shades]
    for panel, top in zip(figure.panels, tops, strict=False):
        parts += _panel(panel, across, top)
    parts += [_mark(mark, across, bottom) for mark in figure.marks]
    parts += [_ticks_along(figure, across, bottom), _legend(figure), "</svg>"]
    return "\n".join(part for part in parts if part)


def open_picture(name: str, title: str, description: str, height: float) -> str:
    """Return the start tag of a picture, with its words for those who do not see it."""
    name = escape_text(name)
    return (
        f'<svg class="plot" viewBox="0 0 {px(WIDTH)} {px(height)}" role="img" '
        f'aria-labelledby="{name}-title {name}-desc">\n'
        f'<title id="{name}-title">{escape_text(title)}</title>\n'
        f'<desc id="{name}-desc">{escape_text(description)}</desc>'
    )


def _panel(panel: Panel, across: Scale, top: float) -> list[str]:
    bottom = top + panel.height
    held = [line.y for line in panel.lines] if panel.held is None else [panel.held]
    up = scale_of(held, bottom, top, panel.from_zero)
    grid, numbers = [], []
    for value in ticks(up.low, up.high, max(TICKS_UP, int(panel.height // 28))):
        y = px(up(value))
        grid.append(f"M{px(across.first)} {y}H{px(across.last)}")
        numbers.append(f'<text x="{px(LEFT - 6)}" y="{y}" dy=".32em">{label(value)}</text>')
    middle = (top + bottom) / 2
    name = f"{panel.label} ({panel.unit})" if panel.unit else panel.label
    return [
        f'<path class="grid" d="{"".join(grid)}"/>',
        f'<g class="numbers up">{"".join(numbers)}</g>',
        f'<text class="axis" transform="translate(12 {px(middle)}) rotate(-90)">'
        f"{escape_text(name)}</text>",
        *(_line(line, across, up) for line in panel.lines),
        f'<rect class="frame" x="{px(across.first)}" y="{px(top)}" '
        f'width="{px(across.last - across.first)}" height="{px(panel.height)}"/>',
    ]


def _line(line: Line, across: Scale, up: Scale) -> str:
    """Return the path of ``line``; a point between two missing ones is a dot.

    A dot has a length: printers leave out a square dot of length 0.
    """
    inside = (line.x >= across.low) & (line.x <= across.high)
    inside &= (line.y >= up.low) & (line.y <= up.high)
    strokes = decimate(np.where(inside, line.y, np.nan), MOST_POINTS)
    path = []
    for stroke in strokes:
        points = [f"{px(across(line.x[k]))} {px(up(line.y[k]))}" for k in stroke]
        path.append(f"M{points[0]}" + ("L" + " ".join(points[1:]) if points[1:] else "h.1"))
    return f'<path class="line {line.style}" d="{"".join(path)}"/>' if path else ""


def _shade(shade: Shade, across: Scale, bottom: float) -> str:
    rectangles = []
    for start, end in shade.stretches:
        left, right = (across(min(max(x, across.low), across.high)) for x in (start, end))
        width = max(right - left, 1.0)
        rectangles.append(f"M{px(left)} {px(TOP)}h{px(width)}V{px(bottom)}h{px(-width)}z")
    return f'<path class="{shade.style}" d="{"".join(rectangles)}"/>' if rectangles else ""


def _mark(mark: Mark, across: Scale, bottom: float) -> str:
    if not across.low <= mark.at <= across.high:
        return ""
    x = across(mark.at)
    side, dx = ("end", -4.0) if x > (across.first + across.last) / 2 else ("start", 4.0)
    return (
        f'<path class="mark" d="M{px(x)} {px(TOP)}V{px(bottom)}"/>'
        f'<text class="marked" x="{px(x + dx)}" y="{px(TOP + 11)}" text-anchor="{side}">'
        f"{escape_text(mark.label)}</text>"
    )


def _ticks_along(figure: Figure, across: Scale, bottom: float) -> str:
    values = figure.numbered or ticks(across.low, across.high, TICKS_ALONG)
    strokes = "".join(f"M{px(across(value))} {px(bottom)}v4" for value in values)
    numbers = "".join(
        f'<text x="{px(across(value))}" y="{px(bottom + 17)}">{label(value)}</text>'
        for value in values
    )
    middle = (across.first + across.last) / 2
    title = escape_text(figure.along)
    return (
        f'<path class="tick" d="{strokes}"/><g class="numbers along">{numbers}</g>'
        f'<text class="axis" x="{px(middle)}" y="{px(bottom + 36)}">{title}</text>'
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
        sample = _sample(style, x)
        parts.append(f'<path class="{style}" d="{sample}"/>')
        parts.append(f'<text x="{px(x + 24)}" y="14" dy=".32em">{escape_text(name)}</text>')
        x += 48 + 5.8 * len(name)
    return f'<g class="legend">{"".join(parts)}</g>' if parts else ""


def _sample(style: str, x: float) -> str:
    """Return the path that shows ``style`` from ``x`` on: a dot, a line, or an area."""
    if style.removeprefix("line ") in DOTS:
        return f"M{px(x + 9)} 14h.1"
    return f"M{px(x)} 14h18" if style.startswith("line") else f"M{px(x)} 8h18v12h-18z"


def escape_text(text: str) -> str:
    """Return ``text`` escaped for a picture."""
    return escaped(printable(text))


def px(value: float) -> str:
    """Return ``value`` with one decimal and no needless zero."""
    text = f"{value:.1f}"
    return "0" if text in ("-0.0", "0.0") else text.removesuffix(".0")
