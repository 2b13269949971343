"""`conformance selftest`: the suite itself under test."""

import json

import click
from rich.console import Console
from rich.progress import Progress

from floatref_conformance.cli.edition_option import edition_option
from floatref_conformance.editions.edition import Edition, find_edition
from floatref_conformance.judge.search import check_installed
from floatref_conformance.judge.stream_judging import StreamPlan
from floatref_conformance.plugins import load_registry
from floatref_conformance.render.terminal import PLAIN_WIDTH, PipedConsole
from floatref_conformance.selftest.counts import Counts, find_killers
from floatref_conformance.selftest.counts_table import show
from floatref_conformance.selftest.work import Extent, Work

DOES_NOT_HOLD = 1


@click.command()
@click.option(
    "--seeds",
    type=click.IntRange(min=0),
    default=3,
    show_default=True,
    help="Number of seeds, from 0 on, with which every mutant must be killed; 0: no mutants.",
)
@click.option(
    "--false-alarms",
    type=click.IntRange(min=0),
    default=10,
    show_default=True,
    help="Number of seeds, from 0 on, with which no built-in device may fail the class it claims.",
)
@click.option(
    "--limits/--no-limits",
    default=True,
    show_default=True,
    help="Put errors of 1.5 and 0.67 times every limit into the truth.",
)
@click.option(
    "--unique/--no-unique",
    default=None,
    help="Try mutants that name one check on all others.  [default: unless --check is given]",
)
@click.option(
    "--check", "ids", metavar="ID", multiple=True, help="Test this check alone; may be repeated."
)
@click.option(
    "--processes",
    type=click.IntRange(min=1),
    default=2,
    show_default=True,
    help="Number of devices tried at a time.",
)
@edition_option
@click.option("--json", "as_json", is_flag=True, help="Print one JSON object.")
@click.pass_context
def selftest(
    context: click.Context,
    seeds: int,
    false_alarms: int,
    limits: bool,
    unique: bool | None,
    ids: tuple[str, ...],
    processes: int,
    edition: str,
    as_json: bool,
) -> None:
    """Test the suite: mutants killed, limits that hold on both sides, false alarms.

    Exit code 0: all of it holds; 1: it does not; 2: wrong usage; 3: the suite itself is at fault.
    """
    check_installed()
    wanted = Extent(seeds, false_alarms, limits, not ids if unique is None else unique, processes)
    counts = _count(ids, wanted, find_edition(edition))
    if as_json:
        click.echo(json.dumps(counts.to_dict(), indent=2))
    else:
        console = PipedConsole(emoji=False)
        if not console.is_terminal:
            console.width = max(console.width, PLAIN_WIDTH)
        show(counts, console)
    context.exit(DOES_NOT_HOLD if counts.complaints else 0)


def _count(ids: tuple[str, ...], extent: Extent, edition: Edition) -> Counts:
    """Return the counts; the progress is shown on standard error, if that is a terminal."""
    registry = load_registry(edition.name)
    checks, _ = registry.select(ids)
    with Progress(console=Console(stderr=True), transient=True) as progress:
        work = Work(
            checks,
            edition,
            find_killers(registry),
            extent,
            lambda items, count, title: progress.track(items, count, description=title),
            tuple(check.id for check in StreamPlan.of(ids).checks),
        )
        return work.count()
