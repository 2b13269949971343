"""The counts of the self-test in a terminal: a table by check, the totals, the faults."""

from collections.abc import Iterable

from rich.box import SIMPLE_HEAD
from rich.console import Console
from rich.table import Table
from rich.text import Text

from floatref_conformance.render.text import printable
from floatref_conformance.selftest.counts import Counts

COLUMNS = ("check", "mutants killed", "only killer of", "limits that hold", "false alarms")
NOT_ASKED = "-"


def show(counts: Counts, console: Console) -> None:
    """Print ``counts`` to ``console``."""
    table = Table(*COLUMNS, box=SIMPLE_HEAD)
    for id_ in counts.ids:
        table.add_row(id_, *_row(counts, id_))
    console.print(table)
    for line in (*_totals(counts), *counts.streams.lines):
        console.print(Text(line))
    for line in counts.complaints:
        console.print(Text(printable(f"  {line}"), style="red"))
    console.print(Text("holds" if not counts.complaints else "DOES NOT HOLD", style="bold"))


def _row(counts: Counts, id_: str) -> tuple[str, str, str, str]:
    alone = [spec.partition(":")[2] for spec in counts.only_killed_by(id_)]
    return (
        _share(bool(one.fails) for one in counts.kills if one.tried.check == id_),
        ", ".join(alone) if counts.others else NOT_ASKED,
        _share(not limit.faults for limit in counts.limits if limit.check == id_),
        _alarms(bool(one.fails) for one in counts.alarms if one.tried.check == id_),
    )


def _share(held: Iterable[bool]) -> str:
    """Return the number that hold, and the number of all."""
    all_of_them = list(held)
    return f"{sum(all_of_them)} of {len(all_of_them)}" if all_of_them else NOT_ASKED


def _alarms(raised: Iterable[bool]) -> str:
    all_of_them = list(raised)
    return f"{sum(all_of_them)} in {len(all_of_them)}" if all_of_them else NOT_ASKED


def _totals(counts: Counts) -> tuple[str, ...]:
    totals = counts.to_dict()
    seeds = {one.tried.seed for one in counts.kills}
    return (
        f"Mutants: {totals['mutants']}; {totals['kills']} of {totals['kills_asked']} times killed "
        f"by a check that they name, with {len(seeds)} seeds",
        f"Limits: {totals['limits']} of {totals['limits_asked']} fail an error of "
        f"{totals['limit_factors'][0]:g} times as much and pass one of "
        f"{totals['limit_factors'][1]:g} times",
        f"False alarms: {totals['false_alarms']} in {totals['alarms_asked']} times that a built-in "
        "device is asked for the class that it claims",
    )
