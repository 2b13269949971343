"""The run: its events, and what the outcomes of its checks make together."""

import json
import sys
from dataclasses import replace

import pytest

from floatref_conformance.classes import DeviceClass
from floatref_conformance.errors import SuiteError
from floatref_conformance.events import CaseFinished, RunFinished
from floatref_conformance.render.report import as_json
from floatref_conformance.runner import run
from floatref_conformance.verdict import Outcome, Verdict


def result_of(plan):
    last = list(run(plan))[-1]
    assert isinstance(last, RunFinished)
    return last.result


def scaled(gain):
    return lambda tracks: {name: gain * z for name, z in tracks.items()}


def test_a_device_that_delivers_the_road_passes_and_reaches_the_strictest_class(plan, fake_device):
    result = result_of(plan(fake_device()))
    assert result.verdict is Verdict.PASS
    assert result.class_reached is DeviceClass.REFERENCE
    assert result.checks[0].counterexample is None


def test_the_events_come_in_order_and_count_the_cases(plan, fake_device, toy_check):
    names = [type(e).__name__ for e in run(plan(fake_device(), toy_check(count=2)))]
    assert names == [
        "RunStarted", "CheckStarted", "CaseFinished", "CaseFinished", "CheckFinished",
        "RunFinished",
    ]  # fmt: skip


def test_a_device_beyond_the_limit_fails_with_value_limit_and_case(plan, fake_device):
    result = result_of(plan(fake_device(scaled(0.5))))
    check = result.checks[0]
    assert result.verdict is Verdict.FAIL
    assert check.outcome is Outcome.FAIL
    assert check.worst.value > check.worst.limits[DeviceClass.NOMINAL]
    assert check.class_reached is None
    assert check.counterexample["parameters"]["seed"] in (0, 1)
    assert "limit 0.1 m/km" in check.reason


def test_the_class_decides_and_an_easier_class_may_be_reached(plan, fake_device):
    device = fake_device(scaled(0.99))
    value = result_of(plan(device)).checks[0].worst.value
    assert 0.01 < value < 0.05
    strict = result_of(plan(device, device_class=DeviceClass.REFERENCE))
    assert strict.verdict is Verdict.FAIL
    assert strict.class_reached is DeviceClass.ADEQUATE
    assert result_of(plan(device, device_class=DeviceClass.ADEQUATE)).verdict is Verdict.PASS


def test_a_check_that_needs_an_undeclared_capability_leaves_the_verdict_alone(
    plan, fake_device, toy_check
):
    needy = toy_check(id="needy", needs=frozenset({"gnss"}))
    result = result_of(plan(fake_device(), toy_check(), needy))
    outcomes = {c.id: c.outcome for c in result.checks}
    assert outcomes == {"toy": Outcome.PASS, "needy": Outcome.NOT_APPLICABLE}
    assert result.verdict is Verdict.PASS
    assert result_of(plan(fake_device(), needy)).verdict is Verdict.INCOMPLETE


def test_what_is_left_out_makes_a_pass_incomplete_but_not_a_failure(plan, fake_device):
    good = result_of(plan(fake_device(), left_out=("other",)))
    assert good.verdict is Verdict.INCOMPLETE
    assert good.class_reached is None
    assert {c.id: c.outcome for c in good.checks}["other"] is Outcome.SKIP
    bad = result_of(plan(fake_device(scaled(0.5)), left_out=("other",)))
    assert bad.verdict is Verdict.FAIL


def test_the_oracle_overrules_a_wrong_measure(plan, fake_device, toy_check):
    with pytest.raises(SuiteError, match=r"IRI is .* by the reference"):
        list(run(plan(fake_device(), toy_check(skew=0.01))))
    assert result_of(plan(fake_device(), toy_check(skew=1e-5))).verdict is Verdict.PASS


def test_it_is_the_worst_case_that_the_oracle_measures_again(plan, fake_device, toy_check):
    class SkewedAbove(toy_check):
        def judge(self, case, profile, simulated):
            measured = super().judge(case, profile, simulated)
            return [replace(m, value=m.value * (1.01 if m.value > 0.95 else 1)) for m in measured]

    values = []
    for event in run(plan(fake_device(), toy_check(count=4))):
        if isinstance(event, CaseFinished):
            values.append(event.result.measurements[1].value)
    assert sum(value > 0.95 for value in values) == 1
    with pytest.raises(SuiteError):
        list(run(plan(fake_device(), SkewedAbove(count=4))))


def test_an_error_of_the_suite_is_not_blamed_on_the_device(plan, fake_device, toy_check):
    class Broken(toy_check):
        def judge(self, case, profile, simulated):
            raise KeyError("left")

    with pytest.raises(SuiteError, match="KeyError"):
        list(run(plan(fake_device(), Broken())))


def test_a_check_that_ends_the_process_is_no_verdict(plan, fake_device, toy_check):
    class Leaving(toy_check):
        def judge(self, case, profile, simulated):
            sys.exit(0)

    with pytest.raises(SuiteError, match="SystemExit"):
        list(run(plan(fake_device(), Leaving())))


def test_the_same_seed_makes_the_same_report_and_another_seed_another(plan, fake_device):
    device = fake_device(scaled(0.5))
    reports = [as_json(result_of(plan(device, seed=seed))) for seed in (4, 4, 5)]
    assert json.dumps(reports[0]) == json.dumps(reports[1])
    assert reports[0]["checks"][0]["worst"] != reports[2]["checks"][0]["worst"]
