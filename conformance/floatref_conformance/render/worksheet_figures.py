"""Which pictures a worksheet has, in which order, and what is written below them."""

from collections.abc import Iterator
from math import inf, isnan

from floatref_conformance.certify.limits import CertificationLimits
from floatref_conformance.certify.worksheet import RunSheet, RunTrack, SectionSheet, StationarySheet
from floatref_conformance.render import worksheet_pictures as pictures
from floatref_conformance.render import worksheet_wording as wording
from floatref_conformance.render.failures import Markup, Picture
from floatref_conformance.render.heat_map import heat_map
from floatref_conformance.render.lag_picture import lag_picture

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
            pictures.overlaid(sheet, track, limits, f"{name}-all"),
            f"Wheel path {track}: elevation of wavelengths up to {pictures.SHOWN_M:g} m, and "
            "roughness over 7.62 m, of the reference and of all runs.",
        )
        yield _picture(
            pictures.close_up(sheet, track, limits, f"{name}-close"),
            f"Wheel path {track}: the roughest {pictures.CLOSE_M:g} m of the reference.",
        )
        if len(sheet.runs) > 1 and track in sheet.pairs:
            title = f"Wheel path {track}: cross correlation of all pairs of runs"
            drawn = heat_map(f"{name}-pairs", title, sheet.pairs[track], limits.repeatability)
            yield _picture(drawn, f"{title}, by their numbers.")
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
    """Return the wheel path that tells the distance best: all share one encoder."""
    return min(run.tracks, key=lambda t: inf if isnan(t.distance_sigma) else t.distance_sigma)


def of_test(sheet: StationarySheet, anchor: str) -> tuple[Picture, ...]:
    """Return the picture of a stationary test, if there is a profile of it."""
    drawn = pictures.at_rest(sheet, f"{anchor}-profile")
    caption = "The profile of the standing vehicle; what counts is shaded."
    return (_picture(drawn, caption),) if drawn else ()


def _picture(svg: str, caption: str) -> Picture:
    return Picture(caption, Markup(svg))
