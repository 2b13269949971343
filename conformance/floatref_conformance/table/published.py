"""The figures of Tables 5.3 to 5.12 and 6.2 to 6.6 of Karamihas 2021."""

import csv
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from types import MappingProxyType

from floatref_conformance.proving_ground.drives.runs import REFERENCE_RUN, RUNS
from floatref_conformance.table.scores import Scores

RUN_NAMES = tuple(name for name in RUNS if name != REFERENCE_RUN)
"""The 17 runs of Tables 5.1 and 5.2, in the order of print."""
PRINTED_FLOOR = 0.2
"""Cross correlations below this are printed as "< 0.2"."""
REFERENCE_IRI_M_PER_KM = 1.578
"""IRI of the published reference pass over the 160.9 m."""


@dataclass(frozen=True)
class PublishedFigures:
    """What the dissertation prints for one pipeline on one run.

    Attributes:
        table: number of the table, for example "5.3".
        scores: the three figures.
        cross_correlation_is_upper_bound: whether "< 0.2" is printed for the cross correlation,
            which is then given as 0.2.
    """

    table: str
    scores: Scores
    cross_correlation_is_upper_bound: bool

    @property
    def chapter(self) -> int:
        """Number of the chapter that the table is in."""
        return chapter_of(self.table)


@cache
def published_figures() -> Mapping[tuple[str, str], PublishedFigures]:
    """Return the published figures by pipeline and run, in the order of print."""
    text = (files(__package__) / "data" / "results.csv").read_text(encoding="utf-8")
    rows = csv.DictReader(text.splitlines())
    return MappingProxyType({(row["algorithm"], row["run"]): _figures(row) for row in rows})


def published_table(pipeline: str) -> str | None:
    """Return the number of the table of ``pipeline``; None if nothing was published of it."""
    numbers = (f.table for (name, _), f in published_figures().items() if name == pipeline)
    return next(numbers, None)


def chapter_of(table: str) -> int:
    """Return the number of the chapter that a table is in: 6 of "6.2"."""
    return int(table.partition(".")[0])


def _figures(row: Mapping[str, str]) -> PublishedFigures:
    scores = Scores(
        float(row["peak_roughness_m_per_km"]),
        float(row["average_roughness_error_pct"]),
        float(row["cross_correlation"]),
    )
    bounded = row["cross_correlation_is_upper_bound"] == "true"
    return PublishedFigures(row["table"], scores, bounded)
