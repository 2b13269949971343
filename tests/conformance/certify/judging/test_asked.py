"""What a practice asks beside agreement: judged where it can be, and a line where it cannot."""

from dataclasses import replace
from math import isnan

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from floatref.values.profile import Profile, ProfileTrack
from floatref_conformance.certify.judging.asked import judge_asked, list_open, report_open
from floatref_conformance.certify.judging.contents import Criterion, Judged, RunSheet, RunTrack
from floatref_conformance.certify.judging.criteria import verdict_of
from floatref_conformance.certify.judging.limits import CertificationLimits, limits_of
from floatref_conformance.certify.practice.practice_document import find_practice, list_names
from floatref_conformance.checks.verdict import Verdict
from floatref_conformance.classes import DeviceClass

NOMINAL = DeviceClass.NOMINAL
PLAIN = CertificationLimits()


def run(name: str, interval_m: float, iri: float = 1.0) -> RunSheet:
    profile = Profile(interval_m, (ProfileTrack.of("left", np.zeros(3)),))
    track = RunTrack("left", 1.0, 0.0, iri, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    return RunSheet(name, name, (), (track,), "", profile)


@given(st.lists(st.floats(0.01, 0.4), min_size=1, max_size=4), st.sampled_from((1, 2, 3)))
def test_the_widest_interval_decides(intervals: list[float], number: int) -> None:
    limits = limits_of(NOMINAL, find_practice(f"astm-e950-class-{number}"))
    (made,) = judge_asked([run("a", one) for one in intervals], ["left"], limits)
    most = {1: 0.025, 2: 0.15, 3: 0.3}[number]
    assert made.value == max(intervals)
    assert (made.judged is Judged.FAIL) == (max(intervals) > most * (1 + 1e-9))
    assert bool(made.reason) == (made.judged is Judged.FAIL)


def test_three_inches_are_three_inches() -> None:
    limits = limits_of(NOMINAL, find_practice("tex-1001-s"))
    for interval_m, judged in ((0.0762, Judged.PASS), (0.0763, Judged.FAIL)):
        made = next(iter(judge_asked([run("a", interval_m)], ["left"], limits)))
        assert made.judged is judged


@given(st.lists(st.floats(0.5, 5.0), min_size=2, max_size=6))
def test_the_spread_of_iri_is_reported_alone(values: list[float]) -> None:
    limits = limits_of(NOMINAL, find_practice("tex-1001-s"))
    runs = [run(f"run-{k}", 0.05, value) for k, value in enumerate(values)]
    _, made = judge_asked(runs, ["left"], limits)
    mean = sum(values) / len(values)
    square = sum((value - mean) ** 2 for value in values) / (len(values) - 1)
    assert made.value == pytest.approx(square**0.5, abs=1e-9)
    assert made.judged is Judged.REPORTED


def test_the_default_asks_for_nothing_more() -> None:
    assert not list(judge_asked([run("a", 0.05)], ["left"], PLAIN))
    assert not report_open(PLAIN)
    assert not list_open(PLAIN)


@pytest.mark.parametrize("name", list_names()[1:])
def test_a_practice_with_an_unknown_limit_is_never_passed(name: str) -> None:
    limits = limits_of(NOMINAL, find_practice(name))
    opened = bool(limits.practice.open_requirements())
    passed = Criterion("runs", "runs", "clause", 1.0, 1.0, "", True, Judged.PASS)
    assert opened
    assert verdict_of([passed], opened) is Verdict.INCOMPLETE
    assert verdict_of([replace(passed, judged=Judged.FAIL)], opened) is Verdict.FAIL
    for line in report_open(limits):
        assert line.judged is Judged.REPORTED
        assert isnan(line.value)
        assert "not measured" in line.reason
    shown = len(report_open(limits)) + len(list_open(limits))
    assert shown == len(limits.practice.open_requirements())


def test_coverage_alone_is_no_reason_to_pass() -> None:
    covered = Criterion("coverage", "coverage", "ours", 0.0, 2.0, "%", False, Judged.PASS)
    assert verdict_of([covered]) is Verdict.INCOMPLETE
    assert verdict_of([replace(covered, judged=Judged.FAIL)]) is Verdict.FAIL
