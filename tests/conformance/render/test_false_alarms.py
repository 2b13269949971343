"""Healthy recordings that a device refused: on the terminal, on the page and in `report.json`."""

import json
from io import StringIO

from rich.console import Console
from tests.conformance.page_reader import Page

from floatref_conformance.checks.verdict import Outcome
from floatref_conformance.judge.events import RunFinished
from floatref_conformance.render.html import as_html
from floatref_conformance.render.report import JsonReport
from floatref_conformance.render.terminal import TerminalRenderer
from floatref_conformance.render.wording import summary

LINE = "false alarm: 2 healthy recordings refused"


def shown(result):
    file = StringIO()
    renderer = TerminalRenderer(Console(file=file, width=150))
    renderer.handle(RunFinished(result))
    renderer.close()
    return file.getvalue()


def test_they_are_counted_on_the_terminal_and_on_the_page(check, result):
    refused = result(
        check(Outcome.ERROR, reason="stuck", false_alarms=2), check(Outcome.PASS, "bounce")
    )
    assert refused.false_alarms == 2
    assert shown(refused).count(f"stop: {LINE}") == 1
    assert "; 2 false alarms" in summary(refused)
    page = Page(as_html(refused, ())).text
    assert page.count(LINE) == 1
    assert "2 false alarms" in page


def test_a_waived_check_keeps_its_false_alarms(check, result):
    waived = result(check(Outcome.WAIVED, false_alarms=1))
    assert "false alarm: 1 healthy recording refused" in Page(as_html(waived, ())).text
    assert summary(waived).endswith("; 1 false alarm")


def test_report_json_has_their_number_where_there_are_some(check, result, tmp_path):
    both = result(check(Outcome.ERROR, false_alarms=2), check(Outcome.PASS, "bounce"))
    JsonReport.into(tmp_path).handle(RunFinished(both))
    stop, bounce = json.loads((tmp_path / "report.json").read_text(encoding="utf-8"))["checks"]
    assert stop["false_alarms"] == 2
    assert "false_alarms" not in bounce


def test_without_any_nothing_is_said_of_them(check, result):
    sound = result(check(Outcome.PASS))
    assert "false alarm" not in shown(sound) + Page(as_html(sound, ())).text
