"""The group of stream checks: who gets it, what a fault does, and that sound devices pass."""

from dataclasses import dataclass, replace

import pytest

import floatref_conformance.judge.stream_judging as judging
from floatref_conformance.checks.streams.stream_catalogue import STREAM_CHECKS, drives
from floatref_conformance.checks.verdict import Outcome, Verdict
from floatref_conformance.classes import DeviceClass, Effort
from floatref_conformance.devices.builtin import make
from floatref_conformance.devices.interface import Description
from floatref_conformance.errors import DeviceError, DeviceHung
from floatref_conformance.judge.stream_judging import StreamPlan, StreamTrial, judge_streams
from floatref_conformance.plugins import load_registry

NOBODY = Description("x", "1", "temporal", ())
ALL = list(STREAM_CHECKS)


@dataclass
class Streaming:
    """A device whose stream never gets so far."""

    live_argv: tuple[str, ...] = ("nobody",)


def trial_with(monkeypatch, runs, events=None):
    """Return a trial whose checks get ``runs`` in place of those of a device."""
    monkeypatch.setattr(StreamTrial, "_runs_of", lambda self, case, argv: runs(case))
    emit = (lambda event: None) if events is None else events.append
    return StreamTrial(NOBODY, DeviceClass.NOMINAL, 0, Effort.QUICK, emit)


def test_a_device_that_does_not_stream_gets_no_result_unless_a_check_was_named():
    ours = StreamTrial(NOBODY, DeviceClass.NOMINAL, 0, Effort.QUICK, lambda event: None)
    assert judge_streams(StreamPlan.of(()), object(), ours, str) == ()
    (only,) = judge_streams(StreamPlan.of(("live-final",)), object(), ours, str)
    assert (only.id, only.outcome) == ("live-final", Outcome.NOT_APPLICABLE)
    assert judge_streams(StreamPlan(), Streaming(), ours, str) == ()


def test_checks_that_are_not_selected_are_left_out_of_a_device_that_streams(monkeypatch):
    ours = trial_with(monkeypatch, lambda case: 1 / 0)
    found = judge_streams(StreamPlan.of(("stop",)), Streaming(), ours, str)
    assert [(r.id, r.outcome) for r in found] == [(id_, Outcome.SKIP) for id_ in ALL]


def test_a_wrong_declaration_and_a_faulty_end_are_faults_of_every_check():
    class Wrong:
        @property
        def live_argv(self):
            raise DeviceError("streaming is 'yes'")

    ours = StreamTrial(NOBODY, DeviceClass.NOMINAL, 0, Effort.QUICK, lambda event: None)
    for found in (
        judge_streams(StreamPlan.of(()), Wrong(), ours, str),
        judge_streams(StreamPlan.of(()), Streaming(), ours, lambda: "hung"),
    ):
        assert [(r.id, r.outcome) for r in found] == [(id_, Outcome.ERROR) for id_ in ALL]


def test_a_fault_fails_its_check_and_after_three_hangs_the_device_is_left_alone(monkeypatch):
    asked = []

    def runs(case):
        asked.append(case.name)
        raise DeviceHung("stream: no answer within 1 s")

    found = judge_streams(StreamPlan.of(()), Streaming(), trial_with(monkeypatch, runs), str)
    assert {r.outcome for r in found} == {Outcome.ERROR}
    assert len(asked) == judging.MOST_HANGS
    assert "hung 3 times" in found[-1].reason


@pytest.mark.parametrize("effort", list(Effort))
def test_drives_follow_from_the_seed_and_every_one_reaches_its_end(effort):
    for seed in range(20):
        cases = drives(seed, effort)
        assert cases == drives(seed, effort)
        assert cases != drives(seed + 1, effort)
        assert {case.steady for case in cases} == {True, False}
        assert len({case.name for case in cases}) == len(cases)


def test_the_verdict_covers_both_groups(check, run_result):
    passed, failed = check(Outcome.PASS), check(Outcome.FAIL, "live-final")
    assert run_result((passed,)).verdict is Verdict.PASS
    assert replace(run_result((passed,)), streams=(failed,)).verdict is Verdict.FAIL
    left_out = replace(failed, outcome=Outcome.SKIP)
    assert replace(run_result((passed,)), streams=(left_out,)).verdict is Verdict.INCOMPLETE


@pytest.fixture
def check():
    from floatref_conformance.checks.verdict import CheckResult

    return lambda outcome, id_="stop": CheckResult(id_, "", outcome)


@pytest.fixture
def run_result():
    from floatref_conformance.checks.verdict import RunResult

    return lambda checks: RunResult({}, DeviceClass.NOMINAL, 0, "quick", checks)


@pytest.mark.slow
@pytest.mark.parametrize("seed", [0, pytest.param(1, marks=pytest.mark.nightly)])
@pytest.mark.parametrize("spec", ["builtin:road-prior-smoother", "builtin:temporal-matched-hpf"])
def test_a_built_in_stream_passes_all_five(spec, seed):
    device = load_registry().device(spec)
    described = Description.of(device.describe())
    ours = StreamTrial(described, DeviceClass.NOMINAL, seed, Effort.QUICK, lambda event: None)
    found = judge_streams(StreamPlan.of(()), device, ours, str)
    assert [(r.id, r.outcome, r.reason) for r in found] == [(i, Outcome.PASS, "") for i in ALL]


def test_every_pipeline_has_a_stream():
    assert make("temporal-basic").live_argv[-1] == "temporal-basic"
