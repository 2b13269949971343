"""Which pictures a worksheet has, in which order, and what is written below them."""

from collections.abc import Iterator

from floatref_conformance.certify.limits import CertificationLimits
from floatref_conformance.certify.worksheet import SectionSheet, StationarySheet
from floatref_conformance.render import worksheet_pictures as pictures
from floatref_conformance.render import worksheet_wording as wording
from floatref_conformance.render.failures import Markup, Picture
from floatref_conformance.render.heat_map import heat_map


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


def of_test(sheet: StationarySheet, anchor: str) -> tuple[Picture, ...]:
    """Return the picture of a stationary test, if there is a profile of it."""
    drawn = pictures.at_rest(sheet, f"{anchor}-profile")
    caption = "The profile of the standing vehicle; what counts is shaded."
    return (_picture(drawn, caption),) if drawn else ()


def _picture(svg: str, caption: str) -> Picture:
    return Picture(caption, Markup(svg))
