"""The drawing of a manoeuvre: speed along the distance, and what lies where."""

from collections.abc import Sequence

import numpy as np

from floatref.values.arrays import FloatArray
from floatref_conformance.checks.stretches import Stretches
from floatref_conformance.proving_ground.drives.artificial import DURATION_S
from floatref_conformance.proving_ground.drives.artificial import Bounce as Push
from floatref_conformance.proving_ground.drives.runs import KMH
from floatref_conformance.proving_ground.scenario import Scenario
from floatref_conformance.render import places
from floatref_conformance.render.places import Place
from floatref_conformance.render.scales import Scale, label, scale_of, ticks
from floatref_conformance.render.svg import Figure, Line, Mark, Panel, Shade, draw_figure

COLUMNS, ROWS = 78, 7
INDENT = 7
"""Columns left of the axis, for its numbers."""
LONGEST = 36
"""Characters of a name below the axis."""
MOST = 3
"""Stretches, and events, that are marked below the axis."""
SAMPLES = 2000


def draw(scenario: Scenario, scored_m: Stretches = ()) -> list[str]:
    """Return lines of at most 88 columns of ASCII: speed, and below what lies where.

    Along the axis runs distance in m, for a parked vehicle time in s. ``scored_m`` are the
    stretches whose points count, in m.
    """
    parked = places.is_parked(scenario)
    x, speed = places.speed_along(scenario)
    factor = 1.0 / (scenario.speed_kmh * KMH) if parked else 1.0
    across = Scale(0.0, float(x[-1]) * factor, 0.0, COLUMNS - 1.0)
    lines = _plot_rows(x * factor, speed, across)
    lines += _axis(across, "s" if parked else "m")
    for place in _collect_places(scenario, scored_m):
        lines.append(_mark_place(_in_seconds(place, factor), across))
    return lines


def drawing_svg(scenario: Scenario, name: str = "drawing", scored_m: Stretches = ()) -> str:
    """Return the drawing as one SVG element whose ids begin with ``name``."""
    picture = _draw_parked if places.is_parked(scenario) else _drive
    return draw_figure(picture(scenario, name, _scored_places(scored_m)))


def _collect_places(scenario: Scenario, scored_m: Stretches) -> list[Place]:
    """Return what is marked below the axis, of everything the first `MOST` at most."""
    bounced = places.bounce_place(scenario)
    scored, events = _scored_places(scored_m), places.events(scenario)
    found = (*scored[:MOST], *([bounced] if bounced else []), *events[:MOST])
    return [*found, *places.bumps(scenario)]


def _scored_places(scored_m: Stretches) -> list[Place]:
    return [Place(start, end, "scored") for start, end in places.join_stretches(scored_m)]


def _in_seconds(place: Place, s_per_m: float) -> Place:
    return Place(place.start_m * s_per_m, place.end_m * s_per_m, place.name)


def _plot_rows(x: FloatArray, speed: FloatArray, across: Scale) -> list[str]:
    """Return the rows of the plot, each column filled from its lowest to its highest speed."""
    up = scale_of([speed], ROWS - 1.0, 0.0, from_zero=True)
    field = [[" "] * COLUMNS for _ in range(ROWS)]
    middles = np.linspace(across.low, across.high, COLUMNS)
    half = 0.5 * (middles[1] - middles[0])
    edges = np.clip([middles[0] - half, *(middles + half)], across.low, across.high)
    for column in range(COLUMNS):
        inside = speed[(x >= edges[column]) & (x <= edges[column + 1])]
        ends = np.interp(edges[column : column + 2], x, speed)
        both = np.concatenate([inside, ends])
        for row in range(round(up(float(both.max()))), round(up(float(both.min()))) + 1):
            field[row][column] = "*"
    numbers = {round(up(value)): label(value) for value in ticks(up.low, up.high, 4)}
    rows = (f"{numbers.get(k, ''):>6} |{''.join(f)}".rstrip() for k, f in enumerate(field))
    return ["  km/h", *rows]


