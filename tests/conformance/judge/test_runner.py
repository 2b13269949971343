"""The run: its events, and what the outcomes of its checks make together."""

import json
from dataclasses import replace

import pytest

from floatref_conformance.checks.case import Case
from floatref_conformance.checks.verdict import Outcome, Verdict
from floatref_conformance.classes import DeviceClass, Effort
from floatref_conformance.errors import DeviceError, SuiteError
from floatref_conformance.judge.events import CaseFinished, CheckFinished, RunFinished
from floatref_conformance.judge.runner import run
from floatref_conformance.proving_ground.scenario import Scenario
from floatref_conformance.render.report import as_json


def ignore(event):
    """Take no note of ``event``."""


def scaled(gain):
    return lambda tracks: {name: gain * z for name, z in tracks.items()}


def test_a_device_that_delivers_the_road_passes_and_reaches_the_strictest_class(
    plan, result_of, fake_device
):
    result = result_of(plan(fake_device()))
    assert result.verdict is Verdict.PASS
    assert result.class_reached is DeviceClass.REFERENCE
    assert result.checks[0].counterexample is None


def test_the_events_of_a_device_that_passes_come_in_order(plan, events_of, fake_device, toy_check):
    events, _ = events_of(plan(fake_device(), toy_check(count=2)))
    assert [type(e).__name__ for e in events] == [
        "RunStarted",
        "CheckStarted",
        *2 * ["CaseFinished"],
        "SearchStarted",
        *Effort.QUICK.searched * ["CaseFinished"],
        "CheckFinished",
        "RunFinished",
    ]
    assert (events[1].cases, events[4].cases) == (2, Effort.QUICK.searched)


def test_a_failing_case_is_made_simpler_instead_of_searching(plan, events_of, halving):
    events, result = events_of(plan(halving, seed=1))
    names = [type(e).__name__ for e in events]
    assert names[:5] == [
        "RunStarted",
        "CheckStarted",
        "CaseFinished",
        "CaseFinished",
        "ShrinkStarted",
    ]
    assert names[-2:] == ["CheckFinished", "RunFinished"]
    assert 1 <= len(names[5:-2]) <= Effort.QUICK.shrunk
    assert set(names[5:-2]) == {"CaseFinished"}
    assert result.checks[0].cases == 2


def test_a_device_beyond_the_limit_fails_with_value_limit_and_case(plan, result_of, halving):
    result = result_of(plan(halving, seed=1))
    check = result.checks[0]
    assert result.verdict is Verdict.FAIL
    assert check.outcome is Outcome.FAIL
    assert check.worst.value > check.worst.limits[DeviceClass.NOMINAL]
    assert check.worst_case in ("toy-1", "toy-2")
    assert check.class_reached is None
    assert "limit 0.1 m/km" in check.reason


def test_the_counterexample_is_the_simplest_case_with_its_pass(plan, result_of, halving):
    check = result_of(plan(halving, seed=1)).checks[0]
    assert check.counterexample["parameters"] == Case("toy", Scenario()).parameters
    assert "IRI error" in check.counterexample["reason"]
    assert check.counterexample["file"].startswith("cases/toy-")
    (shown,) = check.passes
    half = 0.5 * shown.truth.track("left").elevation
    assert shown.result.track("left").elevation == pytest.approx(half, abs=1e-6)


def test_the_class_decides_and_an_easier_class_may_be_reached(plan, result_of, fake_device):
    device = fake_device(scaled(0.99))
    value = result_of(plan(device)).checks[0].worst.value
    assert 0.01 < value < 0.05
    strict = result_of(plan(device, device_class=DeviceClass.REFERENCE))
    assert strict.verdict is Verdict.FAIL
    assert strict.class_reached is DeviceClass.ADEQUATE
    assert result_of(plan(device, device_class=DeviceClass.ADEQUATE)).verdict is Verdict.PASS


def test_a_check_that_needs_an_undeclared_capability_leaves_the_verdict_alone(
    plan, result_of, fake_device, toy_check
):
    needy = toy_check(id="needy", needs=frozenset({"gnss"}))
    result = result_of(plan(fake_device(), toy_check(), needy))
    outcomes = {c.id: c.outcome for c in result.checks}
    assert outcomes == {"toy": Outcome.PASS, "needy": Outcome.NOT_APPLICABLE}
    assert result.verdict is Verdict.PASS
    assert result_of(plan(fake_device(), needy)).verdict is Verdict.INCOMPLETE
    able = result_of(plan(fake_device(capabilities=("gnss",)), needy))
    assert able.checks[0].outcome is Outcome.PASS


def test_what_is_left_out_makes_a_pass_incomplete_but_not_a_failure(
    plan, result_of, fake_device, halving
):
    good = result_of(plan(fake_device(), left_out=("other",)))
    assert good.verdict is Verdict.INCOMPLETE
    assert good.class_reached is None
    assert {c.id: c.outcome for c in good.checks}["other"] is Outcome.SKIP
    assert result_of(plan(halving, left_out=("other",))).verdict is Verdict.FAIL


def test_the_checks_of_a_result_are_in_the_order_of_the_suites_list(
    plan, result_of, fake_device, toy_check
):
    checks = [toy_check(id=id_, count=1) for id_ in ("mine", "bounce", "quiescent")]
    result = result_of(plan(fake_device(), *checks, left_out=("stop",), searching=False))
    assert [c.id for c in result.checks] == ["quiescent", "bounce", "stop", "mine"]


