"""`conformance run`: judge a device."""

from contextlib import ExitStack
from pathlib import Path

import click

from floatref_conformance.case_files import read_cases
from floatref_conformance.classes import DeviceClass, Effort
from floatref_conformance.cli.edition_option import edition_option
from floatref_conformance.cli.following import follow
from floatref_conformance.cli.options import (
    class_of,
    env_option,
    limit_time,
    pass_variables,
    reports_into,
    tell_where_truth_is,
)
from floatref_conformance.editions.edition import find_edition
from floatref_conformance.judge.exercise import close_on_error
from floatref_conformance.judge.in_processes import refuse_processes
from floatref_conformance.judge.runner import Plan
from floatref_conformance.judge.search import check_installed
from floatref_conformance.judge.stream_judging import StreamPlan
from floatref_conformance.judge.waivers import check_used, read_waivers
from floatref_conformance.plugins import load_registry
from floatref_conformance.render.report import JsonOutput
from floatref_conformance.render.terminal import TerminalRenderer, make_console

RECOMMENDED = "builtin:road-prior-smoother"


@click.command()
@click.option(
    "--device",
    "spec",
    metavar="SPEC",
    default=RECOMMENDED,
    show_default=True,
    help="Device to judge; `conformance list` names them.",
)
@click.option(
    "--class",
    "device_class",
    type=click.Choice([c.value for c in DeviceClass]),
    help="Class whose limits decide.  [default: what a built-in claims, else nominal]",
)
@click.option(
    "--effort",
    type=click.Choice([e.value for e in Effort]),
    default=Effort.QUICK.value,
    show_default=True,
    help="How many cases each check draws.",
)
@click.option(
    "--check", "ids", metavar="ID", multiple=True, help="Run this check alone; may be repeated."
)
@click.option("--seed", type=click.IntRange(min=0), default=0, show_default=True)
@click.option(
    "--waive",
    metavar="FILE",
    type=click.Path(dir_okay=False, path_type=Path),
    help="Known failures: a check's id and why, one a line.",
)
@click.option(
    "--device-timeout",
    metavar="SECONDS",
    type=click.FloatRange(min=0, min_open=True),
    help="Time for one recording.  [default: 60 s and twice its length]",
)
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
    spec: str,
    device_class: str | None,
    effort: str,
    ids: tuple[str, ...],
    seed: int,
    waive: Path | None,
    device_timeout: float | None,
    variables: tuple[str, ...],
    report: Path | None,
    jobs: int,
    verbose: bool,
    as_json: bool,
    edition: str,
) -> None:
    """Judge a device.

    The table at the end has a row for each check: the quantity that is worst against its limit.

    Exit code 0: PASS; 1: FAIL; 2: wrong usage; 3: the suite itself is at fault, no verdict, or
    the report could not be written; 4: INCOMPLETE, since checks were left out, skipped or waived.
    """
    registry = load_registry(edition)
    for line in registry.broken:
        click.echo(f"Warning: {line}", err=True)
    checks, left_out = registry.select(ids)
    waivers = {} if waive is None else read_waivers(waive, registry.checks)
    kept = () if report is None else read_cases(report, edition)
    device = registry.device(spec)
    with ExitStack() as folders:
        with close_on_error(device):
            limit_time(device, device_timeout)
            pass_variables(device, variables)
            tell_where_truth_is(device)
            plan = Plan(
                spec,
                device,
                checks,
                left_out,
                class_of(device, device_class),
                seed,
                Effort(effort),
                kept,
                searching=getattr(device, "searchable", True),
                ahead=True,
                waivers=waivers,
                timeout_s=device_timeout,
                variables=variables,
                report=report,
                edition=find_edition(edition),
                streams=StreamPlan.of(ids),
            )
            if plan.searching:
                check_installed()
            refuse_processes(plan, jobs)
            writers = folders.enter_context(reports_into(report))
        if as_json:
            writers.append(JsonOutput(click.echo))
        terminal = TerminalRenderer(make_console(stderr=as_json), verbose)
        finished = follow(plan, terminal, writers, jobs)
    if waive is not None:
        check_used(waivers, finished, waive)
    context.exit(finished.verdict.exit_code)