def _axis(across: Scale, unit: str) -> list[str]:
    rule, below = ["-"] * COLUMNS, [" "] * COLUMNS
    for value in ticks(across.low, across.high, 10):
        column, text = round(across(value)), label(value)
        rule[column] = "+"
        start = min(max(0, column - len(text) // 2), COLUMNS - len(text))
        below[start : start + len(text)] = text
    return [f"{'':>{INDENT}}+{''.join(rule)}", f"{unit:>{INDENT}} {''.join(below).rstrip()}"]


def _mark_place(place: Place, across: Scale) -> str:
    """Return a row with ``place`` between brackets, or at a caret, and its name beside it."""
    ends = (min(max(x, 0.0), across.high) for x in (place.start_m, place.end_m))
    first, last = (round(across(end)) for end in ends)
    shape = "^" if last - first < 2 else f"[{'=' * (last - first - 1)}]"
    text = f"{place.name}, {_numbers(place)}"[:LONGEST]
    if first + len(shape) + 1 + len(text) <= COLUMNS:
        row = f"{'':{first}}{shape} {text}"
    elif first > len(text):
        row = f"{'':{first - 1 - len(text)}}{text} {shape}"
    else:
        row = f"{'':{first}}[{f' {text} '.center(last - first - 1, '=')}]"
    return f"{'':{INDENT}} {row}"


def _numbers(place: Place) -> str:
    if place.end_m == place.start_m:
        return f"{place.start_m:.4g}"
    return f"{place.start_m:.4g} to {place.end_m:.4g}"


def _drive(scenario: Scenario, name: str, scored: Sequence[Place]) -> Figure:
    x, speed = places.speed_along(scenario)
    bumps = places.bumps(scenario)
    found = _in_words([*scored, *places.events(scenario), *bumps])
    return Figure(
        name,
        f"Speed along the drive, {scenario.manoeuvre}",
        f"From {speed[0]:.0f} km/h, between {speed.min():.0f} and {speed.max():.0f} km/h. {found}",
        (Panel("speed", "km/h", (Line("speed", x, speed, "speed"),), 110.0, from_zero=True),),
        "distance in m",
        0.0,
        float(x[-1]),
        (_shade("scored", "scored", scored), _shade_bumps(bumps)),
        tuple(Mark(place.start_m, place.name) for place in places.events(scenario)),
    )


def _draw_parked(scenario: Scenario, name: str, scored: Sequence[Place]) -> Figure:
    """Return the drawing over time of a stationary vehicle."""
    speed = scenario.speed_kmh * KMH
    t = np.linspace(0.0, DURATION_S, SAMPLES)
    line = Line("speed", t, np.full(t.size, scenario.speed_kmh), "speed")
    panels = [Panel("encoder", "km/h", (line,), 80.0, from_zero=True)]
    moves = "the engine shakes the body"
    if scenario.manoeuvre == "bounce":
        height = 1000 * Push().heights(t)[0]
        panels.append(Panel("body", "mm", (Line("height", t, height, "result"),), 80.0))
        moves = f"the body moves between {height.min():.0f} and {height.max():.0f} mm"
    plates = [_in_seconds(plate, 1.0 / speed) for plate in places.bumps(scenario)]
    counted = [_in_seconds(place, 1.0 / speed) for place in scored]
    return Figure(
        name,
        f"A parked vehicle, {scenario.manoeuvre}",
        f"The artificial encoder gives {scenario.speed_kmh:g} km/h for {DURATION_S:g} s; {moves}. "
        f"{_in_words([*counted, *plates])}",
        tuple(panels),
        "time in s",
        0.0,
        DURATION_S,
        (_shade("scored", "scored", counted), _shade_bumps(plates, "plates under the lasers")),
    )


def _shade_bumps(bumps: Sequence[Place], name: str = "known bump") -> Shade:
    return _shade(name, "bump", bumps)


def _shade(name: str, style: str, found: Sequence[Place]) -> Shade:
    return Shade(name, tuple((place.start_m, place.end_m) for place in found), style)


def _in_words(found: Sequence[Place]) -> str:
    return " ".join(
        f"{place.name[:1].upper()}{place.name[1:]}: {_numbers(place)}." for place in found
    )
