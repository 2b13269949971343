"""A run asks of a device the cases that say something of it, and calls no other one passed."""

from dataclasses import replace

import pytest

from floatref_conformance.case_files import KeptCase
from floatref_conformance.checks.case import Case
from floatref_conformance.checks.faults.check import FaultsCheck
from floatref_conformance.checks.faults.sensor_faults import SENSOR_FAULTS
from floatref_conformance.checks.sameness.changes import CHANGES
from floatref_conformance.checks.sameness.invariance import InvarianceCheck
from floatref_conformance.checks.verdict import Outcome
from floatref_conformance.classes import DeviceClass, Effort
from floatref_conformance.judge.events import CheckStarted


@pytest.mark.parametrize(
    ("architecture", "capabilities", "cases"),
    [
        ("temporal", (), 3),
        ("spatial", ("gnss",), 4),
        ("temporal", ("response",), 3),
        ("response", ("response",), 2),
        ("response", ("gnss", "response"), 3),
    ],
)
def test_a_check_is_fitted_to_what_the_device_declares(
    plan, events_of, fake_device, toy_check, architecture, capabilities, cases
):
    # A class of its own: `isinstance` would remember of the toy check itself that it can be fitted.
    class Fewer(toy_check):
        def fit(self, meets):
            return replace(self, count=2 + len({"gnss", "height"} & meets))

    device = fake_device(architecture=architecture, capabilities=capabilities)
    events, result = events_of(plan(device, Fewer(count=9), searching=False))
    assert [e.cases for e in events if isinstance(e, CheckStarted)] == [cases]
    assert result.checks[0].cases == cases


@pytest.mark.slow
@pytest.mark.parametrize(
    ("fault", "another", "having", "reason"),
    [
        ("gnss-outage", "laser-dropout", {}, "needs gnss"),
        (
            "laser-stuck",
            "encoder-leap",
            {"architecture": "response", "capabilities": ("response",)},
            "laser-stuck: needs a height sensor, which the device does not have",
        ),
    ],
)
def test_a_kept_case_of_a_sensor_is_skipped_without_one(
    plan, result_of, fake_device, monkeypatch, fault, another, having, reason
):
    cases = {case.variation["fault"]: case for case in FaultsCheck().cases(0, Effort.QUICK)}
    kept = KeptCase("kept.json", cases[fault], DeviceClass.NOMINAL)
    alone = replace(FaultsCheck(), meets=frozenset(having.get("capabilities", ("height",))))
    monkeypatch.setattr(type(alone), "cases", lambda *_: (cases[another],))
    (again,) = result_of(plan(fake_device(**having), alone, kept=(kept,), searching=False)).replayed
    assert again["outcome"] == Outcome.SKIP.value
    assert reason in again["reason"]


@pytest.mark.parametrize(("effort", "times"), [(Effort.QUICK, 1), (Effort.CERTIFICATION, 3)])
@pytest.mark.parametrize(
    ("check", "number", "known"),
    [(FaultsCheck(), "fault", SENSOR_FAULTS), (InvarianceCheck(), "change", CHANGES)],
    ids=["faults", "invariance"],
)
def test_every_variation_comes_in_turn_and_the_seed_draws_the_road_alone(
    check, number, known, effort, times
):
    one, other = (check.cases(seed, effort) for seed in (1, 2))
    assert sorted(c.variation[number] for c in one) == sorted(list(known) * times)
    assert len({case.scenario.seed for case in (*one, *other)}) == 2 * len(one)
    for case, again in zip(one, other, strict=True):
        assert case.scenario.seed != again.scenario.seed
        assert replace(case.scenario, seed=0) == replace(again.scenario, seed=0)
        assert Case.of(check.id, case.parameters, case.name) == case
