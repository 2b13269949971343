"""Checks of streams in every report: a group of their own, and no trace without them."""

import json
from dataclasses import replace
from datetime import UTC, datetime

import pytest

from floatref_conformance.checks.verdict import Outcome, Verdict
from floatref_conformance.render import wording
from floatref_conformance.render.check_table import check_tables
from floatref_conformance.render.html import as_html
from floatref_conformance.render.junit import as_xml
from floatref_conformance.render.report import as_json
from floatref_conformance.render.terminal import make_console, result_lines
from floatref_conformance.schemas import enforce

BEGUN = datetime(2026, 1, 1, tzinfo=UTC)


@pytest.fixture
def ordinary(check, result):
    return result(check(Outcome.PASS))


@pytest.fixture
def streamed(check, ordinary):
    """A run whose streams pass one check and fail another."""
    late = check(Outcome.FAIL, "live-latency", reason="lateness of final points: 61 s")
    return replace(ordinary, streams=(check(Outcome.PASS, "live-final"), late))


def suites(result):
    return [suite.get("name") for suite in as_xml(result, {}, BEGUN)]


def test_without_streams_reports_are_as_they_were(ordinary):
    assert "stream" not in json.dumps(as_json(ordinary))
    assert "stream" not in wording.verdict_line(ordinary)
    assert len(suites(ordinary)) == 2
    assert len(check_tables(ordinary, make_console())) == 1


def test_the_verdict_counts_both_groups(streamed):
    assert streamed.verdict is Verdict.FAIL
    line = wording.verdict_line(streamed)
    assert line.startswith("FAIL: 1 of 1 checks that ran passed and 1 of 2 stream checks")


def test_the_failure_and_the_command_that_repeats_it_are_shown(streamed):
    text = "\n".join(result_lines(streamed))
    assert "live-latency: lateness of final points: 61 s" in text
    assert "--check live-latency" in text
    assert len(check_tables(streamed, make_console())) == 2


def test_files_have_them_beside_the_others(streamed):
    document = as_json(streamed)
    enforce("conformance-report-1", document)
    assert [c["id"] for c in document["checks"]] == ["stop"]
    assert [c["id"] for c in document["stream_checks"]] == ["live-final", "live-latency"]
    assert suites(streamed)[2] == "stream checks"
    (failed,) = as_xml(streamed, {}, BEGUN)[2].iter("failure")
    assert "61 s" in failed.get("message")
    assert "live-latency" in as_html(streamed)


def test_where_checks_of_recordings_alone_were_selected_streams_need_no_mention(check, result):
    partial = result(check(Outcome.PASS), check(Outcome.SKIP, "bounce", cases=0))
    left_out = check(Outcome.SKIP, "live-final", cases=0)
    quiet = replace(partial, streams=(left_out,))
    assert "stream" not in wording.verdict_line(quiet)
    assert "stream_checks" not in as_json(quiet)
    assert quiet.verdict is Verdict.INCOMPLETE


def test_where_all_checks_of_recordings_ran_it_says_that_streams_did_not(check, ordinary):
    left_out = check(Outcome.SKIP, "live-final", cases=0)
    told = replace(ordinary, streams=(left_out,))
    assert "1 stream check was not run and not judged" in wording.verdict_line(told)
    assert told.verdict is Verdict.INCOMPLETE


def test_streams_alone_have_the_only_table(check, result):
    streams = (check(Outcome.PASS, "live-final"),)
    only = replace(result(check(Outcome.SKIP, "stop", cases=0)), streams=streams)
    (table,) = check_tables(only, make_console())
    assert table.row_count == 1
