"""The terminal: a progress bar or plain lines while it runs, then a table and the verdict."""

import textwrap
from errno import EPIPE
from typing import Any

from rich.console import Console
from rich.progress import Progress

from floatref_conformance.checks.verdict import CheckResult, Outcome, RunResult, Verdict
from floatref_conformance.classes import DeviceClass
from floatref_conformance.judge.events import (
    CaseFinished,
    CaseReplayed,
    CheckFinished,
    CheckStarted,
    Event,
    RunFinished,
    RunStarted,
    SearchStarted,
    ShrinkStarted,
)
from floatref_conformance.render import wording
from floatref_conformance.render.check_table import check_tables
from floatref_conformance.render.text import printable

FAILURES = (*wording.FAILED, Outcome.WAIVED)
"""Outcomes whose reason is shown without `--verbose`, too."""
PLAIN_WIDTH = 100
"""Columns of the table when the width of the output is unknown."""


class PipedConsole(Console):
    """A console that reports a broken pipe instead of ending the process."""

    def on_broken_pipe(self) -> None:
        """Let the caller decide on the exit code."""
        self.quiet = True
        raise BrokenPipeError(EPIPE, "nobody reads the output")


class TerminalRenderer:
    """Writes to ``console`` as the run goes on, and the result at its end."""

    def __init__(self, console: Console | None = None, verbose: bool = False) -> None:
        """Write to ``console``, or else to standard output; ``verbose`` adds the details."""
        self.console = console or make_console()
        self.verbose = verbose
        self._progress: Progress | None = None
        self._task: Any = None

    def handle(self, event: Event) -> None:
        """Show ``event``."""
        match event:
            case RunStarted():
                self._start(event)
            case CaseFinished() if self._progress and self._task is not None:
                self._progress.advance(self._task)
            case CaseReplayed():
                self._print(wording.replayed_line(event.replayed))
            case CheckFinished():
                self._finish_check(event.result)
            case RunFinished():
                self._print_result(event.result)
            case CheckStarted() | SearchStarted() | ShrinkStarted():
                self._stage(event)

    def close(self) -> None:
        """Take the progress bar away, also after an error."""
        if self._progress:
            self._progress.stop()
            self._progress = None

    def _start(self, event: RunStarted) -> None:
        device = event.description
        sensors = wording.sensors(device.architecture, device.capabilities)
        self._print(f"device {event.spec}: {device.architecture}, {sensors}")
        if self.console.is_terminal:
            self._progress = Progress(
                console=self.console, transient=True, redirect_stdout=False, redirect_stderr=False
            )
            self._progress.start()

    def _stage(self, event: CheckStarted | SearchStarted | ShrinkStarted) -> None:
        """Report the largest number of cases that are judged from now on."""
        doing = {SearchStarted: ", searching", ShrinkStarted: ", simplifying"}.get(type(event), "")
        if not self._progress:
            self._print(f"{event.id}{doing}: {event.cases} cases")
        elif self._task is None:
            self._task = self._progress.add_task(event.id, total=event.cases)
        else:
            text = f"{event.id}{doing}"
            self._progress.update(self._task, description=text, completed=0, total=event.cases)

    def _finish_check(self, result: CheckResult) -> None:
        if self._progress and self._task is not None:
            self._progress.remove_task(self._task)
            self._task = None
        self._print(f"{result.id}: {_in_words(result)}")

    def _print_result(self, result: RunResult) -> None:
        self.close()
        for table in check_tables(result, self.console):
            self.console.print(table, crop=False)
        for line in result_lines(result, self.verbose, self.console.width):
            self._print(line)

    def _print(self, text: str) -> None:
        self.console.print(printable(text), markup=False, highlight=False, soft_wrap=True)


def make_console(stderr: bool = False) -> PipedConsole:
    """Return a console of standard output, or of standard error.

    It has `PLAIN_WIDTH` columns at least where it is no terminal. COLUMNS does not count there:
    programs that read lines set it for those that they start.
    """
    console = PipedConsole(emoji=False, stderr=stderr)
    if not console.is_terminal:
        console.width = max(console.width, PLAIN_WIDTH)
    return console


def result_lines(result: RunResult, verbose: bool = False, width: int = PLAIN_WIDTH) -> list[str]:
    """Return the lines about ``result`` below the table: the checks, the verdict, what to do.

    Those of a check without a failure or a warning are there if ``verbose``. The list of what was
    not run is wrapped in ``width`` columns.
    """
    lines: list[str] = []
    for check in (*result.checks, *result.streams_shown):
        if check.outcome is not Outcome.SKIP or check.cases:
            lines += _check_lines(check, result.device_class, verbose)
    lines += [wording.replayed_line(replayed) for replayed in result.replayed]
    lines += [_wrap(line, width) for line in wording.not_run_lines(result)]
    lines.append(wording.verdict_line(result))
    if result.verdict is Verdict.FAIL:
        lines += [_wrap(line, width) for line in wording.resemblance_lines(result)]
        lines += _what_to_do(result)
    return lines


def _wrap(line: str, width: int) -> str:
    """Return ``line``, wrapped at words; the lines behind the first are indented."""
    return textwrap.fill(
        line, width, subsequent_indent="  ", break_long_words=False, break_on_hyphens=False
    )


def _check_lines(check: CheckResult, device_class: DeviceClass, verbose: bool) -> list[str]:
    worst = wording.describe_worst(check, device_class) if verbose else ""
    parts = [part for part in (check.reason, worst) if part]
    lines = []
    if verbose or check.outcome in FAILURES:
        lines.append(f"{check.id}: {'; '.join(parts)} [{check.clause}]")
    if verbose and check.flagged_m:
        lines.append(f"{check.id}: {wording.describe_flagged(check)}")
    if check.early_m:
        lines.append(f"{check.id}: {wording.describe_early(check)}")
    if check.false_alarms:
        lines.append(f"{check.id}: {wording.describe_false_alarms(check)}")
    if verbose and check.counterexample is not None:
        lines.append(f"{check.id}: {wording.simplest(check.counterexample)}")
    return lines


def _what_to_do(result: RunResult) -> list[str]:
    """Return the commands that show the failures again, those of kept cases first."""
    lines = [
        f"Run {kept['file']} again with: {wording.replay_command(kept['file'], result)}"
        for kept in result.replayed
        if kept["outcome"] in wording.FAILED
    ]
    if any(c.outcome in wording.FAILED for c in (*result.checks, *result.streams)):
        lines.append(f"Reproduce with: {wording.reproduction(result)}")
    return lines


def _in_words(result: CheckResult) -> str:
    words = wording.outcome_in_words(result)
    return words + (f" ({result.reason})" if result.reason else "")
