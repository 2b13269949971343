"""Which pictures a worksheet has, in which order, and the heat map among them."""

from collections.abc import Iterator
from math import inf, isnan

from floatref.values.arrays import FloatArray
from floatref_conformance.certify.judging.contents import (
    RunSheet,
    RunTrack,
    SectionSheet,
    StationarySheet,
)
from floatref_conformance.certify.judging.limits import CertificationLimits
from floatref_conformance.certify.worksheet import pictures, wording
from floatref_conformance.certify.worksheet.lateral_parts import lateral_picture
from floatref_conformance.certify.worksheet.pictures import lag_picture
from floatref_conformance.certify.worksheet.wording import correlation
from floatref_conformance.render.failures import Markup, Picture
from floatref_conformance.render.svg import LEFT, RIGHT, TOP, WIDTH, escape_text, open_picture, px

WIDEST, HIGHEST = 64.0, 26.0
"""Size of a cell, as long as there is room."""
NARROWEST = 23.0
"""In a cell below this width a number could not be read."""
PALEST, DARKEST = 0.05, 0.5
SPAN = 0.1
"""A cell this far below the limit is the darkest."""


def heat_map(name: str, title: str, values: FloatArray, limit: float) -> str:
    """Return ``values``, of shape (n, n) with a number above the diagonal alone, as one element.

    Cells below ``limit``, 0 for no limit, are in another colour, framed, and their number is
    bold; rows and columns are numbered from 1. Too many for a number in each, they
    are coloured alone.
    """
    n = len(values)
    width = min(WIDEST, (WIDTH - LEFT - RIGHT) / max(n - 1, 1))
    height = min(HIGHEST, width)
    below = int((values < limit).sum())
    parts = [open_picture(name, title, _describe(n, below, limit), TOP + n * height + 8.0)]
    parts.append(_heads(n, width, height))
    for row in range(n - 1):
        for column in range(row + 1, n):
            x, y = LEFT + (column - 1) * width, TOP + (row + 1) * height
            parts.append(_cell(float(values[row, column]), limit, x, y, width, height))
    return "\n".join([*parts, *([_legend(limit)] if limit else []), "</svg>"])


def _describe(runs: int, below: int, limit: float) -> str:
    pairs = runs * (runs - 1) // 2
    low = f"; {below} of them below {limit:g}" if limit else ""
    return f"Cross correlation of {pairs} pairs of {runs} runs{low}."


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
    kind = "missing" if isnan(value) else "low" if value < limit else "high"
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
    low = escape_text(f"below {limit:g}: framed, bold")
    return (
        f'<g class="legend"><rect class="heat low" x="{px(LEFT)}" y="7" width="26" height="14" '
        f'fill-opacity="0.2"/><text x="{px(LEFT + 34)}" y="14" dy=".32em">{low}</text></g>'
    )


MOST_LAGS = 3
"""Runs of a section whose lags are drawn."""


def of_section(
    sheet: SectionSheet, limits: CertificationLimits, anchor: str
) -> tuple[Picture, ...]:
    """Return the pictures of a section, whose ids begin with ``anchor``."""
    return tuple(_of_section(sheet, limits, anchor))


def _of_section(sheet: SectionSheet, limits: CertificationLimits, anchor: str) -> Iterator[Picture]:
    yield _picture(
        pictures.iri_by_run(sheet, limits, f"{anchor}-iri"),
        "IRI of each run; the line is the reference's. Runs that do not agree are squares.",
    )
    for number, track in enumerate(wording.tracks_of(sheet), start=1):
        name = f"{anchor}-{number}"
        yield _picture(
            pictures.overlay(sheet, track, limits, f"{name}-all"),
            f"Wheel path {track}: elevation of wavelengths up to {pictures.SHOWN_M:g} m, and "
            "roughness over 7.62 m, of the reference and of all runs.",
        )
        yield _picture(
            pictures.close_up(sheet, track, limits, f"{name}-close"),
            f"Wheel path {track}: the roughest {pictures.CLOSE_M:g} m of the reference.",
        )
        if len(sheet.runs) > 1 and track in sheet.pairs:
            title = f"Wheel path {track}: cross correlation of all pairs of runs"
            least = limits.repeatability or 0.0
            drawn = heat_map(f"{name}-pairs", title, sheet.pairs[track], least)
            yield _picture(drawn, f"{title}, by their numbers.")
    drawn = lateral_picture(sheet, f"{anchor}-lateral")
    if drawn:
        yield _picture(drawn, "Agreement of each pair against the distance between their lines.")
    yield from _lags(sheet, limits, anchor)


def _lags(sheet: SectionSheet, limits: CertificationLimits, anchor: str) -> Iterator[Picture]:
    """Yield the lags of the runs whose distance is worst, as far as it is beyond the limit."""
    limit = inf if limits.distance_percent is None else limits.distance_percent
    runs = [(run, _surest(run)) for run in sheet.runs if run.tracks]
    beyond = [(r, t) for r, t in runs if abs(t.distance_percent) - 2.0 * t.distance_sigma > limit]
    beyond.sort(key=lambda pair: -abs(pair[1].distance_percent))
    for number, (run, track) in enumerate(beyond[:MOST_LAGS], start=1):
        drawn = lag_picture(sheet, run, track.track, f"{anchor}-lag-{number}")
        caption = (
            f"Run {run.name}, wheel path {track.track}: how far it lies ahead of the reference. "
            "An error of distance is a slope."
        )
        if drawn:
            yield _picture(drawn, caption)


def _surest(run: RunSheet) -> RunTrack:
    """Return the wheel path that measures the distance best: all share one encoder."""
    return min(run.tracks, key=lambda t: inf if isnan(t.distance_sigma) else t.distance_sigma)


def of_test(sheet: StationarySheet, anchor: str) -> tuple[Picture, ...]:
    """Return the picture of a stationary test, if there is a profile of it."""
    drawn = pictures.at_rest(sheet, f"{anchor}-profile")
    caption = "The profile of the standing vehicle; what counts is shaded."
    return (_picture(drawn, caption),) if drawn else ()


def _picture(svg: str, caption: str) -> Picture:
    return Picture(caption, Markup(svg))
