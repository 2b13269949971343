"""The progress and the final report of `floatref batch`."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from datetime import timedelta
from math import isnan
from pathlib import Path
from threading import Event, Thread
from time import monotonic
from typing import TYPE_CHECKING, Any, TextIO

import click

from floatref.batch.results.summary import CSV, PARQUET
from floatref.batch.results.totals import Tally
from floatref.cli.printing import (
    PERCENT_OF_VALID,
    explain_mark,
    marked,
    number,
    percent,
    print_table,
)
from floatref.errors import one_line

if TYPE_CHECKING:
    from rich.console import Console

EVERY_S = 30.0
"""Time in s between two plain lines."""

REFRESH_S = 5.0
"""Time in s until a bar is drawn again, with the number of workers."""


@contextmanager
def progress(
    tally: Tally, stream: TextIO, workers: Callable[[], int], every_s: float = EVERY_S
) -> Iterator[Callable[[], None]]:
    """Show ``tally`` on ``stream`` as it grows; yield the function to call after each change."""
    from rich.console import Console

    console = Console(file=stream)
    if console.is_terminal:
        with _bar(tally, console) as show, _call_regularly(lambda: show(workers()), REFRESH_S):
            yield show
        return
    with _call_regularly(
        lambda: print(describe_progress(tally, workers()), file=stream, flush=True), every_s
    ):
        yield lambda: None


@contextmanager
def _bar(tally: Tally, console: "Console") -> Iterator[Callable[..., None]]:
    """Yield a function that sets a bar to ``tally``; it stores the number of workers if given."""
    from rich.progress import BarColumn, Progress, TextColumn

    columns = (BarColumn(), TextColumn("{task.description}"))
    with Progress(*columns, console=console, transient=True) as bar:
        task = bar.add_task(describe_progress(tally), total=1.0)
        known: list[int] = []

        def show(*workers: int) -> None:
            known[:] = workers or known
            bar.update(task, completed=tally.part, description=describe_progress(tally, *known))

        yield show


def describe_progress(tally: Tally, workers: int | None = None) -> str:
    """Return one line on ``tally``, the least important last: a narrow terminal truncates it."""
    now_s = monotonic()
    parts = [f"{tally.seen} of {tally.files} files", f"{len(tally.failed)} failed"]
    left_s = tally.left_s(now_s)
    if tally.processed and not isnan(left_s):
        parts.append(f"{duration(left_s)} left")
    if tally.processed:
        parts.append(f"{tally.files_per_minute(now_s):.1f} files/min")
        parts.append(f"{tally.km_per_hour(now_s):.1f} km/h")
    if tally.skipped:
        parts.append(f"{tally.skipped} done before")
    if workers is not None:
        parts.append("1 worker" if workers == 1 else f"{workers} workers")
    return ", ".join(parts)


def duration(seconds: float) -> str:
    """Return ``seconds`` as hours, minutes and seconds."""
    return str(timedelta(seconds=round(seconds)))


@contextmanager
def _call_regularly(act: Callable[[], None], every_s: float) -> Iterator[None]:
    """Call ``act`` every ``every_s`` s, also while no file is completed."""
    over = Event()

    def repeat() -> None:
        while not over.wait(every_s):
            act()

    other = Thread(target=repeat, daemon=True)
    other.start()
    try:
        yield
    finally:
        over.set()
        other.join(timeout=1.0)


FAILURES = 20
"""Largest number of listed files without a profile; all of them are in the summary."""

NAMES = 3
"""Largest number of names in a remark."""


def print_report(document: Mapping[str, Any], tally: Tally, out: Path) -> None:
    """Print counts, the roughest segments, failures with their reasons, and the written files."""
    _print_counts(document)
    _print_pipelines(document["pipelines"])
    if tally.roughest or tally.not_ranked:
        _print_roughest(tally)
    if tally.failed:
        _print_failures(document["failures"])
    click.echo(f"Written: {out / CSV}, {out / PARQUET}")


def tell_remarks(passed_over: Sequence[Path], no_longer_given: Sequence[str]) -> None:
    """Print warnings on files that are not recordings, and on profiles of earlier inputs."""
    if passed_over:
        names = count_names([path.name for path in passed_over])
        click.echo(f"Warning: skipped, not recordings of a known format: {names}", err=True)
    if no_longer_given:
        names = count_names(no_longer_given)
        click.echo(
            f"Warning: no longer given; the profiles remain but are not in the summary: {names}",
            err=True,
        )


def tell_warnings(tally: Tally) -> None:
    """Print the first warnings of files, and how many more there are."""
    for name, line in tally.first_warnings:
        click.echo(f"Warning: {one_line(name)}: {line}", err=True)
    more = tally.warnings - len(tally.first_warnings)
    if more:
        click.echo(f"Warning: {more} more warnings of files are in the summary", err=True)


def count_names(names: Sequence[str]) -> str:
    """Return the number of ``names``, and the first of them."""
    more = ", ..." if len(names) > NAMES else ""
    return f"{_files(len(names))} ({', '.join(map(one_line, names[:NAMES]))}{more})"


def _print_counts(document: Mapping[str, Any]) -> None:
    files, run = document["files"], document["this_run"]
    effort = document["effort"]
    wall_s = run["wall_s"]
    rows = [
        ["files", str(files["found"])],
        ["done", str(files["done"])],
        ["of these done before", str(files["skipped"])],
        ["failed", str(files["failed"])],
        ["warnings", str(document["warnings"])],
        ["length km", number(document["length_km"], 3)],
        ["time", duration(wall_s)],
        ["workers", str(run["workers"])],
        ["files/min", number(60.0 * run["processed"] / wall_s, 1)],
        ["km/h", number(3600.0 * run["length_km"] / wall_s, 1)],
        ["processor s", number(effort["cpu_s"], 1)],
        ["largest memory MB", number(effort["peak_bytes"] / 1e6, 0)],
    ]
    print_table("Batch", ("", "number"), rows)


def _print_pipelines(pipelines: Mapping[str, int]) -> None:
    if pipelines:
        made = ", ".join(f"{name} {_files(count)}" for name, count in pipelines.items())
        click.echo(f"Made by: {made}\n")


def _files(count: int) -> str:
    return "1 file" if count == 1 else f"{count} files"


def _print_roughest(tally: Tally) -> None:
    rows = [
        [
            one_line(name),
            marked(one_line(row.track), row.counted_share < 1.0),
            number(row.start_m, 1),
            number(row.length_m, 1),
            number(iri),
            percent(row.counted_share),
            number(row.iri_m_per_km),
        ]
        for iri, name, row in tally.roughest
    ]
    columns = ("file", "track", "start m", "length m", "IRI m/km", PERCENT_OF_VALID, "all points")
    if rows:
        print_table("Roughest, by the IRI of valid points", columns, rows)
    some = any(row.counted_share < 1.0 for _, _, row in tally.roughest)
    explain_mark(some, "the IRI of all points has the others too")
    if tally.not_ranked:
        click.echo(f"Not ranked, less than half of a segment is valid: {tally.not_ranked} rows\n")


def _print_failures(failures: Sequence[Mapping[str, str]]) -> None:
    rows = [[one_line(item["name"]), item["error"]] for item in failures[:FAILURES]]
    print_table("Failed", ("file", "why"), rows, numbers=False)
    if len(failures) > FAILURES:
        click.echo(f"and {len(failures) - FAILURES} more, in the summary")
