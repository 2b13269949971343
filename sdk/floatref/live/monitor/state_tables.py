"""A state as tables for a terminal of 80 columns, and as one line."""

from rich import box
from rich.console import Group, RenderableType
from rich.table import Table
from rich.text import Text

from floatref.live.monitor.sections import Section, TrackFigures
from floatref.live.monitor.sensor_health import Health, SensorState
from floatref.live.monitor.shown_state import Shown, Status

FINAL, PROVISIONAL = 8, 3
"""Finished sections that are shown."""
BUSY_S = 1.0
"""Time in s after which a calculation is shown."""
UNKNOWN = "–"
HEALTH = {Health.OK: "green", Health.WAITING: "dim", Health.SILENT: "bold yellow"}
STATUS = {Status.RUNNING: "bold green", Status.COMPLETE: "bold"}
MANY = 10_000_000
"""A count from which on millions are shown."""
TO_KMH = 3.6


def render(shown: Shown) -> RenderableType:
    """Return the tables of what is ``shown``."""
    parts: list[RenderableType] = [_head(shown), _sensors(shown), _sections(shown)]
    parts += [Text(_describe_event(each.text, each.at_m)) for each in shown.events]
    if shown.fault:
        parts.append(Text(f"the display has failed: {shown.fault}", style="red"))
    return Group(*parts)


def plain_line(shown: Shown) -> str:
    """Return the most important of what is ``shown`` on one line."""
    bad = [f"{s.name} {_describe_health(s)}" for s in shown.sensors if s.health is not Health.OK]
    final = [each for each in shown.sections if each.is_final][-1:]
    parts = [
        f"{shown.name} {_describe_status(shown)}",
        f"{_kmh(shown)} km/h",
        f"{_number(shown.distance_m, 1)} m",
        f"final to {_number(shown.final_m, 1)} m",
        *(f"IRI {t.name} {_describe_iri(t)} m/km" for each in final for t in each.tracks),
        f"{shown.dropped} samples dropped",
        f"{shown.late} late",
        *bad,
        *([f"the display has failed: {shown.fault}"] if shown.fault else []),
    ]
    return _on_one_line(", ".join(parts))


def _head(shown: Shown) -> Text:
    minutes, seconds = divmod(int(shown.for_s), 60)
    return Text.assemble(
        (_on_one_line(shown.name), "bold"),
        "  ",
        (_describe_status(shown), STATUS.get(shown.status, "bold yellow")),
        f"  {minutes}:{seconds:02d} min  {shown.pipeline}\n",
        ("speed ", "dim"),
        (f"{_kmh(shown)} km/h", "bold"),
        ("   distance ", "dim"),
        f"{_number(shown.distance_m, 1)} m",
        ("   final to ", "dim"),
        f"{_number(shown.final_m, 1)} m\n",
        ("next final point ", "dim"),
        _describe_next(shown),
        ("\nsamples dropped ", "dim"),
        (str(shown.dropped), "bold red" if shown.dropped else ""),
        ("   late ", "dim"),
        (str(shown.late), "bold red" if shown.late else ""),
    )


def _describe_status(shown: Shown) -> str:
    reason = f": {shown.reason}" if shown.reason else ""
    seconds = shown.calculates_s
    busy = "" if seconds is None or seconds < BUSY_S else f", calculates for {seconds:.0f} s"
    return _on_one_line(f"{shown.status}{reason}{busy}")


def _describe_next(shown: Shown) -> str:
    to = shown.to_final
    if to is None:
        return UNKNOWN
    if to.travel_m == 0.0:
        return "is due, and is calculated"
    then_s, standing_s = to.latency.then_s, to.latency.standing_s
    return f"in {to.travel_m:.0f} m and {then_s:g} s; at a standstill after {standing_s:g} s"


def _sensors(shown: Shown) -> Table:
    table = _table(["channel", "state"], ["samples", "missing", "dropped", "late"])
    for each in shown.sensors:
        state = Text(_describe_health(each), style=HEALTH.get(each.health, "bold red"))
        counts = (each.samples, each.missing, each.dropped, each.late)
        table.add_row(Text(each.name), state, *map(_count, counts))
    return table


def _describe_health(sensor: SensorState) -> str:
    if sensor.health is Health.MISSING:
        return f"{100.0 * sensor.missing_share:.0f} % missing"
    if sensor.health is Health.STUCK:
        return f"stuck for {sensor.unchanged_s:.0f} s"
    if sensor.health is Health.SILENT:
        return f"silent for {sensor.silent_s:.0f} s"
    return str(sensor.health)


def _sections(shown: Shown) -> Table:
    chosen = _chosen(shown)
    names = [track.name for track in chosen[-1].tracks] if chosen else []
    heads = [f"{name}: m/km ± 1-σ, valid" for name in names]
    table = _table(["IRI from, m", "points"], heads)
    for each in reversed(chosen):
        style = "" if each.is_final and not each.is_running else "italic cyan"
        cells = map(_describe_iri, each.tracks)
        table.add_row(_number(each.start_m, 1), _describe_state(each), *cells, style=style)
    return table


def _chosen(shown: Shown) -> list[Section]:
    """Return the sections that are shown, by distance."""
    final = [each for each in shown.sections if each.is_final]
    provisional = [each for each in shown.sections if not each.is_final]
    running = [] if shown.running is None else [shown.running]
    return [*final[-FINAL:], *provisional[-PROVISIONAL:], *running]


def _describe_state(section: Section) -> str:
    state = "final" if section.is_final else "provisional"
    return f"{state}, {section.length_m:.0f} m" if section.is_running else state


def _describe_iri(track: TrackFigures) -> str:
    sigma = track.sigma_m_per_km
    spread = f" ± {sigma:.3f}" if sigma == sigma else ""
    share = f"{int(100.0 * track.counted_share)} %"
    return f"{_number(track.iri_m_per_km, 3)}{spread}, {share}"


def _describe_event(text: str, at_m: float | None) -> str:
    place = "" if at_m is None else f"at {at_m:.0f} m: "
    return _on_one_line(f"{place}{text}")


def _table(texts: list[str], numbers: list[str]) -> Table:
    table = Table(box=box.SIMPLE_HEAD, padding=(0, 1, 0, 0), pad_edge=False)
    for name in texts:
        table.add_column(Text(name))
    for name in numbers:
        table.add_column(Text(name), justify="right")
    return table


def _number(value: float | None, digits: int) -> str:
    return UNKNOWN if value is None or value != value else f"{value:.{digits}f}"


def _count(value: int) -> str:
    return str(value) if value < MANY else f"{value / 1e6:.0f} M"


def _kmh(shown: Shown) -> str:
    return _number(None if shown.speed_mps is None else TO_KMH * shown.speed_mps, 1)


def _on_one_line(text: str) -> str:
    """Return ``text`` with what a terminal would obey, such as escapes, written out."""
    return "".join(c if c.isprintable() else ascii(c)[1:-1] for c in text)
