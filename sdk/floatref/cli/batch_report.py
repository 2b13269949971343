"""What `floatref batch` prints at its end."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import click

from floatref.batch.summary import CSV, PARQUET
from floatref.batch.tally import Tally
from floatref.cli.batch_progress import duration
from floatref.cli.printing import number, print_table

FAILURES = 20
"""Files without a profile that are listed; all of them are in the summary."""

NAMES = 3
"""Names that a remark tells of those that there are."""


def print_report(document: Mapping[str, Any], tally: Tally, out: Path) -> None:
    """Print counts, the roughest segments, failures with their reasons, and what was written."""
    _print_counts(document)
    if tally.roughest:
        _print_roughest(tally)
    if tally.failed:
        _print_failures(document["failures"])
    click.echo(f"Written: {out / CSV}, {out / PARQUET}")


def tell_remarks(passed_over: Sequence[Path], no_longer_given: Sequence[str]) -> None:
    """Print a warning on files that are no recordings, and on profiles that stay from before."""
    if passed_over:
        names = counted([path.name for path in passed_over])
        click.echo(f"Warning: passed over, no recordings that we know: {names}", err=True)
    if no_longer_given:
        names = counted(no_longer_given)
        click.echo(f"Warning: no longer given, kept, not in the summary: {names}", err=True)


def counted(names: Sequence[str]) -> str:
    """Return how many ``names`` there are, and the first of them."""
    more = ", ..." if len(names) > NAMES else ""
    files = "1 file" if len(names) == 1 else f"{len(names)} files"
    return f"{files} ({', '.join(names[:NAMES])}{more})"


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


def _print_roughest(tally: Tally) -> None:
    rows = [
        [name, row.track, number(row.start_m, 1), number(row.length_m, 1), number(iri)]
        for iri, name, row in tally.roughest
    ]
    columns = ("file", "track", "start m", "length m", "IRI m/km")
    print_table("Roughest", columns, rows)


def _print_failures(failures: Sequence[Mapping[str, str]]) -> None:
    rows = [[item["name"], item["error"]] for item in failures[:FAILURES]]
    print_table("Failed", ("file", "why"), rows, numbers=False)
    if len(failures) > FAILURES:
        click.echo(f"and {len(failures) - FAILURES} more, in the summary")