def test_a_measurement_of_the_suite_that_the_reference_denies_is_no_verdict(
    plan, result_of, fake_device, toy_check
):
    with pytest.raises(SuiteError, match=r"IRI error is .* by the reference"):
        run(plan(fake_device(), toy_check(skew=0.01)), ignore)
    assert result_of(plan(fake_device(), toy_check(skew=1e-7))).verdict is Verdict.PASS


def test_it_is_the_worst_measurement_that_is_made_again(
    plan, events_of, result_of, fake_device, toy_check
):
    class Skewed(toy_check):
        """Adds to the largest value alone, or to all others."""

        largest: float
        worst: bool

        def judge(self, case, bench):
            return tuple(
                replace(m, value=m.value + 1e-3 * ((m.value == self.largest) == self.worst))
                for m in super().judge(case, bench)
            )

    events, _ = events_of(plan(fake_device(scaled(0.98))))
    values = [m.value for e in events if isinstance(e, CaseFinished) for m in e.result.measurements]
    Skewed.largest = max(values)
    assert sorted(set(values))[-2] < Skewed.largest - 2e-3
    Skewed.worst = False
    assert result_of(plan(fake_device(scaled(0.98)), Skewed())).verdict is Verdict.PASS
    Skewed.worst = True
    with pytest.raises(SuiteError):
        run(plan(fake_device(scaled(0.98)), Skewed()), ignore)


@pytest.mark.parametrize("searched", [False, True])
@pytest.mark.parametrize("error", [KeyError("left"), SystemExit(0), ValueError("bad\nnumber")])
def test_an_error_of_the_suite_is_not_blamed_on_the_device(
    plan, fake_device, toy_check, error, searched
):
    class Broken(toy_check):
        def judge(self, case, bench):
            if searched == case.name.startswith("toy-search"):
                raise error
            return super().judge(case, bench)

    device = fake_device()
    with pytest.raises(SuiteError) as caught:
        run(plan(device, Broken()), ignore)
    assert str(caught.value) == f"{type(error).__name__}: {' '.join(str(error).split())}"
    assert device.closed == 1


@pytest.mark.parametrize("error", [KeyboardInterrupt, BrokenPipeError])
def test_an_interruption_goes_to_the_caller_and_the_device_is_closed(plan, fake_device, error):
    device, warnings = fake_device(), []

    def emit(event):
        warnings.append(event)
        if len(warnings) == 5:
            raise error

    with pytest.raises(error):
        run(plan(device), emit)
    assert device.closed == 1


def test_a_device_is_closed_once_after_a_verdict_and_need_not_be_able_to(plan, result_of, halving):
    result_of(plan(halving))
    assert halving.closed == 1
    halving.close = None
    assert result_of(plan(halving)).verdict is Verdict.FAIL


def test_a_device_is_closed_once_when_no_check_is_left_to_run(plan, result_of, halving):
    nothing = replace(plan(halving, left_out=("toy",)), checks=())
    assert result_of(nothing).verdict is Verdict.INCOMPLETE
    assert halving.closed == 1


@pytest.mark.parametrize("kind", [CheckFinished, RunFinished])
@pytest.mark.parametrize("error", [KeyboardInterrupt, BrokenPipeError])
def test_a_device_is_closed_once_when_nobody_hears_the_end(plan, halving, kind, error):
    def emit(event):
        if isinstance(event, kind):
            raise error

    with pytest.raises(error):
        run(plan(halving), emit)
    assert halving.closed == 1


def test_a_device_whose_end_was_interrupted_is_closed_again(plan, fake_device):
    class Slow(fake_device):
        def close(self):
            super().close()
            if self.closed == 1:
                raise KeyboardInterrupt

    device = Slow()
    with pytest.raises(KeyboardInterrupt):
        run(plan(device), ignore)
    assert device.closed == 2


@pytest.mark.slow
@pytest.mark.parametrize("gain", [1.0, 0.95, 0.5])
def test_the_same_seed_makes_the_same_report_and_another_seed_another(
    plan, result_of, fake_device, gain
):
    texts = [
        json.dumps(as_json(result_of(plan(fake_device(scaled(gain)), seed=seed))))
        for seed in (4, 4, 5)
    ]
    assert texts[0] == texts[1]
    assert texts[0].replace('"seed": 4', '"seed": 5') != texts[2]


@pytest.mark.parametrize("gain", [1.0, 0.5])
def test_a_fault_at_the_end_makes_the_last_check_an_error(
    plan, result_of, fake_device, toy_check, gain
):
    device = fake_device(scaled(gain))
    device.close = lambda: (_ for _ in ()).throw(DeviceError("stop: was killed by SIGSEGV"))
    result = result_of(plan(device, toy_check(), toy_check(id="last")))
    outcomes = {check.id: check.outcome for check in result.checks}
    assert outcomes["last"] is Outcome.ERROR
    assert outcomes["toy"] is (Outcome.PASS if gain == 1.0 else Outcome.FAIL)
    assert "SIGSEGV" in {check.id: check.reason for check in result.checks}["last"]
    assert result.verdict is Verdict.FAIL
