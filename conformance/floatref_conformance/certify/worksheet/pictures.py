"""The pictures of a worksheet: runs over the reference, their IRI, lags, and what stood still."""

from collections.abc import Iterator
from math import isnan

import numpy as np

from floatref.errors import InputError
from floatref.measures import high_pass, short_interval_roughness
from floatref.values.arrays import FloatArray
from floatref.values.profile import Profile
from floatref_conformance.certify.fitting.fit import WINDOW_M, fit
from floatref_conformance.certify.judging.contents import RunSheet, SectionSheet, StationarySheet
from floatref_conformance.certify.judging.limits import CertificationLimits
from floatref_conformance.certify.worksheet import wording
from floatref_conformance.render import svg
from floatref_conformance.render.svg import Figure, Line, Panel, Shade, draw_figure

SHOWN_M = 30.0
"""Longest wavelength of the elevations shown: a profile's drift would hide the road."""
CLOSE_M = 15.0
"""Length of the stretch that is shown close up."""
LONGEST_NAME = 24
AROUND = 0.03
"""Least range of the axis of the IRI around the reference's."""
NAMED = 2
"""Runs that do not agree and have a line of their own in the legend."""


def overlay(section: SectionSheet, track: str, limits: CertificationLimits, name: str) -> str:
    """Return the reference with all runs of ``track`` over it, as one SVG element.

    Elevation of wavelengths up to `SHOWN_M`, and the roughness over 7.62 m.
    """
    pairs = tuple(_profiles(section, track, limits))
    panels = (
        Panel("elevation", "mm", tuple(_elevation(*pair, track) for pair in pairs), 170.0),
        Panel("roughness", "m/km", tuple(_roughness(*pair, track) for pair in pairs), 120.0, True),
    )
    title = f"Wheel path {track}: {len(pairs) - 1} runs over the reference"
    return _draw_along(section.start_m, section.end_m, panels, title, name)


def close_up(section: SectionSheet, track: str, limits: CertificationLimits, name: str) -> str:
    """Return the roughest stretch of the reference, of `CLOSE_M`, with all runs over it."""
    start = roughest_m(section.reference, track)
    pairs = tuple(_profiles(section, track, limits))
    end = start + CLOSE_M
    lines = tuple(_between(_elevation(*pair, track), start, end) for pair in pairs)
    panel = Panel("elevation", "mm", lines, 200.0)
    title = f"Wheel path {track}: the roughest {CLOSE_M:g} m"
    return _draw_along(start, end, (panel,), title, name)


def roughest_m(reference: Profile, track: str) -> float:
    """Return where the roughest `CLOSE_M` of ``track`` begin, in m on its axis."""
    elevation = reference.track(track).elevation
    try:
        rough = short_interval_roughness(elevation, reference.interval_m, CLOSE_M)
    except InputError:
        return reference.start_m
    half = round(CLOSE_M / 2 / reference.interval_m)
    inner = rough[half : max(rough.size - half, half + 1)]
    if not np.isfinite(inner).any():
        return reference.start_m
    return float(reference.start_m + np.nanargmax(inner) * reference.interval_m)


