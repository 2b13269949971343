"""Following a run: the terminal sees it all, the reports are written at its end."""

import traceback
from collections.abc import Callable, Sequence
from typing import NoReturn

import click

from floatref.cli.program.interrupts import INTERRUPTED
from floatref_conformance.checks.verdict import RunResult
from floatref_conformance.cli.no_verdict import FAULT_OF_THE_SUITE, drop_output, in_one_line
from floatref_conformance.errors import SuiteError
from floatref_conformance.judge.events import Event, Renderer, RunFinished
from floatref_conformance.judge.in_processes import run_in_processes
from floatref_conformance.judge.runner import Plan
from floatref_conformance.render.terminal import TerminalRenderer
from floatref_conformance.resemblance.naming import was_interrupted


def follow(
    plan: Plan,
    terminal: TerminalRenderer,
    writers: Sequence[Renderer],
    processes: int = 1,
    complete: Callable[[RunResult], RunResult] = lambda result: result,
) -> RunResult:
    """Run ``plan``, show it on ``terminal``, have it written by ``writers``, return the result.

    ``complete`` adds to the result before anybody sees it. Without a verdict, or without a report
    of it, the command ends here with its exit code. The run goes on when nobody reads what it
    shows.
    """
    finished: list[RunFinished] = []

    def emit(event: Event) -> None:
        if isinstance(event, RunFinished):
            event = RunFinished(complete(event.result))
        try:
            terminal.handle(event)
        except BrokenPipeError:
            # Whoever read the terminal has gone; reports and exit code are still wanted.
            drop_output()
        if isinstance(event, RunFinished):
            finished.append(event)
        else:
            _tell(event, writers)

    try:
        run_in_processes(plan, emit, processes)
    except SuiteError as fault:
        terminal.close()
        _end_at_fault(fault)
    finally:
        terminal.close()
    for event in finished:
        _tell(event, writers)
    return finished[-1].result


def end_with(context: click.Context, result: RunResult) -> NoReturn:
    """End the command with the exit code of ``result``, or that of Ctrl-C during the probes.

    Its reports, or its archive, are written then.
    """
    if was_interrupted(result):
        click.echo("Interrupted: the verdict is kept, without the flaw that it resembles", err=True)
        context.exit(INTERRUPTED)
    context.exit(result.verdict.exit_code)


def _tell(event: Event, writers: Sequence[Renderer]) -> None:
    """Hand ``event`` to the writers; the last one, with the verdict, when that is shown."""
    try:
        for writer in writers:
            writer.handle(event)
    except Exception as error:
        if isinstance(error, BrokenPipeError):
            drop_output()
        click.echo(f"Error: no report: {in_one_line(error)}", err=True)
        raise click.exceptions.Exit(FAULT_OF_THE_SUITE) from error


def _end_at_fault(fault: SuiteError) -> NoReturn:
    if fault.__cause__ is not None:
        click.echo("".join(traceback.format_exception(fault.__cause__)), err=True, nl=False)
    click.echo(f"Error: the suite itself is at fault, no verdict: {fault}", err=True)
    raise click.exceptions.Exit(FAULT_OF_THE_SUITE)
