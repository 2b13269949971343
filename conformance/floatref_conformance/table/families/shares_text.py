"""The family `stops` in the terminal: a block of shares for each pipeline, and what they mean."""

from collections.abc import Sequence
from dataclasses import astuple

from rich.table import Table

from floatref_conformance.table.families.family_table import FamilyPath, FamilyTable, summarize
from floatref_conformance.table.families.stop_shares import (
    FLAGGED_M,
    HELD_PERCENT,
    rows_of_stops,
    share_stops,
)
from floatref_conformance.table.text_blocks import begin_block

CORRELATION = ("r,\nmedian", "\n10 %", "\n1 %", "\nlowest", "IRI,\n50 %")
KINDS = ("right,\nvalid", "right,\nflagged", "wrong,\nflagged", "wrong,\nvalid")
FLAGGED = ("m flag.,\n50 %", "\n95 %")
SIGMA = ("2 sigma,\npooled", "\nheld", "\n≥ 85", "\n10 %", "\n50 %")
EXPLANATION = (
    "Shares are along the encoder's distance and over all points of 160.9 m. Right and wrong, in "
    "percent of wheel paths: the IRI of all points, within 5 % or 0.1 m/km. Valid: at most "
    f"{FLAGGED_M:g} m flagged at 16 km/h or more. Wrong, flagged: right with the road's shape in "
    "place of flagged points, or no profile. Wrong, valid: wrong even so. m flag.: metres flagged "
    "at 16 km/h or more at an event. 2 sigma, in percent: of all points, those within two sigma; "
    f"held: of wheel paths, those with {HELD_PERCENT[0]:g} to {HELD_PERCENT[1]:g} % of their "
    f"points; ≥ {HELD_PERCENT[0]:g}: with that or more; 10 %, 50 %: quantiles of wheel paths."
)
"""What stands below the blocks."""


def shares_block(table: FamilyTable, pipeline: str) -> Table:
    """Return one row for each condition, and one for each vehicle below it."""
    block = begin_block(f"{pipeline}: stops along the encoder's distance", padding=0)
    block.add_column("condition", no_wrap=True, vertical="bottom")
    for heading in ("wheel\npaths", *CORRELATION, *KINDS, *FLAGGED, *SIGMA):
        block.add_column(heading, justify="right", no_wrap=True, vertical="bottom")
    for condition, vehicle, paths in rows_of_stops(table, pipeline):
        name = condition.name if vehicle is None else f"  {vehicle}"
        style = "bold" if vehicle is None else ""
        block.add_row(name, *_row(paths), style=style)
    return block


def _row(paths: Sequence[FamilyPath]) -> tuple[str, ...]:
    found, shares = summarize(paths).encoder, share_stops(paths)
    return (
        f"{len(paths)}",
        f"{found.cross_correlation_median:.3f}",
        f"{found.cross_correlation_percentile_10:.3f}",
        f"{found.cross_correlation_percentile_1:.3f}",
        f"{found.cross_correlation_lowest:.3f}",
        _number(found.iri_error_median_percent),
        _number(shares.right_valid_percent),
        _number(shares.right_flagged_percent),
        _number(shares.wrong_flagged_percent),
        _number(shares.wrong_valid_percent),
        _number(shares.flagged_fast_median_m),
        _number(shares.flagged_fast_percentile_95_m),
        *(_number(None) for _ in SIGMA if shares.sigma is None),
        *map(_number, astuple(shares.sigma) if shares.sigma else ()),
    )


def _number(value: float | None) -> str:
    return "–" if value is None else f"{value:.1f}"
