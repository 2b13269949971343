"""Families in the terminal: a block for each pipeline, then where what is valid is wrong."""

from rich.console import Console
from rich.table import Table

from floatref_conformance.render.terminal import PLAIN_WIDTH
from floatref_conformance.table.families.conditions import STOPS_FAMILY
from floatref_conformance.table.families.family_table import (
    AxisSummary,
    FamilyPath,
    FamilyTable,
    error_of_valid,
    summarize,
)
from floatref_conformance.table.families.shares_text import EXPLANATION, shares_block
from floatref_conformance.table.text_blocks import begin_block, describe_drive

FIGURES = ("median", "10 %", "lowest", "IRI 90 %", "right %")
WIDTH = 140
"""Columns of the output where the terminal's width is unknown."""


def print_families(table: FamilyTable, console: Console) -> None:
    """Print every pipeline by condition, then the worst drives whose valid points are wrong.

    The family `stops` has a second block of each pipeline.
    """
    if not console.is_terminal:
        console.width = max(console.width, PLAIN_WIDTH, WIDTH)
    for pipeline in table.settings.pipelines:
        console.print(_block(table, pipeline))
        if table.settings.family == STOPS_FAMILY:
            console.print(shares_block(table, pipeline))
    for line in closing_lines(table):
        console.print(line, markup=False, highlight=False, soft_wrap=True)


def closing_lines(table: FamilyTable) -> list[str]:
    """Return what the figures are of, and the pipelines and conditions that are wrong."""
    made, wrong = table.settings, table.wrong()
    lines = [
        "Cross correlation with the road along the laser's path after the IRI filter, along the "
        f"true distance and along the encoder's; {made.drives} drives of each condition, two wheel "
        f"paths each, seed {made.seed}. 10 %: the 10th percentile; IRI 90 %: the 90th of its "
        "error, in percent; right %: wheel paths whose valid points have an IRI within 5 % or 0.1 "
        "m/km.",
        *([EXPLANATION] if made.family == STOPS_FAMILY else []),
        "",
    ]
    if not wrong:
        return [*lines, "What is valid is right (5 % or 0.1 m/km) on every drive."]
    lines.append("What is valid is wrong (by more than 5 % and 0.1 m/km), worst drive of each:")
    return lines + [_describe_wrong(path) for path in wrong]


def _describe_wrong(path: FamilyPath) -> str:
    where = f"{path.condition.family}, {path.condition.name}"
    error = error_of_valid(path) or 0.0
    return f"{path.pipeline}: {where}: {path.track}, {error:.1f} %: {describe_drive(path.scenario)}"


def _block(table: FamilyTable, pipeline: str) -> Table:
    block = begin_block(pipeline)
    block.add_column("condition", no_wrap=True)
    for axis in ("true", "enc."):
        for figure in FIGURES:
            block.add_column(f"{axis},\n{figure}", justify="right", no_wrap=True, vertical="bottom")
    block.add_column("flagged,\nm", justify="right", no_wrap=True, vertical="bottom")
    block.add_column("no\nprofile", justify="right", no_wrap=True, vertical="bottom")
    for condition in table.settings.conditions:
        found = summarize(table.of(pipeline, condition))
        block.add_row(
            condition.full_name,
            *_axis(found.true),
            *_axis(found.encoder),
            _number(found.flagged_median_m, 0),
            f"{found.without_profile}" if found.without_profile else "–",
        )
    return block


def _axis(found: AxisSummary) -> tuple[str, ...]:
    return (
        f"{found.cross_correlation_median:.3f}",
        f"{found.cross_correlation_percentile_10:.3f}",
        f"{found.cross_correlation_lowest:.3f}",
        _number(found.iri_error_percentile_90_percent, 1),
        f"{found.right_percent:.0f}",
    )


def _number(value: float | None, digits: int) -> str:
    return "–" if value is None else f"{value:,.{digits}f}"
