"""What `report.html` shows, put into words and in order before the template lays it out."""

import platform
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from importlib.metadata import version
from math import isfinite
from typing import Any

from floatref.errors import InputError
from floatref_conformance.checks.interface import Check
from floatref_conformance.checks.verdict import CheckResult, Measurement, Outcome, RunResult
from floatref_conformance.classes import DeviceClass, Effort
from floatref_conformance.judge.judging import find_scored
from floatref_conformance.render import wording
from floatref_conformance.render.drawing import drawing_svg
from floatref_conformance.render.failures import Failure, Markup, failure


@dataclass(frozen=True)
class Asked:
    """One check; ``limits`` has a row for each quantity, with a limit for each class."""

    anchor: str
    id: str
    title: str
    clause: str
    derivation: str
    floor: str
    limits: tuple[tuple[str, tuple[str, ...]], ...]
    drawing: Markup | None


def explain_check(check: Check, anchor: str) -> Asked:
    """Return the explanation of ``check``, with the drawing of its first case."""
    return Asked(
        anchor=anchor,
        id=check.id,
        title=check.title,
        clause=check.clause,
        derivation=check.derivation,
        floor=check.floor,
        limits=tuple(
            (quantity, tuple(str(limits.get(c, "no limit")) for c in DeviceClass))
            for quantity, limits in check.limits.items()
        ),
        drawing=_draw(check, anchor),
    )


def _draw(check: Check, anchor: str) -> Markup | None:
    """Return the drawing; None for a check without cases, or whose first makes no drive."""
    cases = check.cases(0, Effort.QUICK)
    if not cases:
        return None
    scored_m = find_scored(check, cases[0])
    try:
        return Markup(drawing_svg(cases[0].scenario, f"{anchor}-drawing", scored_m))
    except InputError:
        return None


FULL_SCALE = 1.5
"""Share of the limit at the end of a bar."""
NEAR = 0.85
"""Above this share of the limit a bar warns."""
SHOWN = (*wording.FAILED, Outcome.WAIVED)
"""Outcomes that are shown in full."""


@dataclass(frozen=True)
class Row:
    """One check in the table; ``bar`` is the width of its bar in percent, None without one."""

    id: str
    target: str
    outcome: str
    word: str
    judged: bool
    reason: str
    class_reached: str
    cases: int
    value: str = ""
    notes: tuple[str, ...] = ()
    limit: str = ""
    percent: str = ""
    margin: str = ""
    bar: float | None = None
    colour: str = ""


@dataclass(frozen=True)
class KeptRow:
    """One case kept from an earlier run."""

    file: str
    check: str
    outcome: str
    value: str
    limit: str
    reason: str


@dataclass(frozen=True)
class Page:
    """All that the template needs."""

    verdict: str
    device: str
    device_class: str
    edition: str
    summary: str
    facts: tuple[tuple[str, str], ...]
    rows: tuple[Row, ...]
    failures: tuple[Failure, ...]
    replayed: tuple[KeptRow, ...]
    asked: tuple[Asked, ...]
    classes: tuple[str, ...]
    versions: str


def page_of(result: RunResult, checks: Sequence[Check]) -> Page:
    """Return the page of ``result``; ``checks`` are those that are explained in it."""
    explained = {
        check.id: explain_check(check, f"asked-{n}") for n, check in enumerate(checks, start=1)
    }
    titles = {id_: one.title for id_, one in explained.items()}
    ordered = sorted(
        (*result.checks, *result.streams_shown),
        key=lambda check: _urgency(check, result.device_class),
    )
    shown = [check for check in ordered if check.outcome in SHOWN]
    anchors = {check.id: f"failure-{n}" for n, check in enumerate(shown, start=1)}
    targets = {id_: one.anchor for id_, one in explained.items()} | anchors
    return Page(
        verdict=result.verdict.value,
        device=str(result.device["spec"]),
        device_class=result.device_class.value,
        edition=result.edition,
        summary=wording.summary(result),
        facts=_facts(result),
        rows=tuple(_row(c, result.device_class, targets.get(c.id, "checks")) for c in ordered),
        failures=tuple(failure(c, result, anchors[c.id], titles.get(c.id, "")) for c in shown),
        replayed=tuple(_replay_row(replayed) for replayed in result.replayed),
        asked=tuple(explained.values()),
        classes=tuple(DeviceClass),
        versions=_versions(result.edition),
    )


