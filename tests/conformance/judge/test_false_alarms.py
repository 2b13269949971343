"""A healthy recording that is refused is a failure, and counted as a false alarm."""

from dataclasses import replace

import pytest

from floatref.errors import InputError
from floatref_conformance.checks.verdict import Outcome, Verdict
from floatref_conformance.errors import DeviceError, DeviceRefused, DeviceSkipped
from floatref_conformance.judge.bench import DeviceBench

SCREENED = InputError("channel distance: stuck; connect the encoder")


@pytest.mark.parametrize("error", [SCREENED, DeviceRefused("run: answered an error: stuck")])
def test_refusing_healthy_recordings_fails_and_each_is_counted(plan, result_of, raising, error):
    result = result_of(plan(raising(error), searching=False))
    assert result.verdict is Verdict.FAIL
    (check,) = result.checks
    assert check.outcome is Outcome.ERROR
    assert "stuck" in check.reason
    assert check.false_alarms == result.false_alarms == check.cases == 2


def test_one_healthy_recording_of_many_is_enough(plan, result_of, raising, toy_check):
    device = raising(SCREENED, when=lambda number: number == 3)
    result = result_of(plan(device, toy_check(count=5), searching=False))
    assert result.verdict is Verdict.FAIL
    assert result.false_alarms == 1


@pytest.mark.parametrize("error", [ZeroDivisionError("0"), DeviceError("delivered nothing")])
def test_a_crash_is_a_fault_but_no_alarm(plan, result_of, raising, error):
    result = result_of(plan(raising(error), searching=False))
    assert result.verdict is Verdict.FAIL
    assert result.false_alarms == 0


def test_a_recording_that_is_not_processed_is_not_judged(plan, result_of, raising):
    result = result_of(plan(raising(DeviceSkipped("no pipeline yet")), searching=False))
    assert result.verdict is Verdict.INCOMPLETE
    assert result.false_alarms == 0


class Broken:
    """A check of one recording with a fault in it."""

    def __init__(self, check):
        self.check = check

    def __getattr__(self, name):
        return getattr(self.check, name)

    def judge(self, case, bench):
        return self.check.judge(case, _Faulty(bench))


class _Faulty:
    def __init__(self, bench: DeviceBench) -> None:
        self.bench = bench

    def run(self, taken, label=""):
        return self.bench.run(replace(taken, healthy=False), label)


def test_a_faulty_recording_that_is_refused_is_no_false_alarm(plan, result_of, raising, toy_check):
    result = result_of(plan(raising(SCREENED), Broken(toy_check()), searching=False))
    assert result.verdict is Verdict.FAIL
    assert result.false_alarms == 0
