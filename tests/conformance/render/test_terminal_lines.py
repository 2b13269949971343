"""What the terminal says of a result: how far from the limit, in which case, what to do."""

from io import StringIO
from math import nan

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from rich.console import Console

from floatref_conformance.checks.verdict import Outcome
from floatref_conformance.classes import DeviceClass
from floatref_conformance.devices.interface import Description
from floatref_conformance.judge.events import (
    CaseReplayed,
    CheckFinished,
    CheckStarted,
    RunFinished,
    RunStarted,
    SearchStarted,
    ShrinkStarted,
)
from floatref_conformance.render.terminal import TerminalRenderer, result_lines


def shown(*events, terminal=False, verbose=False):
    file = StringIO()
    renderer = TerminalRenderer(Console(file=file, force_terminal=terminal, width=150), verbose)
    for event in events:
        renderer.handle(event)
    renderer.close()
    return file.getvalue()


def test_a_failure_names_its_case_and_the_simplest_one(check, result):
    failed = result(check(Outcome.FAIL, reason="3 m/km, limit 1 m/km"))
    text = shown(RunFinished(failed), verbose=True)
    assert "stop: 3 m/km, limit 1 m/km; worst is the IRI error of track left, case stop-2" in text
    simplest = "manoeuvre stop, speed_kmh 60, bump_mm 20, bump_at_m 150, gap_s 0.25"
    simplest_line = next(
        line for line in text.splitlines() if "the simplest case that fails" in line
    )
    assert sorted(simplest_line.partition("fails: ")[2].split(", ")) == sorted(simplest.split(", "))
    assert text.splitlines()[-1].startswith("Reproduce with: conformance run --device")


@pytest.mark.parametrize(("value", "margin"), [(0.25, "75%"), (1.0, "0%"), (3.0, "-200%")])
def test_the_margin_is_what_is_left_of_the_limit(check, result, value, margin):
    outcome = Outcome.PASS if value <= 1 else Outcome.FAIL
    text = shown(RunFinished(result(check(outcome, value=value))))
    row = next(line for line in text.splitlines() if line.startswith(" stop"))
    assert row.split()[-1] == margin


@pytest.mark.parametrize(("flagged_m", "end"), [(0.0, "was measured"), (371.2, "was valid")])
def test_no_value_is_shown_that_the_class_does_not_limit(check, result, flagged_m, end):
    slow = check(Outcome.PASS, value=nan, limits={DeviceClass.ADEQUATE: 0.08}, flagged_m=flagged_m)
    lines = shown(RunFinished(result(slow))).splitlines()
    row = next(line for line in lines if line.startswith(" stop"))
    why = f"no value that class nominal limits {end}"
    assert row.split() == ["stop", "pass", "nominal", "4", *why.split()]
    assert f"stop: {why} [R 56-14, 6]" in shown(RunFinished(result(slow)), verbose=True)
    limited = shown(RunFinished(result(slow, device_class=DeviceClass.ADEQUATE)), verbose=True)
    assert "no value that" not in limited


@pytest.mark.parametrize("outcome", Outcome)
def test_only_what_fails_has_a_line_below_the_table_unless_details_are_asked_for(
    check, result, outcome
):
    made = result(check(outcome, reason="why so", cases=4, flagged_m=7.0))
    short, whole = (shown(RunFinished(made), verbose=v).splitlines() for v in (False, True))
    about = [line for line in short if line.startswith("stop: ")]
    fails = outcome in (Outcome.FAIL, Outcome.ERROR, Outcome.WAIVED)
    assert about == ["stop: why so [R 56-14, 6]"] * fails
    details = [line for line in whole if line.startswith("stop: ")]
    assert "stop: up to 7.0 m of a wheel path flagged invalid" in details
    assert [line for line in whole if line not in details] == [
        line for line in short if line not in about
    ]


def test_a_kept_case_that_still_fails_is_told_with_the_command_that_runs_it(check, result, kept):
    again = kept(Outcome.FAIL, "too rough")
    made = result(check(Outcome.PASS), replayed=[again])
    lines = shown(CaseReplayed(again), RunFinished(made)).splitlines()
    assert lines[0] == "Replayed stop-0000aaaa.json: fail (too rough)"
    assert any(
        line.startswith("FAIL: 1 of 1 checks that ran passed; 1 of 1 kept") for line in lines
    )
    assert "conformance replay cases/stop-0000aaaa.json --device" in lines[-1]


def test_what_was_not_run_differs_from_what_a_device_skipped(check, result):
    not_run = check(Outcome.SKIP, "later", reason="not selected")
    skipped = check(Outcome.SKIP, "gap", reason="too long", cases=4)
    text = shown(RunFinished(result(not_run, skipped, check(Outcome.PASS))))
    rows = [line.split() for line in text.splitlines() if line.startswith((" gap", " later"))]
    assert [row[:2] for row in rows] == [["gap", "skipped"]]
    assert "Not run (not selected): later\n" in text
    assert "Skipped by the device (too long): gap\n" in text
    assert "INCOMPLETE: 1 of 1 checks that ran passed; 2 were not run" in text


@settings(suppress_health_check=[HealthCheck.function_scoped_fixture], deadline=None)
@given(width=st.integers(30, 200), count=st.integers(1, 30))
def test_what_was_not_run_is_wrapped_at_words(check, result, width, count):
    """No line is wider than the console, and no name of a check is split or lost."""
    ids = [f"low-speed-{k}" for k in range(count)]
    skipped = [check(Outcome.SKIP, name, reason="not selected") for name in ids]
    lines = result_lines(result(*skipped, check(Outcome.PASS)), width=width)
    (wrapped,) = (line for line in lines if line.startswith("Not run"))
    assert max(map(len, wrapped.splitlines())) <= width
    assert " ".join(wrapped.split()) == f"Not run (not selected): {', '.join(ids)}"
    assert all(line.startswith("  low-speed-") for line in wrapped.splitlines()[1:])


def test_a_pipe_gets_one_plain_line_for_every_step(check, hostile):
    about = Description("x", "1", "temporal", ())
    text = shown(
        RunStarted(hostile, about, (), ()),
        CheckStarted("stop", 4),
        SearchStarted("stop", 3),
        ShrinkStarted("stop", 12),
        CheckFinished(check(Outcome.FAIL, reason="[red]3 m/km")),
    )
    lines = text.splitlines()[-4:]
    assert lines == [
        "stop: 4 cases",
        "stop, searching: 3 cases",
        "stop, simplifying: 12 cases",
        "stop: fail ([red]3 m/km)",
    ]
    assert not {"\x00", "\x1b", "\u202e", "\r"} & set(text)


def test_a_terminal_shows_the_outcome_of_a_check_when_its_bar_is_gone(check):
    about = Description("x", "1", "temporal", ())
    text = shown(
        RunStarted("x", about, (), ()),
        CheckStarted("stop", 4),
        SearchStarted("stop", 3),
        CheckFinished(check(Outcome.PASS)),
        terminal=True,
    )
    assert "stop: pass" in text


def test_a_waived_failure_is_told_in_the_verdict(check, result):
    text = shown(RunFinished(result(check(Outcome.PASS, "bounce"), check(Outcome.WAIVED))))
    assert "INCOMPLETE: 1 of 2 checks that ran passed; 1 failed and was waived" in text
