"""The terminal: a progress bar or plain lines while it runs, then a table and the verdict."""

import shlex
from errno import EPIPE
from math import isfinite
from typing import Any

from rich.box import SIMPLE_HEAD
from rich.console import Console
from rich.progress import Progress
from rich.table import Table
from rich.text import Text

from floatref_conformance.classes import Effort
from floatref_conformance.events import (
    CaseFinished,
    CheckFinished,
    CheckStarted,
    Event,
    RunFinished,
    RunStarted,
)
from floatref_conformance.verdict import CheckResult, Outcome, RunResult, Verdict

COLOURS = {Outcome.PASS: "green", Outcome.FAIL: "red", Outcome.ERROR: "red"}
COLUMNS = ("check", "outcome", "class reached", "cases", "worst", "limit", "margin")
PLAIN_WIDTH = 100
"""Columns of the table when nobody says how wide the output is."""


class PipedConsole(Console):
    """A console that tells when nobody reads it any more, instead of ending the process."""

    def on_broken_pipe(self) -> None:
        """Let the caller decide on the exit code."""
        self.quiet = True
        raise BrokenPipeError(EPIPE, "nobody reads the output")


class TerminalRenderer:
    """Writes to ``console`` as the run goes on, and the result at its end."""

    def __init__(self, console: Console | None = None) -> None:
        """Write to ``console``, or else to standard output."""
        self.console = console or PipedConsole(emoji=False)
        if not self.console.is_terminal:
            self.console.width = max(self.console.width, PLAIN_WIDTH)
        self._progress: Progress | None = None
        self._task: Any = None

    def handle(self, event: Event) -> None:
        """Show ``event``."""
        match event:
            case RunStarted():
                self._start(event)
            case CheckStarted():
                self._check(event)
            case CaseFinished() if self._progress:
                self._progress.advance(self._task)
            case CheckFinished():
                self._finish_check(event.result)
            case RunFinished():
                self._print_result(event.result)

    def close(self) -> None:
        """Take the progress bar away, also after an error."""
        if self._progress:
            self._progress.stop()
            self._progress = None

    def _start(self, event: RunStarted) -> None:
        said = event.description
        capabilities = ", ".join(said.capabilities) or "nominal sensors alone"
        self._print(f"device {event.spec}: {said.architecture}, {capabilities}")
        if self.console.is_terminal:
            self._progress = Progress(
                console=self.console, transient=True, redirect_stdout=False, redirect_stderr=False
            )
            self._progress.start()

    def _check(self, event: CheckStarted) -> None:
        if self._progress:
            self._task = self._progress.add_task(event.id, total=event.cases)
        else:
            self._print(f"{event.id}: {event.cases} cases")

    def _finish_check(self, result: CheckResult) -> None:
        if not self._progress:
            self._print(f"{result.id}: {_in_words(result)}")

    def _print_result(self, result: RunResult) -> None:
        self.close()
        self.console.print(_table(result))
        for check in result.checks:
            if check.outcome is not Outcome.SKIP:
                self._print(f"{check.id}: {check.reason or measured(check)} [{check.clause}]")
            if check.flagged_m:
                self._print(f"{check.id}: {flagged(check)}")
        for line in not_run_lines(result):
            self._print(line)
        self._print(verdict_line(result))
        if result.verdict is Verdict.FAIL:
            self._print(f"Reproduce with: {reproduction(result)}")

    def _print(self, text: str) -> None:
        self.console.print(text, markup=False, highlight=False, soft_wrap=True)


def not_run_lines(result: RunResult) -> list[str]:
    """Return one line per reason for which checks were left out, naming them."""
    reasons: dict[str, list[str]] = {}
    for check in result.checks:
        if check.outcome is Outcome.SKIP:
            reasons.setdefault(check.reason, []).append(check.id)
    return [f"Not run ({reason}): {', '.join(ids)}" for reason, ids in reasons.items()]


def verdict_line(result: RunResult) -> str:
    """Return the verdict in one line; what was not run is never called passed."""
    judged = [c for c in result.checks if c.outcome not in (Outcome.SKIP, Outcome.NOT_APPLICABLE)]
    passed = sum(c.outcome is Outcome.PASS for c in judged)
    text = f"{result.verdict}: {passed} of {len(judged)} checks that ran passed"
    left_out = sum(c.outcome is Outcome.SKIP for c in result.checks)
    if left_out:
        text += f"; {left_out} were not run, and nothing is said of them"
    return f"{text} (class {result.device_class}, seed {result.seed}, effort {result.effort})"


def reproduction(result: RunResult) -> str:
    """Return the command that runs the failed checks again."""
    words = ["conformance", "run", "--device", str(result.device["spec"])]
    words += ["--class", result.device_class.value, "--seed", str(result.seed)]
    if result.effort != Effort.QUICK:
        words += ["--effort", result.effort]
    for check in result.checks:
        if check.outcome in (Outcome.FAIL, Outcome.ERROR):
            words += ["--check", check.id]
    return shlex.join(words)


def measured(check: CheckResult) -> str:
    """Return what the worst value of a check is a value of."""
    worst = check.worst
    return "" if worst is None else f"worst is the {worst.quantity} of track {worst.track}"


def flagged(check: CheckResult) -> str:
    """Return how much of a profile was flagged invalid, and that it counted all the same."""
    return f"up to {check.flagged_m:.1f} m of a wheel path flagged invalid; every point counted"


def _in_words(result: CheckResult) -> str:
    return f"{result.outcome}" + (f" ({result.reason})" if result.reason else "")


def _table(result: RunResult) -> Table:
    table = Table(*COLUMNS, box=SIMPLE_HEAD, pad_edge=False)
    for check in result.checks:
        if check.outcome is not Outcome.SKIP:
            cells = [check.class_reached or "none", str(check.cases), *_numbers(check, result)]
            outcome = Text(check.outcome, COLOURS.get(check.outcome, "yellow"))
            table.add_row(Text(check.id), outcome, *map(Text, cells))
    return table


def _numbers(check: CheckResult, result: RunResult) -> tuple[str, str, str]:
    worst = check.worst
    if worst is None:
        return "", "", ""
    limit = worst.limits[result.device_class]
    ratio = worst.ratio(result.device_class)
    margin = f"{1.0 - ratio:.0%}" if isfinite(ratio) else "none"
    return f"{worst.value:.3g} {worst.unit}", f"{limit:.3g} {worst.unit}", margin
