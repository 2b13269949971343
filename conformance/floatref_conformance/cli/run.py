"""`conformance run`: judge a device."""

from contextlib import ExitStack
from pathlib import Path
from typing import Any

import click

from floatref_conformance.case_files import read_cases
from floatref_conformance.cli.edition_option import edition_option
from floatref_conformance.cli.following import end_with, follow
from floatref_conformance.cli.judging_options import (
    RECOMMENDED,
    Asked,
    completing,
    judging_options,
    make_plan,
)
from floatref_conformance.cli.options import env_option, reports_into
from floatref_conformance.judge.exercise import close_on_error
from floatref_conformance.judge.in_processes import refuse_processes
from floatref_conformance.judge.waivers import check_used
from floatref_conformance.plugins import load_registry
from floatref_conformance.render.report import JsonOutput
from floatref_conformance.render.terminal import TerminalRenderer, make_console

__all__ = ["RECOMMENDED", "run"]


@click.command()
@judging_options
@click.option(
    "--report",
    type=click.Path(file_okay=False, path_type=Path),
    help="Directory for report.json, report.html, junit.xml, and the cases that fail; those in "
    "it are run again.",
)
@click.option(
    "--jobs",
    type=click.IntRange(min=1),
    default=1,
    show_default=True,
    help="Checks that run at a time, each in a process; for builtin: and files: only.",
)
@click.option("--verbose", is_flag=True, help="Show the details of every check below the table.")
@click.option(
    "--json",
    "as_json",
    is_flag=True,
    help="Print one JSON object, that of report.json; all else goes to stderr.",
)
@edition_option
@env_option
@click.pass_context
def run(
    context: click.Context,
    /,
    report: Path | None,
    jobs: int,
    verbose: bool,
    as_json: bool,
    **options: Any,
) -> None:
    """Judge a device.

    The table at the end has a row for each check: the quantity that is worst against its limit.

    Exit code 0: PASS; 1: FAIL; 2: wrong usage; 3: the suite itself is at fault, no verdict, or
    the report could not be written; 4: INCOMPLETE, since checks were left out, skipped or waived.
    """
    asked = Asked(**options)
    registry = load_registry(asked.edition)
    for line in registry.broken:
        click.echo(f"Warning: {line}", err=True)
    kept = () if report is None else read_cases(report, asked.edition)
    device = registry.device(asked.spec)
    with ExitStack() as folders:
        with close_on_error(device):
            plan = make_plan(asked, registry, device, kept, report)
            refuse_processes(plan, jobs)
            writers = folders.enter_context(reports_into(report))
        if as_json:
            writers.append(JsonOutput(click.echo))
        terminal = TerminalRenderer(make_console(stderr=as_json), verbose)
        finished = follow(plan, terminal, writers, jobs, completing(asked, device))
    if asked.waive is not None:
        check_used(plan.waivers, finished, asked.waive)
    end_with(context, finished)
