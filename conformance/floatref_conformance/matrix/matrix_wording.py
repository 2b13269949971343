"""Cells of the matrix in words, the same in the terminal and on the page."""

from floatref_conformance.checks.verdict import Outcome
from floatref_conformance.matrix.result_matrix import (
    Cell,
    Group,
    Matrix,
    count_judged,
    follow_outcomes,
)
from floatref_conformance.matrix.stored_reports import StoredReport
from floatref_conformance.render import wording

MOST_PERCENT = 10.0
"""Share of the limit from which it is shown as a multiple."""
SHOWN_REASON = 200
"""Longest reason that is shown in characters; the report has the whole."""


def outcome_in_words(cell: Cell) -> str:
    """Return the outcome; "not run" for a check that was left out."""
    if cell.outcome is None:
        return "not in it"
    if cell.outcome is Outcome.SKIP:
        return "not run"
    return cell.outcome.value.replace("-", " ")


def share_in_words(cell: Cell) -> str:
    """Return the share of the limit; empty without one."""
    if cell.share is None:
        return ""
    if abs(cell.share) < MOST_PERCENT:
        return f"{100 * cell.share:.0f} %"
    return f"{cell.share:.3g} times"


def describe_value(cell: Cell) -> str:
    """Return the value with its limit, and what it is a value of; empty without one."""
    if not cell.quantity:
        return ""
    value = "no number" if cell.value is None else wording.quantity(cell.value, cell.unit)
    limit = "no limit" if cell.limit is None else wording.quantity(cell.limit, cell.unit)
    case = f", case {cell.case}" if cell.case else ""
    return f"{cell.quantity}: {value}, limit {limit}, track {cell.track}{case}"


def describe_group(group: Group, first: Group) -> str:
    """Return the terms of a group, and why it is not compared with the first."""
    if not group.differs:
        return group.terms.in_words
    differs = " and ".join(group.differs)
    verb = "differs" if len(group.differs) == 1 else "differ"
    return f"{group.terms.in_words}; not compared with {first.label}: {differs} {verb}"


def describe_report(report: StoredReport) -> str:
    """Return how many checks of those that ran passed, and whether its verdict is another."""
    passed, judged = count_judged(report)
    stated, follows = report.document["verdict"], follow_outcomes(report)
    other = "" if stated == follows else f"; it states {stated}, its outcomes make it {follows}"
    return f"{passed} of {judged} checks that ran passed{other}"


def reason_lines(matrix: Matrix) -> list[str]:
    """Return one line for each report and reason of a cell without a share, naming the checks."""
    found: dict[tuple[str, str], list[str]] = {}
    for id_, cells in matrix.rows.items():
        for report, cell in zip(matrix.reports, cells, strict=True):
            if cell.share is None:
                key = report.name, f"{outcome_in_words(cell)} ({cut(cell.reason)})"
                found.setdefault(key, []).append(id_)
    return [f"{name}: {', '.join(ids)}: {reason}" for (name, reason), ids in found.items()]


def cut(text: str, longest: int = SHOWN_REASON) -> str:
    """Return ``text``, or the beginning of one that is too long to be shown."""
    return text if len(text) <= longest else f"{text[: longest - 1]}…"
