"""The judge's table: one row per check, with the quantity that is worst relative to its limit."""

from collections.abc import Sequence
from dataclasses import replace

from rich.box import SIMPLE_HEAD
from rich.console import Console
from rich.table import Table
from rich.text import Text

from floatref_conformance.checks.verdict import CheckResult, Outcome, RunResult
from floatref_conformance.classes import DeviceClass
from floatref_conformance.render import wording
from floatref_conformance.render.text import printable

COLOURS = {Outcome.PASS: "green", Outcome.FAIL: "red", Outcome.ERROR: "red"}
NO_CLASS = "no class"


def check_tables(result: RunResult, console: Console) -> list[Table]:
    """Return the table of the checks of recordings, and that of streams if there is one.

    Where checks of streams alone were run, theirs is the only one.
    """
    of_streams = replace(result, checks=result.streams_shown, streams=())
    tables = [check_table(each, console) for each in (result, of_streams)]
    if not tables[1].row_count:
        return tables[:1]
    return [table for table in tables if table.row_count]


def check_table(result: RunResult, console: Console) -> Table:
    """Return the table of ``result``, which wraps at words in the width of ``console``.

    Checks that were not run have no row. In a console that is narrower than the longest words of
    all columns, the table is wider than the console, and no word is split.
    """
    shown = [c for c in result.checks if c.outcome is not Outcome.SKIP or c.cases]
    table = _empty_table([wording.outcome_in_words(check) for check in shown])
    for check in shown:
        table.add_row(*_cells(check, result.device_class))
    unlimited = console.options.update(width=10**6)
    least = console.measure(table, options=unlimited).minimum
    table.width = least if least > console.width else None
    return table


def _empty_table(outcomes: Sequence[str]) -> Table:
    """Return the table without rows: the column of the worst quantity alone gives way."""
    table = Table(box=SIMPLE_HEAD, pad_edge=False, collapse_padding=True)
    table.add_column("check", no_wrap=True)
    table.add_column("outcome", width=_longest_word(["outcome", *outcomes]))
    table.add_column("class reached", width=_longest_word(["reached", NO_CLASS, *DeviceClass]))
    table.add_column("cases", no_wrap=True, justify="right")
    table.add_column("worst against its limit")
    table.add_column("margin", no_wrap=True, justify="right")
    return table


def _longest_word(texts: Sequence[str]) -> int:
    return max(len(word) for text in texts for word in text.split())


def _cells(check: CheckResult, device_class: DeviceClass) -> list[Text]:
    outcome = Text(wording.outcome_in_words(check), COLOURS.get(check.outcome, "yellow"))
    reached = check.class_reached or NO_CLASS
    words = (
        reached,
        str(check.cases),
        describe_shown(check, device_class),
        _margin(check, device_class),
    )
    return [Text(printable(check.id)), outcome, *(Text(printable(text)) for text in words)]


def describe_shown(check: CheckResult, device_class: DeviceClass) -> str:
    """Return the quantity of the row with value, unit and limit; empty without a measurement.

    Where ``device_class`` limits no value of the check, the reason in its place.
    """
    shown, unlimited = check.shown, wording.why_unlimited(check, device_class)
    if shown is None or unlimited:
        return unlimited
    value = wording.quantity(shown.value, shown.unit)
    return f"{shown.quantity}: {value}, limit {wording.limit_in_words(shown, device_class)}"


def _margin(check: CheckResult, device_class: DeviceClass) -> str:
    """Return the share of the limit that is left, below 0 % where the value is beyond it."""
    left = None if check.shown is None else wording.margin(check.shown, device_class)
    return "" if left is None else f"{left:.0%}"
