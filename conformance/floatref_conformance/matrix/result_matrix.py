"""The matrix: groups of reports with the same terms, and a cell for each check and report."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields, replace
from itertools import count, product
from string import ascii_uppercase
from typing import Any

from floatref_conformance.checks.verdict import Outcome, verdict_on
from floatref_conformance.matrix.stored_reports import StoredReport, Terms

MEASURED = (Outcome.PASS, Outcome.FAIL, Outcome.WAIVED)
"""Outcomes whose share of the limit is compared within a group."""
UNJUDGED = (Outcome.SKIP, Outcome.NOT_APPLICABLE)


@dataclass(frozen=True)
class Group:
    """Reports that may be compared; ``differs`` names the terms in which it is not as the first."""

    label: str
    terms: Terms
    differs: tuple[str, ...]


@dataclass(frozen=True)
class Cell:
    """What a report has of a check.

    Attributes:
        outcome: None if the report has no such check.
        reason: why there is no value, or what the report states with its outcome.
        share: the worst quantity as a share of its limit; None without a number or a limit.
        value, limit, unit, quantity, track, case: of that quantity; None or empty without one.
        smallest: whether the share is the smallest of its group, of at least two.
    """

    outcome: Outcome | None
    reason: str
    share: float | None = None
    value: float | None = None
    limit: float | None = None
    unit: str = ""
    quantity: str = ""
    track: str = ""
    case: str = ""
    smallest: bool = False


@dataclass(frozen=True)
class Matrix:
    """Reports gathered by group, the label of the group of each, and cells by check id."""

    groups: tuple[Group, ...]
    reports: tuple[StoredReport, ...]
    labels: tuple[str, ...]
    rows: Mapping[str, tuple[Cell, ...]]


def make_matrix(reports: Sequence[StoredReport]) -> Matrix:
    """Return the matrix of ``reports``: groups, and reports in them, in the order given."""
    terms = list(dict.fromkeys(report.terms for report in reports))
    names = _labels()
    groups = tuple(Group(next(names), each, _differences(terms[0], each)) for each in terms)
    label = {group.terms: group.label for group in groups}
    ordered = tuple(sorted(reports, key=lambda report: terms.index(report.terms)))
    labels = tuple(label[report.terms] for report in ordered)
    found = [report.checks for report in ordered]
    ids = dict.fromkeys(id_ for checks in found for id_ in checks)
    rows = {
        id_: _mark([_cell(id_, *pair) for pair in zip(ordered, found, strict=True)], labels)
        for id_ in ids
    }
    return Matrix(groups, ordered, labels, rows)


def follow_outcomes(report: StoredReport) -> str:
    """Return the verdict that the outcomes of ``report`` make, whatever verdict it states."""
    checks = (*report.checks.values(), *report.document["replayed"])
    return verdict_on([Outcome(check["outcome"]) for check in checks]).value


def count_judged(report: StoredReport) -> tuple[int, int]:
    """Return how many checks of ``report`` passed, and how many judged the device."""
    outcomes = [Outcome(check["outcome"]) for check in report.checks.values()]
    judged = [outcome for outcome in outcomes if outcome not in UNJUDGED]
    return judged.count(Outcome.PASS), len(judged)


def _labels() -> Any:
    """Yield A to Z, then AA to ZZ, and so on."""
    for length in count(1):
        yield from map("".join, product(ascii_uppercase, repeat=length))


def _differences(first: Terms, other: Terms) -> tuple[str, ...]:
    names = (field.name for field in fields(Terms))
    changed = (name for name in names if getattr(first, name) != getattr(other, name))
    return tuple({"device_class": "class"}.get(name, name) for name in changed)


def _cell(id_: str, report: StoredReport, checks: Mapping[str, Mapping[str, Any]]) -> Cell:
    check = checks.get(id_)
    if check is None:
        return Cell(None, f"its report, of edition {report.terms.edition}, has no such check")
    outcome = Outcome(check["outcome"])
    reason = check["reason"] or ("not run" if outcome in UNJUDGED else "")
    # Reports of earlier versions have no `shown`.
    worst = check.get("shown", check["worst"])
    if worst is None or outcome in UNJUDGED:
        return Cell(outcome, reason)
    share = None if worst["margin"] is None else 1.0 - worst["margin"]
    named = {key: worst[key] for key in ("value", "limit", "unit", "quantity", "track", "case")}
    return Cell(outcome, reason or _why_no_share(worst), share, **named)


def _why_no_share(worst: Mapping[str, Any]) -> str:
    if worst["margin"] is not None:
        return ""
    return "its class does not limit it" if worst["limit"] is None else "the value is no number"


def _mark(cells: Sequence[Cell], labels: Sequence[str]) -> tuple[Cell, ...]:
    """Return ``cells`` with the smallest share of each group marked."""
    shares: dict[str, list[float]] = {}
    for cell, label in zip(cells, labels, strict=True):
        if cell.share is not None and cell.outcome in MEASURED:
            shares.setdefault(label, []).append(cell.share)
    least = {label: min(found) for label, found in shares.items() if len(found) > 1}
    return tuple(
        replace(cell, smallest=label in least and cell.share == least[label])
        if cell.share is not None and cell.outcome in MEASURED
        else cell
        for cell, label in zip(cells, labels, strict=True)
    )