def _urgency(check: CheckResult, device_class: DeviceClass) -> tuple[int, float]:
    """Return what sorts the checks: judged ones by margin, faults first, those not run last."""
    if check.outcome in wording.UNJUDGED:
        return 2 if check.outcome is Outcome.SKIP else 1, 0.0
    if check.outcome is Outcome.ERROR or check.shown is None:
        return -1, 0.0
    return 0, -check.shown.ratio(device_class)


def _facts(result: RunResult) -> tuple[tuple[str, str], ...]:
    device = result.device
    alike = [("Resembles", line) for line in wording.resemblance_lines(result)]
    return (
        ("Class judged", result.device_class.value),
        ("Class reached", result.class_reached or "no class"),
        ("Edition", result.edition),
        ("Effort", result.effort),
        ("Seed", str(result.seed)),
        ("Device", f"{device['name']} {device['version']}"),
        ("Architecture", str(device["architecture"])),
        ("Capabilities", wording.sensors(device["architecture"], device["capabilities"])),
        *alike,
    )


def _row(check: CheckResult, device_class: DeviceClass, target: str) -> Row:
    row = Row(
        id=check.id,
        target=target,
        outcome=check.outcome.value,
        word=wording.outcome_in_words(check),
        judged=check.outcome not in wording.UNJUDGED,
        reason=check.reason or "not run",
        class_reached=check.class_reached or "no class",
        cases=check.cases,
    )
    worst = check.shown
    if worst is None:
        return replace(row, notes=_alarms(check))
    unlimited = wording.why_unlimited(check, device_class)
    if unlimited:
        flagged = (wording.describe_flagged(check),) if check.flagged_m else ()
        return replace(row, value="no limit", notes=(unlimited, *flagged, *_alarms(check)))
    ratio = worst.ratio(device_class)
    return replace(
        row,
        value=wording.quantity(worst.value, worst.unit),
        notes=_notes(check, worst),
        limit=wording.limit_in_words(worst, device_class),
        percent=_percent(ratio),
        margin=_margin(wording.margin(worst, device_class)),
        bar=round(100 * min(ratio / FULL_SCALE, 1.0), 1),
        colour="over" if ratio > 1 else "near" if ratio > NEAR else "good",
    )


def _notes(check: CheckResult, worst: Measurement) -> tuple[str, ...]:
    """Return what the worst value is a value of, in which case, and what was flagged."""
    case = f"case {check.shown_case}" if check.shown_case else ""
    flagged = wording.describe_flagged(check) if check.flagged_m else ""
    early = wording.describe_early(check) if check.early_m else ""
    notes = (f"{worst.quantity}, track {worst.track}", case, flagged, early, *_alarms(check))
    return tuple(note for note in notes if note)


def _alarms(check: CheckResult) -> tuple[str, ...]:
    return (wording.describe_false_alarms(check),) if check.false_alarms else ()


def _percent(ratio: float) -> str:
    if not isfinite(ratio):
        return "no number"
    return f"{100 * ratio:.0f} %" if ratio < FULL_SCALE * 10 else f"{ratio:.3g} times"


def _margin(left: float | None) -> str:
    """Return how far it is to the limit, or beyond."""
    if left is None:
        return ""
    return f"{100 * left:.0f} % left" if left >= 0 else f"{-100 * left:,.0f} % beyond"


def _replay_row(replayed: Mapping[str, Any]) -> KeptRow:
    unit = replayed.get("unit") or ""
    value, limit = (
        "" if number is None else wording.quantity(number, unit)
        for number in (replayed.get("value"), replayed.get("limit"))
    )
    reason = str(replayed.get("reason") or "")
    return KeptRow(replayed["file"], replayed["check"], replayed["outcome"], value, limit, reason)


def _versions(edition: str) -> str:
    return (
        f"floatref {version('floatref')}, edition {edition}, "
        f"Python {platform.python_version()}, NumPy {version('numpy')}"
    )
