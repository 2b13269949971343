"""Drawn stops in the terminal: one block for each pipeline, then all of them in one."""

from collections.abc import Iterator

from rich.console import Console
from rich.table import Table

from floatref_conformance.render.terminal import PLAIN_WIDTH
from floatref_conformance.table.stops.stop_scores import STRETCH_M
from floatref_conformance.table.stops.stop_settings import STOP_ROADS
from floatref_conformance.table.stops.stop_table import StopSummary, StopTable, summary
from floatref_conformance.table.text_blocks import begin_block, describe_drive

SCORES = ("cross\ncorr.\nmedian", "1st\nperc.", "lowest", "IRI\nerror, %\nmedian", "largest")
SHARES = ("% in\n2 sigma\nlowest", "median", "highest")


def print_stops(table: StopTable, console: Console) -> None:
    """Print every pipeline by vehicle and road, then the pipelines beside each other."""
    if not console.is_terminal:
        console.width = max(console.width, PLAIN_WIDTH)
    pipelines = table.settings.pipelines
    for pipeline in pipelines:
        block = _empty(pipeline, "", "wheel\npaths", *SCORES, *SHARES)
        for name, found in _groups(table, pipeline):
            block.add_row(name, f"{found.wheel_paths}", *_scores(found), *_shares(found))
        console.print(block)
        for line in below_block(table, pipeline):
            console.print(line, markup=False, highlight=False, soft_wrap=True)
    if len(pipelines) > 1:
        console.print(_together(table))
        console.print(_together_along_encoder(table))
    console.print(closing_line(table), markup=False, highlight=False, soft_wrap=True)


def below_block(table: StopTable, pipeline: str) -> list[str]:
    """Return the lines below the block of ``pipeline``, and an empty line."""
    found = summary(table.of(pipeline))
    shares = found.within_two_sigma_true_distance_percent
    lines = [*_beside(found), lowest_line(table, pipeline), ""]
    if shares is not None:
        lines.insert(
            0,
            f"% in 2 sigma along the true distance: {shares.lowest:.1f} to {shares.highest:.1f}, "
            f"median {shares.median:.1f}",
        )
    return lines


def _beside(found: StopSummary) -> list[str]:
    """Return the line of quantiles along the encoder's distance, if they are known."""
    if found.cross_correlation_encoder_median is None:
        return []
    return [
        "cross correlation along the encoder's distance: median "
        f"{found.cross_correlation_encoder_median:.3f}, 1st percentile "
        f"{found.cross_correlation_encoder_percentile_1:.3f}, lowest "
        f"{found.cross_correlation_encoder_lowest:.3f} (the block: along the true distance)"
    ]


def lowest_line(table: StopTable, pipeline: str) -> str:
    """Return the scenario file of the lowest cross correlation, without what is usual in it."""
    lowest = table.lowest(pipeline)
    return f"lowest ({lowest.track}): {describe_drive(lowest.scenario)}"


def closing_line(table: StopTable) -> str:
    """Return what the figures are of."""
    made = table.settings
    return (
        f"Against the truth along the laser's path, {STRETCH_M[0]:g} m to {STRETCH_M[1]:g} m; "
        f"drives: {made.passes} (stops of each vehicle on each road: {made.stops}), "
        f"roads: {', '.join(f'{r.name} {r.iri_m_per_km:g} m/km' for r in STOP_ROADS)}; "
        f"seed {made.seed}."
    )


def _groups(table: StopTable, pipeline: str) -> Iterator[tuple[str, StopSummary]]:
    yield "all", summary(table.of(pipeline))
    for vehicle in table.settings.vehicles:
        yield vehicle, summary(table.of(pipeline, vehicle=vehicle))
    for road in STOP_ROADS:
        yield f"{road.name} road", summary(table.of(pipeline, road=road.kind))


def _together(table: StopTable) -> Table:
    """Return one row for each pipeline."""
    block = _empty("All vehicles and roads", "pipeline", *SCORES)
    for name in table.settings.pipelines:
        block.add_row(name, *_scores(summary(table.of(name))))
    return block


def _together_along_encoder(table: StopTable) -> Table:
    """Return the same quantiles of the cross correlation along the encoder's distance."""
    block = _empty("The same along the encoder's distance", "pipeline", *SCORES[:3])
    for name in table.settings.pipelines:
        block.add_row(name, *_encoder(summary(table.of(name))))
    return block


def _empty(title: str, of_what: str, *figures: str) -> Table:
    block = begin_block(title, padding=0)
    block.add_column(of_what, no_wrap=True, vertical="bottom")
    for figure in figures:
        block.add_column(figure, justify="right", no_wrap=True, vertical="bottom")
    return block


def _scores(found: StopSummary) -> tuple[str, ...]:
    return (
        f"{found.cross_correlation_median:.3f}",
        f"{found.cross_correlation_percentile_1:.3f}",
        f"{found.cross_correlation_lowest:.3f}",
        _percent(found.iri_error_median_percent),
        _percent(found.iri_error_largest_percent),
    )


def _encoder(found: StopSummary) -> tuple[str, ...]:
    values = (
        found.cross_correlation_encoder_median,
        found.cross_correlation_encoder_percentile_1,
        found.cross_correlation_encoder_lowest,
    )
    return tuple("–" if value is None else f"{value:.3f}" for value in values)


def _shares(found: StopSummary) -> tuple[str, ...]:
    shares = found.within_two_sigma_percent
    if shares is None:
        return ("–",) * len(SHARES)
    return (f"{shares.lowest:.1f}", f"{shares.median:.1f}", f"{shares.highest:.1f}")


def _percent(error: float) -> str:
    return f"{error:.1f}" if error < 999.95 else f"{error:,.0f}"