def iri_by_run(section: SectionSheet, limits: CertificationLimits, name: str) -> str:
    """Return the IRI of every run beside the reference's, one panel for each wheel path."""
    numbers = np.arange(1.0, len(section.runs) + 1.0)
    panels = tuple(
        _iri_panel(section, track, limits, numbers) for track in wording.tracks_of(section)
    )
    first, last = 0.5, len(section.runs) + 0.5
    return draw_figure(
        Figure(
            name,
            "IRI of every run against the reference's",
            "; ".join(_describe_iri(section, track) for track in wording.tracks_of(section)),
            panels,
            "run",
            first,
            last,
            numbered=tuple(numbers[:: -(-len(section.runs) // 24)]),
        )
    )


def at_rest(sheet: StationarySheet, name: str) -> str:
    """Return the profile of a stationary test with the stretch that counts; empty without one."""
    profile = sheet.profile
    if profile is None:
        return ""
    elevation, roughness = [], []
    for track, style in zip(profile.tracks, ("result", "second", *["run"] * 99), strict=False):
        label = _short(track.name)
        rough = _rough(profile, track.elevation)
        middle = profile.distance_m[:-1] + profile.interval_m / 2
        elevation.append(Line(label, profile.distance_m, 1000.0 * track.elevation, style))
        roughness.append(Line(label, middle, rough, style))
    panels = (
        Panel("elevation", "mm", tuple(elevation), 120.0, held=_counting_values(elevation, sheet)),
        Panel(
            "roughness", "m/km", tuple(roughness), 110.0, True, _counting_values(roughness, sheet)
        ),
    )
    end = max(float(profile.distance_m[-1]), profile.start_m + profile.interval_m)
    reach = () if isnan(sheet.start_m) else ((sheet.start_m, sheet.end_m),)
    counts = Shade("counts", reach, "scored")
    title = f"Test {sheet.id}: elevation and roughness of a standing vehicle"
    text = f"What counts: {wording.what_counts(sheet)}."
    return draw_figure(
        Figure(name, title, text, panels, "distance in m", profile.start_m, end, (counts,))
    )


def _counting_values(lines: list[Line], sheet: StationarySheet) -> FloatArray | None:
    """Return the values that count, so that what happens beside them does not hide them."""
    parts = [line.y[(line.x >= sheet.start_m) & (line.x <= sheet.end_m)] for line in lines]
    held = np.concatenate(parts)
    return held if np.isfinite(held).any() else None


def _draw_along(start: float, end: float, panels: tuple[Panel, ...], title: str, name: str) -> str:
    text = f"{title}, {start:.6g} m to {end:.6g} m."
    return draw_figure(Figure(name, title, text, panels, "distance in m", start, end))


def _profiles(
    section: SectionSheet, track: str, limits: CertificationLimits
) -> Iterator[tuple[Profile, str, str]]:
    """Yield the reference and every run that has ``track``, with its name and its style.

    Runs that do not agree come last and so lie on top.
    """
    yield section.reference, "reference", "truth"
    runs = [run for run in section.runs if _has(run, track)]
    bad = [run for run in runs if wording.is_bad(run, limits, track)]
    for run in runs:
        if run not in bad and run.profile is not None:
            yield run.profile, "runs", "run"
    for index, run in enumerate(bad):
        if run.profile is not None:
            own = index < NAMED and len(bad) <= NAMED
            label = f"{_short(run.name)} (does not agree)" if own else "runs that do not agree"
            yield run.profile, label, f"failing-{min(index, NAMED - 1) + 1 if own else 1}"


def _has(run: RunSheet, track: str) -> bool:
    return run.profile is not None and track in [one.name for one in run.profile.tracks]


def _short(name: str) -> str:
    return name if len(name) <= LONGEST_NAME else f"{name[: LONGEST_NAME - 1]}…"


def _elevation(profile: Profile, label: str, style: str, track: str) -> Line:
    elevation = profile.track(track).elevation
    try:
        shown = high_pass(elevation, profile.interval_m, SHOWN_M)
    except InputError:
        shown = np.full(elevation.size, np.nan)
    return Line(label, profile.distance_m, 1000.0 * shown, style)


def _between(line: Line, start: float, end: float) -> Line:
    """Return the part of ``line`` from ``start`` to ``end``, so that it keeps all its points."""
    inside = (line.x >= start) & (line.x <= end)
    return Line(line.label, line.x[inside], line.y[inside], line.style)


def _roughness(profile: Profile, label: str, style: str, track: str) -> Line:
    middle = profile.distance_m[:-1] + profile.interval_m / 2
    return Line(label, middle, _rough(profile, profile.track(track).elevation), style)


def _rough(profile: Profile, elevation: FloatArray) -> FloatArray:
    try:
        return short_interval_roughness(elevation, profile.interval_m)
    except InputError:
        return np.full(elevation.size - 1, np.nan)


def _iri_panel(
    section: SectionSheet, track: str, limits: CertificationLimits, numbers: FloatArray
) -> Panel:
    """Return the reference's IRI as a line, and a dot for each run: round, or else square."""
    iri = section.reference_iri[track]
    across = np.array([0.5, len(section.runs) + 0.5])
    found = np.array([_iri(run, track) for run in section.runs])
    bad = np.array([wording.is_bad(run, limits, track) for run in section.runs])
    lines = [
        Line("reference", across, np.array([iri, iri]), "truth"),
        Line("run", *apart(numbers, np.where(bad, np.nan, found)), "dot"),
        Line("run that does not agree", *apart(numbers, np.where(bad, found, np.nan)), "square"),
    ]
    shown = tuple(line for line in lines if np.isfinite(line.y).any())
    held = np.concatenate([found, iri * np.array([1.0 - AROUND, 1.0 + AROUND])])
    return Panel(f"IRI, {track}", "m/km", shown, 110.0, held=held)


def apart(x: FloatArray, y: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return the points with a missing one behind each, so that each is a dot."""
    return np.repeat(x, 2), np.column_stack([y, np.full(y.size, np.nan)]).ravel()


def _iri(run: RunSheet, track: str) -> float:
    return next((one.iri_m_per_km for one in run.tracks if one.track == track), float("nan"))


def _describe_iri(section: SectionSheet, track: str) -> str:
    found = [_iri(run, track) for run in section.runs]
    known = [value for value in found if value == value]
    spread = f"runs {min(known):.3f} to {max(known):.3f} m/km" if known else "no runs"
    return f"{track}: reference {section.reference_iri[track]:.3f} m/km, {spread}"


def lag_picture(section: SectionSheet, run: RunSheet, track: str, name: str) -> str:
    """Return the lags of windows of a run against distance; empty where they are not known.

    Of a run that lies right they are level; one that measures distance too long lies the farther
    ahead, the farther it has come.
    """
    if run.profile is None:
        return ""
    found = fit(section.reference, run.profile, track)
    if found.line is None or not found.at_m.size:
        return ""
    ends = np.array([section.start_m, section.end_m])
    lags = found.line.run_at(ends) - ends
    of = f"{run.name}, wheel path {track}"
    return lag_along(found.at_m, found.lag_m, ends, lags, of, name)


def lag_along(
    at_m: FloatArray, lag_m: FloatArray, ends_m: FloatArray, line_m: FloatArray, of: str, name: str
) -> str:
    """Return lags in m at ``at_m`` as dots, and the line through ``line_m`` at ``ends_m``."""
    percent = 100.0 * (line_m[1] - line_m[0]) / (ends_m[1] - ends_m[0])
    lines = (
        svg.Line(f"line of {percent:+.2f} %".replace("-", "−"), ends_m, 1000.0 * line_m, "truth"),
        svg.Line(f"windows of {WINDOW_M:g} m", *apart(at_m, 1000.0 * lag_m), "dot"),
    )
    title = f"{of}: lag against distance"
    text = f"The lag goes from {line_m[0]:.3f} m to {line_m[1]:.3f} m."
    panel = svg.Panel("lag", "mm", lines, 130.0)
    return svg.draw_figure(
        svg.Figure(name, title, text, (panel,), "distance in m", ends_m[0], ends_m[1])
    )
