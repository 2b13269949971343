"""A profile that ends early: the terminal, the page and `report.json` have the warning."""

import json
from io import StringIO

import pytest
from rich.console import Console
from tests.conformance.page_reader import Page

from floatref_conformance.checks.verdict import Outcome
from floatref_conformance.judge.events import RunFinished
from floatref_conformance.render.html import as_html
from floatref_conformance.render.report import JsonReport, as_json
from floatref_conformance.render.terminal import TerminalRenderer

WARNING = "warning: a profile ends 0.249 m before its recording"


def shown(result):
    file = StringIO()
    renderer = TerminalRenderer(Console(file=file, width=150))
    renderer.handle(RunFinished(result))
    renderer.close()
    return file.getvalue()


@pytest.mark.parametrize("outcome", [Outcome.PASS, Outcome.FAIL, Outcome.WAIVED])
def test_the_warning_is_on_the_terminal_and_on_the_page(check, result, outcome):
    early = result(check(outcome, early_m=0.2486), check(Outcome.PASS, "bounce"))
    assert shown(early).count(f"stop: {WARNING}") == shown(early).count("warning") == 1
    page = Page(as_html(early, ())).text
    assert page.count(WARNING) == page.count("warning") == 1


def test_report_json_has_the_length_of_those_that_end_early_alone(check, result, tmp_path):
    early = result(check(Outcome.PASS, early_m=0.2486), check(Outcome.PASS, "bounce"))
    stop, bounce = as_json(early)["checks"]
    assert stop["early_m"] == 0.2486
    assert "early_m" not in bounce
    # Writing enforces the schema.
    JsonReport.into(tmp_path).handle(RunFinished(early))
    written = json.loads((tmp_path / "report.json").read_text(encoding="utf-8"))
    assert written["checks"][0]["early_m"] == 0.2486


def test_without_an_early_end_nobody_is_warned(check, result):
    sound = result(check(Outcome.PASS))
    assert "warning" not in shown(sound)
    assert "warning" not in Page(as_html(sound, ())).text
