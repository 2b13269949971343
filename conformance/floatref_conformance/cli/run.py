"""`conformance run`: judge a device."""

import traceback
from pathlib import Path

import click

from floatref_conformance.classes import DeviceClass, Effort
from floatref_conformance.cli.no_verdict import FAULT_OF_THE_SUITE, INTERRUPTED, in_one_line
from floatref_conformance.errors import SuiteError
from floatref_conformance.events import Renderer, RunFinished
from floatref_conformance.plugins import load_registry
from floatref_conformance.render.report import JsonReport
from floatref_conformance.render.terminal import TerminalRenderer
from floatref_conformance.runner import Plan
from floatref_conformance.runner import run as run_plan


@click.command()
@click.option(
    "--device",
    "spec",
    metavar="SPEC",
    default="builtin:temporal-basic",
    show_default=True,
    help="Device to judge; `conformance list` names them.",
)
@click.option(
    "--class",
    "device_class",
    type=click.Choice([c.value for c in DeviceClass]),
    default=DeviceClass.NOMINAL.value,
    show_default=True,
    help="Class whose limits decide.",
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
    "--report",
    "report",
    type=click.Path(file_okay=False, path_type=Path),
    help="Directory for report.json.",
)
@click.pass_context
def run(
    context: click.Context,
    spec: str,
    device_class: str,
    effort: str,
    ids: tuple[str, ...],
    seed: int,
    report: Path | None,
) -> None:
    """Judge a device.

    Exit code 0: PASS; 1: FAIL; 2: wrong usage; 3: the suite itself is at fault, no verdict, or
    the report could not be written; 4: INCOMPLETE, since checks were left out.
    """
    registry = load_registry()
    for line in registry.broken:
        click.echo(f"Warning: {line}", err=True)
    device = registry.device(spec)
    checks, left_out = registry.select(ids)
    plan = Plan(spec, device, checks, left_out, DeviceClass(device_class), seed, Effort(effort))
    writers: list[Renderer] = [] if report is None else [JsonReport.into(report)]
    context.exit(_follow(plan, writers))


def _follow(plan: Plan, writers: list[Renderer]) -> int:
    """Run ``plan``, show it, and return the exit code."""
    terminal = TerminalRenderer()
    try:
        for event in run_plan(plan):
            terminal.handle(event)
            if isinstance(event, RunFinished):
                return _written(event, writers)
    except SuiteError as fault:
        terminal.close()
        return _report_fault(fault)
    except KeyboardInterrupt:
        terminal.close()
        click.echo("Interrupted: no verdict", err=True)
        return INTERRUPTED
    finally:
        terminal.close()
    raise SuiteError("the run ended without a verdict")


def _written(event: RunFinished, writers: list[Renderer]) -> int:
    """Write the reports of a verdict that is already shown, and return the exit code."""
    try:
        for writer in writers:
            writer.handle(event)
    except Exception as error:
        click.echo(f"Error: no report: {in_one_line(error)}", err=True)
        return FAULT_OF_THE_SUITE
    return event.result.verdict.exit_code


def _report_fault(fault: SuiteError) -> int:
    if fault.__cause__ is not None:
        click.echo("".join(traceback.format_exception(fault.__cause__)), err=True, nl=False)
    click.echo(f"Error: the suite itself is at fault, no verdict: {fault}", err=True)
    return FAULT_OF_THE_SUITE
