"""The published tables beside ours, in the terminal."""

from rich.console import Console
from rich.table import Table

from floatref_conformance.render.terminal import PLAIN_WIDTH
from floatref_conformance.table.cells import Cell, ComparisonTable
from floatref_conformance.table.passes import FITTED, SLIP_PERCENT_PER_G, slip_of
from floatref_conformance.table.published import PublishedFigures, published_table
from floatref_conformance.table.rank import RankCorrelation, rank_correlations
from floatref_conformance.table.text_blocks import begin_block

FIGURES = ("peak,\nm/km", "IRI\nerror, %", "cross\ncorr.")


def print_comparison(table: ComparisonTable, console: Console) -> None:
    """Print one block for each pipeline, then the rank correlations."""
    if not console.is_terminal:
        console.width = max(console.width, PLAIN_WIDTH)
    for pipeline in table.settings.pipelines:
        console.print(_block(pipeline, table.of_pipeline(pipeline)))
    for line in closing_lines(table):
        console.print(line, markup=False, highlight=False, soft_wrap=True)


def closing_lines(table: ComparisonTable) -> list[str]:
    """Return what the means rest on, and how the order of the cells compares with print."""
    made = table.settings
    paths = _count_in_words(len(table.cells[0].passes), "wheel path")
    lines = [
        f"Means over {paths} (roads: {made.roads}, sets of passes on each: {made.seeds}; "
        f"vehicle {made.vehicle}, seed {made.seed}).",
        "All are along the true distance, as in print, but for the last column.",
        "Spearman's rank correlation of the cross correlations, clipped below at 0.2, with print:",
    ]
    found = rank_correlations(table)
    rule = "the rule 'stop: low, else high' alone"
    chapter, stops = found["chapter_5"], found["stops"]
    lines.append(f"  chapter 5: {_rank_in_words(chapter)}; {rule}: {_value(chapter.rule)}")
    fitted = any((cell.pipeline, cell.run) in FITTED for cell in table.cells)
    if fitted:
        lines.append(f"  without the cells marked *: {_rank_in_words(found['predicted'])}")
    lines.append(f"  its stops alone: {_rank_in_words(stops)}")
    if any(slip_of(cell.pipeline) == 0.0 for cell in table.cells):
        lines.append("Pipelines of chapter 6 read an optical encoder, which does not slip (6.5).")
    if fitted:
        lines.append(
            f"* The encoder's slip, {SLIP_PERCENT_PER_G:g} % per g, is fitted to these cells; "
            "all others are predicted."
        )
    return lines


def _block(pipeline: str, cells: tuple[Cell, ...]) -> Table:
    number = published_table(pipeline)
    source = "not published" if number is None else f"Table {number}"
    block = begin_block(f"{pipeline} ({source})", show_edge=False)
    block.add_column("run", no_wrap=True)
    for figure in FIGURES:
        block.add_column(figure, justify="right", no_wrap=True)
        block.add_column("print", justify="right", style="dim", no_wrap=True)
    block.add_column("along\nenc.", justify="right", no_wrap=True)
    for cell in cells:
        block.add_row(*_row(cell))
    return block


def _row(cell: Cell) -> tuple[str, ...]:
    ours, published = cell.mean, cell.published
    theirs = published and published.scores
    return (
        cell.run,
        f"{ours.peak_m_per_km:,.1f}",
        f"{theirs.peak_m_per_km:,.1f}" if theirs else "–",
        f"{ours.iri_error_percent:,.1f}",
        f"{theirs.iri_error_percent:,.1f}" if theirs else "–",
        f"{ours.cross_correlation:.3f}{'*' if (cell.pipeline, cell.run) in FITTED else ''}",
        printed_correlation(published) if published else "–",
        _value(ours.cross_correlation_encoder, 3, "–"),
    )


def printed_correlation(published: PublishedFigures) -> str:
    """Return the published cross correlation as it is printed."""
    if published.cross_correlation_is_upper_bound:
        return f"<{published.scores.cross_correlation:g}"
    return f"{published.scores.cross_correlation:.3f}"


def _rank_in_words(found: RankCorrelation) -> str:
    return f"{_value(found.ours)} over {_count_in_words(found.cells, 'cell')}"


def _count_in_words(number: int, name: str) -> str:
    return f"{number} {name}" if number == 1 else f"{number} {name}s"


def _value(value: float | None, digits: int = 2, missing: str = "no value") -> str:
    return missing if value is None else f"{value:.{digits}f}"
