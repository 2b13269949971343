"""Agreement against lateral separation, as rows and as a picture (figures 4.9 and 4.10)."""

from math import isfinite

import numpy as np

from floatref_conformance.certify.judging.contents import LateralPair, SectionSheet
from floatref_conformance.certify.judging.lateral import REFERENCE
from floatref_conformance.certify.worksheet.pictures import apart
from floatref_conformance.certify.worksheet.wording import number, tracks_of, with_sign
from floatref_conformance.render import svg

HEADS = ("first", "second", "wheel path", "apart, cm", "left, cm", "agreement", "IRI, %")
MOST_ROWS = 40
"""With more, the terminal shows pairs with the reference alone."""
MARGIN = 1.1


def rows(section: SectionSheet) -> tuple[tuple[str, ...], ...]:
    """Return a row for each pair, in the order of `HEADS`, the nearest first."""
    return tuple(_row(one) for one in _sorted(section))


def short_rows(section: SectionSheet) -> tuple[tuple[str, ...], ...]:
    """Return `rows`, or if they are too many those of the pairs with the reference."""
    every = _sorted(section)
    some = [one for one in every if one.first == REFERENCE]
    return tuple(_row(one) for one in (every if len(every) <= MOST_ROWS else some))


def lateral_picture(section: SectionSheet, name: str) -> str:
    """Return agreement against separation, a panel for each wheel path; empty without pairs."""
    if not section.lateral:
        return ""
    drawn = (_panel(section, track) for track in tracks_of(section))
    panels = tuple(panel for panel in drawn if panel.lines)
    if not panels:
        return ""
    farthest = max(100.0 * one.separation_m for one in section.lateral)
    title = "Agreement against lateral separation"
    nearest = _sorted(section)[0]
    text = (
        f"{len(section.lateral)} pairs, {100.0 * nearest.separation_m:.1f} to {farthest:.1f} cm "
        "apart on average."
    )
    end = max(MARGIN * farthest, 1.0)
    return svg.draw_figure(svg.Figure(name, title, text, panels, "apart in cm", 0.0, end))


def _panel(section: SectionSheet, track: str) -> svg.Panel:
    kinds = (
        ("run with the reference", "square", [o for o in section.lateral if o.first == REFERENCE]),
        ("two runs", "dot", [o for o in section.lateral if o.first != REFERENCE]),
    )
    lines = []
    for label, style, found in kinds:
        mine = [one for one in found if one.track == track and isfinite(one.agreement)]
        if mine:
            x = np.array([100.0 * one.separation_m for one in mine])
            y = np.array([one.agreement for one in mine])
            lines.append(svg.Line(label, *apart(x, y), style))
    return svg.Panel(f"agreement, {track}", "", tuple(lines), 130.0)


def _sorted(section: SectionSheet) -> list[LateralPair]:
    return sorted(section.lateral, key=lambda one: one.separation_m)


def _row(one: LateralPair) -> tuple[str, ...]:
    return (
        one.first,
        one.second,
        one.track,
        number(100.0 * one.separation_m, 1),
        with_sign(100.0 * one.left_m, 1),
        number(one.agreement, 4),
        with_sign(one.iri_percent, 2),
    )
