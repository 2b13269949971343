"""The tables of `floatref iri`: each figure beside the share of the road that it is over."""

from collections.abc import Mapping, Sequence
from typing import Any

from floatref.cli.printing import (
    PERCENT_OF_VALID,
    explain_mark,
    marked,
    number,
    percent,
    print_settings,
    print_table,
)

UNITS = {"si": "m/km", "us": "in/mi"}
SUFFIXES = {"si": "m_per_km", "us": "in_per_mi"}
DIGITS = {"si": 3, "us": 1}
EVERY_POINT = "the IRI of all points has the others too"
Figures = Mapping[str, Any]


def print_iri_tables(report: Figures, units: str) -> None:
    """Print tracks, segments if there are several, what a mark means, and settings.

    ``report`` is the JSON document of the command; ``units`` are "si" or "us".
    """
    table = _IriTable(units, _has_interval(report))
    tracks = report["tracks"]
    rows = [[_name(t), *table.cells(t), number(t["invalid_m"], 1)] for t in tracks]
    mean = table.mean_row(report)
    print_table(
        "IRI of valid points", ("track", *table.columns, "invalid m"), [*rows, *mean], numbers=True
    )
    if report["settings"]["segment_m"] is not None:
        columns = ("track", "start m", "length m", *table.columns)
        print_table("Segments", columns, [row for t in tracks for row in table.segment_rows(t)])
    some = any(each["counted_share"] < 1.0 for each in _all_figures(report))
    explain_mark(some, EVERY_POINT)
    print_settings(report["settings"])


def print_track_table(title: str, length_m: float, tracks: Sequence[Figures]) -> None:
    """Print the figures of the wheel paths of one profile under ``title``, in m/km, and the mark.

    ``tracks`` are the figures of `figures_of`, each with its name.
    """
    table = _IriTable("si", with_interval=False)
    length = number(length_m, 2)
    rows = [[_name(t), length, *table.cells(t), number(t["invalid_m"], 2)] for t in tracks]
    print_table(title, ("track", "length m", *table.columns, "invalid m"), rows)
    explain_mark(any(t["counted_share"] < 1.0 for t in tracks), EVERY_POINT)


class _IriTable:
    """The cells of a wheel path or a segment, in one unit, with an interval if 1-σ is known."""

    def __init__(self, units: str, with_interval: bool) -> None:
        self._suffix, self._digits = SUFFIXES[units], DIGITS[units]
        self._with_interval = with_interval
        interval = ("95 % from", "to") if with_interval else ()
        self.columns = (f"IRI {UNITS[units]}", *interval, PERCENT_OF_VALID, "all points")

    def cells(self, figures: Figures) -> list[str]:
        names = ["iri_of_valid"]
        names += ["iri_of_valid_low", "iri_of_valid_high"] if self._with_interval else []
        values = [self._number(figures, name) for name in names]
        return [*values, percent(figures["counted_share"]), self._number(figures, "iri")]

    def segment_rows(self, track: Figures) -> list[list[str]]:
        return [
            [
                marked(track["name"], segment["counted_share"] < 1.0),
                number(segment["start_m"], 2),
                number(segment["length_m"], 2),
                *self.cells(segment),
            ]
            for segment in track["segments"]
        ]

    def mean_row(self, report: Figures) -> list[list[str]]:
        """Return the row of the mean roughness index, or no row for another number of paths."""
        share = report["mean_roughness_index_counted_share"]
        if share is None:
            return []
        gap = ["", ""] if self._with_interval else []
        valid = self._number(report, "mean_roughness_index_of_valid")
        every = self._number(report, "mean_roughness_index")
        name = marked("mean roughness index", share < 1.0)
        return [[name, valid, *gap, percent(share), every, ""]]

    def _number(self, figures: Figures, name: str) -> str:
        return number(figures[f"{name}_{self._suffix}"], self._digits)


def _name(track: Figures) -> str:
    return marked(track["name"], track["counted_share"] < 1.0)


def _all_figures(report: Figures) -> list[Figures]:
    tracks: Sequence[Figures] = report["tracks"]
    return [*tracks, *(segment for track in tracks for segment in track["segments"])]


def _has_interval(report: Figures) -> bool:
    """Return whether any wheel path or segment has an interval."""
    known = (each["iri_of_valid_low_m_per_km"] for each in _all_figures(report))
    return any(value == value for value in known)
