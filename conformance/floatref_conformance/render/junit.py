"""`junit.xml`: the result for build servers, one test case for each check and kept case."""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from datetime import UTC, datetime
from pathlib import Path
from time import monotonic
from typing import Any
from xml.etree import ElementTree
from xml.etree.ElementTree import Element, SubElement

from floatref.files.atomic import replace_file
from floatref_conformance.checks.verdict import CheckResult, Measurement, Outcome, RunResult
from floatref_conformance.classes import DeviceClass
from floatref_conformance.judge.events import (
    CheckFinished,
    CheckStarted,
    Event,
    RunFinished,
    RunStarted,
)
from floatref_conformance.render import wording
from floatref_conformance.render.text import printable

NAME = "junit.xml"
PACKAGE = "floatref_conformance"
ELEMENTS: Mapping[Outcome, str] = {
    Outcome.FAIL: "failure",
    Outcome.ERROR: "error",
    Outcome.SKIP: "skipped",
    Outcome.WAIVED: "skipped",
    Outcome.NOT_APPLICABLE: "skipped",
}
"""Elements that mark a test case as not passed; a case without one counts as passed."""


@dataclass
class JUnitReport:
    """Writes ``junit.xml`` into ``folder`` when the verdict is there.

    The times are those between the events it is given; it needs the last event alone.
    """

    folder: Path
    clock: Callable[[], float] = monotonic
    now: Callable[[], datetime] = lambda: datetime.now(UTC)
    _started: dict[str, float] = field(default_factory=dict)
    _seconds: dict[str, float] = field(default_factory=dict)
    _begun: datetime | None = None

    @classmethod
    def into(cls, folder: Path) -> "JUnitReport":
        """Return a writer into ``folder``, made if need be; OSError if it cannot be.

        The report of an earlier run goes away now, so that it is never taken for this one's.
        """
        folder.mkdir(parents=True, exist_ok=True)
        (folder / NAME).unlink(missing_ok=True)
        return cls(folder)

    def handle(self, event: Event) -> None:
        """Take the time of ``event``; write the report once the run has finished."""
        match event:
            case RunStarted():
                self._begun = self.now()
            case CheckStarted():
                self._started[event.id] = self.clock()
            case CheckFinished() if event.result.id in self._started:
                id_ = event.result.id
                self._seconds[id_] = self.clock() - self._started[id_]
            case RunFinished():
                self._write(event.result)

    def _write(self, result: RunResult) -> None:
        root = as_xml(result, self._seconds, self._begun or self.now())
        ElementTree.indent(root)
        tree = ElementTree.ElementTree(root)
        with replace_file(self.folder / NAME, overwrite=True, follow=False) as beside:
            tree.write(beside, encoding="utf-8", xml_declaration=True)


def as_xml(result: RunResult, seconds: Mapping[str, float], begun: datetime) -> Element:
    """Return ``result`` as a JUnit document; ``seconds`` are those that each check took.

    What did not pass, or was not run, is a failure, an error or skipped, with its reason.
    """
    root = Element("testsuites")
    checks = [_check(check, result, seconds.get(check.id, 0.0)) for check in result.checks]
    about = _suite(root, 0, f"floatref conformance {result.edition}", checks, begun)
    for name, value in _properties(result):
        SubElement(about, "property", name=name, value=printable(value))
    kept = [_replay_suite(replayed, result) for replayed in result.replayed]
    _suite(root, 1, "replayed cases", kept, begun)
    if result.streams_shown:
        streams = [_check(c, result, seconds.get(c.id, 0.0)) for c in result.streams_shown]
        _suite(root, 2, "stream checks", streams, begun)
    root[0][-2].text = printable(_output(result))
    return root


def _suite(root: Element, number: int, name: str, cases: list[Element], begun: datetime) -> Element:
    """Append a suite of ``cases`` to ``root``; return the element of its properties."""
    suite = SubElement(
        root,
        "testsuite",
        name=name,
        package=PACKAGE,
        id=str(number),
        timestamp=begun.strftime("%Y-%m-%dT%H:%M:%S"),
        hostname="localhost",
        tests=str(len(cases)),
        failures=str(_count(cases, "failure")),
        errors=str(_count(cases, "error")),
        skipped=str(_count(cases, "skipped")),
        time=f"{sum(float(case.get('time', 0)) for case in cases):.3f}",
    )
    properties = SubElement(suite, "properties")
    suite.extend(cases)
    SubElement(suite, "system-out").text = ""
    SubElement(suite, "system-err").text = ""
    return properties


def _count(cases: Iterable[Element], tag: str) -> int:
    return sum(case.find(tag) is not None for case in cases)


def _case(
    id_: str, seconds: float, outcome: Outcome, reason: str, text: str, edition: str
) -> Element:
    case = Element(
        "testcase",
        name=printable(id_),
        classname=f"{PACKAGE}.{edition.replace('.', '_')}",
        time=f"{seconds:.3f}",
    )
    if outcome is not Outcome.PASS:
        message = printable(reason) or outcome.value
        found = SubElement(case, ELEMENTS[outcome], message=message, type=outcome.value)
        found.text = printable(text)
    return case


def _check(check: CheckResult, result: RunResult, seconds: float) -> Element:
    lines = [check.reason]
    if check.shown is not None:
        lines.append(wording.describe_worst(check, result.device_class))
    if check.clause:
        lines.append(f"clause: {check.clause}")
    if check.counterexample is not None:
        lines.append(wording.simplest(check.counterexample))
        if "file" in check.counterexample:
            command = wording.replay_command(check.counterexample["file"], result)
            lines.append(f"{wording.WHERE}: {command}")
    if check.outcome not in wording.UNJUDGED:
        lines.append(f"again: {wording.reproduction(result, check.id)}")
    return _case(check.id, seconds, check.outcome, check.reason, "\n".join(lines), result.edition)


def _replay_suite(replayed: Mapping[str, Any], result: RunResult) -> Element:
    reason = str(replayed.get("reason") or "")
    command = wording.replay_command(replayed["file"], result)
    text = f"{reason}\n{wording.WHERE}: {command}"
    return _case(replayed["file"], 0.0, Outcome(replayed["outcome"]), reason, text, result.edition)


def _properties(result: RunResult) -> list[tuple[str, str]]:
    reached = result.class_reached
    about = {
        **{f"device.{key}": value for key, value in result.device.items()},
        "class": result.device_class,
        "class_reached": "none" if reached is None else reached,
        "seed": result.seed,
        "effort": result.effort,
        "edition": result.edition,
        "verdict": result.verdict,
    }
    return [
        (name, ", ".join(value) if isinstance(value, (list, tuple)) else str(value))
        for name, value in about.items()
    ]


def _output(result: RunResult) -> str:
    lines = [wording.verdict_line(result), *wording.not_run_lines(result)]
    for check in (*result.checks, *result.streams_shown):
        if check.shown is not None:
            reached = check.class_reached or "no class"
            lines.append(
                f"{check.id}: {check.outcome}, class reached {reached}, {check.cases} cases, "
                f"{_worst(check, check.shown, result.device_class)}"
            )
    return "\n".join(lines)


def _worst(check: CheckResult, worst: Measurement, device_class: DeviceClass) -> str:
    """Return what the worst value is, and its share of the limit if it has one."""
    words = wording.describe_worst(check, device_class)
    if wording.why_unlimited(check, device_class):
        return words
    return f"{words}: {wording.share_in_words(worst, device_class)}"
