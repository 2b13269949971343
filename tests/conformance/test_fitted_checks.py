"""A run asks of a device the cases that say something of it, and calls no other one passed."""

from dataclasses import replace

import pytest

from floatref_conformance.case_files import KeptCase
from floatref_conformance.checks.faults import FAULTS
from floatref_conformance.classes import DeviceClass, Effort
from floatref_conformance.events import CheckStarted
from floatref_conformance.verdict import Outcome


@pytest.mark.parametrize(("capabilities", "cases"), [((), 2), (("gnss",), 3)])
def test_a_check_is_fitted_to_what_the_device_declares(
    plan, events_of, fake_device, toy_check, monkeypatch, capabilities, cases
):
    def fewer(check, capabilities):
        return replace(check, count=3 if "gnss" in capabilities else 2)

    monkeypatch.setattr(toy_check, "fitted", fewer, raising=False)
    device = fake_device(capabilities=capabilities)
    events, result = events_of(plan(device, toy_check(count=9), searching=False))
    assert [e.cases for e in events if isinstance(e, CheckStarted)] == [cases]
    assert result.checks[0].cases == cases


def test_a_kept_case_of_a_receiver_is_skipped_without_one(
    plan, result_of, fake_device, monkeypatch
):
    cases = {case.variation["fault"]: case for case in FAULTS.cases(0, Effort.QUICK)}
    kept = KeptCase("kept.json", cases["gnss-outage"], DeviceClass.NOMINAL)
    alone = replace(FAULTS, capabilities=frozenset())
    monkeypatch.setattr(type(alone), "cases", lambda *_: (cases["laser-dropout"],))
    result = result_of(plan(fake_device(), alone, kept=(kept,), searching=False))
    (again,) = result.replayed
    assert again["outcome"] == Outcome.SKIP.value
    assert "needs gnss" in again["reason"]
