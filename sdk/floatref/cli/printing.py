"""Output of commands: one JSON object, or tables that are plain when piped."""

import json
import os
import sys
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from itertools import islice
from math import floor
from typing import Any, Literal

import click

from floatref.files.document import plain

PIPED_WIDTH = 240
"""Width of a table outside a terminal, in characters."""
PIECES = 1 << 14
"""Pieces of JSON that are printed together."""
PERCENT_OF_VALID = "valid %"
"""Heading of a column of `percent`."""
MARK = "*"
"""What follows the name of a wheel path of which not all points are valid."""


def print_json(report: Mapping[str, Any]) -> None:
    """Print ``report`` as one JSON object, NaN as null."""
    # A report of very many areas is not in memory as text, too.
    pieces = json.JSONEncoder(indent=2, allow_nan=False).iterencode(plain(report, "report"))
    while text := "".join(islice(pieces, PIECES)):
        click.echo(text, nl=False)
    click.echo()


def print_settings(settings: Mapping[str, Any]) -> None:
    """Print one line for each setting, a dash for None."""
    lines = [[name, _format_value(value)] for name, value in settings.items()]
    print_table("Settings", ("setting", "value"), lines, numbers=False)


def _format_value(value: object) -> str:
    if value is None:
        return "–"
    return str(float(f"{value:.10g}") if isinstance(value, float) else value)


def print_table(
    title: str,
    columns: Sequence[str],
    rows: Iterable[Sequence[str]],
    numbers: bool = True,
    whole: Collection[str] = (),
) -> None:
    """Print ``rows`` under ``title``; with ``numbers`` all columns but the first align right.

    Cells of the columns named in ``whole`` are not broken, however narrow the terminal is.
    """
    from rich import box
    from rich.console import Console
    from rich.table import Table
    from rich.text import Text

    terminal = sys.stdout.isatty()
    console = Console(file=sys.stdout, width=None if terminal else PIPED_WIDTH, emoji=False)
    style = box.SIMPLE_HEAD if terminal else None
    table = Table(box=style)
    for index, name in enumerate(columns):
        justify: Literal["right", "left"] = "right" if numbers and index else "left"
        table.add_column(Text(name), justify=justify, no_wrap=name in whole)
    for row in rows:
        table.add_row(*map(Text, row))
    with console.capture() as printed:
        console.print(Text(title, style="bold"))
        console.print(table)
    lines = [line.rstrip() for line in printed.get().splitlines()]
    click.echo("\n".join(line for line in lines if line) + "\n")


def number(value: float, digits: int = 3) -> str:
    """Return ``value`` with ``digits`` decimals, a dash for NaN."""
    return f"{value:.{digits}f}" if value == value else "–"


def percent(share: float) -> str:
    """Return a ``share``, 0 to 1, in per cent, rounded down so that 100.0 means all of it."""
    return number(floor(1000.0 * share) / 10.0, 1) if share == share else number(share)


def marked(name: str, is_marked: bool) -> str:
    """Return ``name``, with a mark if ``is_marked``: `explain_mark` says what it means."""
    return f"{name} {MARK}" if is_marked else name


def explain_mark(is_marked: bool, about: str) -> None:
    """Print, if anything is marked, what the mark says ``about`` the figures above."""
    if is_marked:
        click.echo(f"{MARK} not all points are valid: {about}\n")


def print_areas(title: str, columns: Sequence[str], rows: Sequence[Sequence[str]]) -> None:
    """Print ``rows`` as a table, or one line where there is no area."""
    if rows:
        print_table(title, columns, rows)
    else:
        click.echo(f"{title}: 0 areas\n")


def _may_be_terminal() -> bool:
    """Return whether rich, which takes a while to load, could draw a bar on standard error."""
    return sys.stderr.isatty() or not {"TTY_COMPATIBLE", "FORCE_COLOR"}.isdisjoint(os.environ)


@contextmanager
def progress_bar(
    label: str, quiet: bool, before: str | None = None
) -> Iterator[Callable[[float], None] | None]:
    """Yield a function that shows the part done, from 0 to 1; None without a terminal.

    ``before`` is shown until its first call.
    """
    if quiet or not _may_be_terminal():
        yield None
        return
    from rich.console import Console
    from rich.progress import Progress

    console = Console(stderr=True)
    if not console.is_terminal:
        yield None
        return
    with Progress(console=console, transient=True) as bar:
        task = bar.add_task(before or label, total=1.0)

        def show(done: float) -> None:
            bar.update(task, completed=done, description=label)

        yield show
