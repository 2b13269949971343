"""The matrix in the terminal."""

from rich.box import SIMPLE_HEAD
from rich.console import Console
from rich.table import Table
from rich.text import Text

from floatref.errors import one_line
from floatref_conformance.checks.verdict import Outcome
from floatref_conformance.matrix import matrix_wording as wording
from floatref_conformance.matrix.result_matrix import Cell, Matrix
from floatref_conformance.render.text import printable

COLOURS = {Outcome.PASS: "green", Outcome.FAIL: "red", Outcome.ERROR: "red"}
SMALLEST = "*"


def print_matrix(matrix: Matrix, console: Console) -> None:
    """Print the table of ``matrix``, its groups, its reports, and why cells have no share.

    The table is as wide as its columns need, also where the console is narrower.
    """
    table = _table(matrix)
    unlimited = console.options.update(width=10**6)
    table.width = console.measure(table, options=unlimited).maximum
    console.print(table, crop=False, soft_wrap=True)
    for line in _lines(matrix):
        console.print(_text(line), soft_wrap=True)


def _table(matrix: Matrix) -> Table:
    table = Table(box=SIMPLE_HEAD, pad_edge=False, collapse_padding=True)
    table.add_column("check", no_wrap=True)
    for report, label in zip(matrix.reports, matrix.labels, strict=True):
        head = f"{report.name}\n{label}: {report.document['verdict']}"
        table.add_column(Text("\n").join(map(_text, head.split("\n"))), no_wrap=True)
    for id_, cells in matrix.rows.items():
        table.add_row(_text(id_), *map(_show, cells))
    return table


def _show(cell: Cell) -> Text:
    if cell.outcome is None:
        return Text("")
    mark = f" {SMALLEST}" if cell.smallest else ""
    words = f"{wording.outcome_in_words(cell)} {wording.share_in_words(cell)}".strip()
    return Text(words + mark, COLOURS.get(cell.outcome, "yellow"))


def _lines(matrix: Matrix) -> list[str]:
    first = matrix.groups[0]
    lines = [f"{group.label}: {wording.describe_group(group, first)}" for group in matrix.groups]
    lines += [
        f"{report.name}: {report.device}, {wording.describe_report(report)}"
        for report in matrix.reports
    ]
    if any(cell.smallest for cells in matrix.rows.values() for cell in cells):
        lines.append(f"{SMALLEST} smallest share of its limit in its group")
    return lines + wording.reason_lines(matrix)


def _text(words: str) -> Text:
    """Return what a report holds on one line, without anything that moves the cursor."""
    return Text(one_line(printable(words)))
