"""A matrix of pairs as a picture: a number in every cell, and a frame where it is too low."""

from math import isnan

from floatref.values.arrays import FloatArray
from floatref_conformance.render.svg import LEFT, RIGHT, TOP, WIDTH, opening, px, worded
from floatref_conformance.render.worksheet_wording import correlation

WIDEST, HIGHEST = 64.0, 26.0
"""Size of a cell, as long as there is room."""
NARROWEST = 23.0
"""In a cell below this width a number could not be read."""
PALEST, DARKEST = 0.05, 0.5
SPAN = 0.1
"""A cell this far below the limit is the darkest."""


def heat_map(name: str, title: str, values: FloatArray, limit: float) -> str:
    """Return ``values``, of shape (n, n) with a number above the diagonal alone, as one element.

    Cells below ``limit`` are in another colour, framed, and their number is bold; rows and
    columns are numbered from 1. Too many for a number in each cell, they are coloured alone.
    """
    n = len(values)
    width = min(WIDEST, (WIDTH - LEFT - RIGHT) / max(n - 1, 1))
    height = min(HIGHEST, width)
    below = int((values < limit).sum())
    parts = [opening(name, title, _described(n, below, limit), TOP + n * height + 8.0)]
    parts.append(_heads(n, width, height))
    for row in range(n - 1):
        for column in range(row + 1, n):
            x, y = LEFT + (column - 1) * width, TOP + (row + 1) * height
            parts.append(_cell(float(values[row, column]), limit, x, y, width, height))
    return "\n".join([*parts, _legend(limit), "</svg>"])


def _described(runs: int, below: int, limit: float) -> str:
    pairs = runs * (runs - 1) // 2
    return f"Cross correlation of {pairs} pairs of {runs} runs; {below} of them below {limit:g}."


def _heads(n: int, width: float, height: float) -> str:
    """Return the numbers of the runs, those of columns above and those of rows on the left."""
    rows = "".join(
        f'<text x="{px(LEFT - 8)}" y="{px(TOP + (row + 1.5) * height)}" dy=".32em">{row + 1}</text>'
        for row in range(n - 1)
    )
    columns = "".join(
        f'<text x="{px(LEFT + (column - 0.5) * width)}" y="{px(TOP + height / 2)}" dy=".32em">'
        f"{column + 1}</text>"
        for column in range(1, n)
    )
    return f'<g class="numbers up">{rows}</g><g class="numbers along">{columns}</g>'


def _cell(value: float, limit: float, x: float, y: float, width: float, height: float) -> str:
    place = f'x="{px(x + 1)}" y="{px(y + 1)}" width="{px(width - 2)}" height="{px(height - 2)}"'
    kind = "none" if isnan(value) else "low" if value < limit else "high"
    cell = f'<rect class="heat {kind}" {place} fill-opacity="{_depth(value, limit):.2f}"/>'
    if width < NARROWEST:
        return cell
    middle = f'x="{px(x + width / 2)}" y="{px(y + height / 2)}" dy=".32em"'
    return f'{cell}<text class="inside {kind}" {middle}>{correlation(value)}</text>'


def _depth(value: float, limit: float) -> float:
    """Return how dark a cell is: the darker, the farther from the limit."""
    if isnan(value):
        return 0.0
    away = abs(value - limit) / (max(1.0 - limit, 1e-3) if value >= limit else SPAN)
    return PALEST + (DARKEST - PALEST) * min(away, 1.0)


def _legend(limit: float) -> str:
    low = worded(f"below {limit:g}: framed, bold")
    return (
        f'<g class="legend"><rect class="heat low" x="{px(LEFT)}" y="7" width="26" height="14" '
        f'fill-opacity="0.2"/><text x="{px(LEFT + 34)}" y="14" dy=".32em">{low}</text></g>'
    )
