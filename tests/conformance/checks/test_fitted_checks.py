"""A run asks of a device the cases that say something of it, and calls no other one passed."""

from dataclasses import replace

import pytest

from floatref_conformance.case_files import KeptCase
from floatref_conformance.checks.faults.check import FAULTS
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
    plan, events_of, fake_device, toy_check, monkeypatch, architecture, capabilities, cases
):
    def fewer(check, meets):
        return replace(check, count=2 + len({"gnss", "height"} & meets))

    monkeypatch.setattr(toy_check, "fitted", fewer, raising=False)
    device = fake_device(architecture=architecture, capabilities=capabilities)
    events, result = events_of(plan(device, toy_check(count=9), searching=False))
    assert [e.cases for e in events if isinstance(e, CheckStarted)] == [cases]
    assert result.checks[0].cases == cases


@pytest.mark.slow
def test_a_kept_case_of_a_receiver_is_skipped_without_one(
    plan, result_of, fake_device, monkeypatch
):
    cases = {case.variation["fault"]: case for case in FAULTS.cases(0, Effort.QUICK)}
    kept = KeptCase("kept.json", cases["gnss-outage"], DeviceClass.NOMINAL)
    alone = replace(FAULTS, meets=frozenset({"height"}))
    monkeypatch.setattr(type(alone), "cases", lambda *_: (cases["laser-dropout"],))
    result = result_of(plan(fake_device(), alone, kept=(kept,), searching=False))
    (again,) = result.replayed
    assert again["outcome"] == Outcome.SKIP.value
    assert "needs gnss" in again["reason"]


@pytest.mark.slow
def test_a_kept_case_of_a_laser_is_skipped_without_one(plan, result_of, fake_device, monkeypatch):
    cases = {case.variation["fault"]: case for case in FAULTS.cases(0, Effort.QUICK)}
    kept = KeptCase("kept.json", cases["laser-stuck"], DeviceClass.NOMINAL)
    alone = replace(FAULTS, meets=frozenset({"response"}))
    monkeypatch.setattr(type(alone), "cases", lambda *_: (cases["encoder-leap"],))
    device = fake_device(architecture="response", capabilities=("response",))
    (again,) = result_of(plan(device, alone, kept=(kept,), searching=False)).replayed
    assert again["outcome"] == Outcome.SKIP.value
    assert "laser-stuck: needs a height sensor, which the device does not have" in again["reason"]
