"""`junit.xml`: build servers read it, and take nothing for passed that did not pass."""

from datetime import UTC, datetime, timedelta
from pathlib import Path
from xml.etree import ElementTree

import pytest
import xmlschema

from floatref_conformance.checks.verdict import Outcome
from floatref_conformance.judge.events import CheckFinished, CheckStarted, RunFinished
from floatref_conformance.render.junit import JUnitReport

SCHEMA = xmlschema.XMLSchema(Path(__file__).parent / "data" / "junit.xsd")
BEGUN = datetime(2026, 5, 4, 3, 2, 1, tzinfo=UTC)
UNPASSED = {
    Outcome.FAIL: "failure",
    Outcome.ERROR: "error",
    Outcome.SKIP: "skipped",
    Outcome.WAIVED: "skipped",
    Outcome.NOT_APPLICABLE: "skipped",
}


@pytest.fixture
def written(tmp_path):
    """Return a function that writes a report and reads it back."""

    def write(result, now=BEGUN):
        report = JUnitReport.into(tmp_path)
        report.now = lambda: now
        report.handle(RunFinished(result))
        return tmp_path / "junit.xml"

    return write


def suites(path):
    return ElementTree.parse(path).getroot().findall("testsuite")


def test_a_report_with_every_outcome_and_hostile_words_keeps_the_schema(written, every):
    SCHEMA.validate(written(every))


def test_a_report_of_nothing_keeps_the_schema(written, result):
    SCHEMA.validate(written(result()))


def test_no_value_is_told_that_the_class_does_not_limit(written, check, result):
    (suite, _) = suites(written(result(check(Outcome.PASS, limits={}), check(Outcome.PASS, "b"))))
    lines = suite.find("system-out").text.splitlines()
    assert lines[-2].endswith("4 cases, no value that class nominal limits was measured")
    assert lines[-1].endswith(
        "worst is the IRI error of track left, case stop-2: 50 % of the limit"
    )


@pytest.mark.parametrize("outcome", Outcome)
def test_what_did_not_pass_says_so_and_why(written, check, result, kept, outcome):
    path = written(
        result(check(outcome, reason="for a reason"), replayed=[kept(outcome, "for a reason")])
    )
    for suite in suites(path):
        (case,) = suite.findall("testcase")
        assert [found.tag for found in case] == ([UNPASSED[outcome]] if outcome in UNPASSED else [])
        assert all(found.get("message") == "for a reason" for found in case)


def test_the_counts_of_a_suite_are_those_of_its_cases(written, every):
    for suite in suites(written(every)):
        cases = suite.findall("testcase")
        assert int(suite.get("tests")) == len(cases) == len(Outcome)
        for attribute, tag in (
            ("failures", "failure"),
            ("errors", "error"),
            ("skipped", "skipped"),
        ):
            assert int(suite.get(attribute)) == sum(case.find(tag) is not None for case in cases)


def test_a_failure_tells_the_commands_that_show_it_again(written, check, result):
    (failure,) = ElementTree.parse(written(result(check(Outcome.FAIL)))).iter("failure")
    device = "--device 'exec:./firmware '\"'\"'x y'\"'\"''"
    assert f"conformance replay cases/stop-1a2b3c4d.json {device}" in failure.text
    assert f"conformance run {device} --class nominal --seed 7 --check stop" in failure.text


def test_the_time_of_a_check_is_what_passed_between_its_events(tmp_path, check, result):
    seconds = iter([10.0, 12.5])
    report = JUnitReport.into(tmp_path)
    report.clock = lambda: next(seconds)
    passed = check(Outcome.PASS)
    for event in (CheckStarted("stop", 4), CheckFinished(passed), RunFinished(result(passed))):
        report.handle(event)
    suite = suites(tmp_path / "junit.xml")[0]
    assert suite.find("testcase").get("time") == suite.get("time") == "2.500"


def test_two_reports_of_one_result_differ_in_their_times_alone(written, every):
    first = written(every).read_text(encoding="utf-8")
    second = written(every, BEGUN + timedelta(days=1)).read_text(encoding="utf-8")
    assert first != second
    assert first.replace("2026-05-04T", "2026-05-05T") == second


def test_the_report_of_an_earlier_run_goes_away_at_once(tmp_path):
    (tmp_path / "junit.xml").write_text("old", encoding="utf-8")
    JUnitReport.into(tmp_path)
    assert list(tmp_path.iterdir()) == []
