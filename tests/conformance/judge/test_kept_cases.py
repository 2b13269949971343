"""Cases kept from earlier runs: run again, listed, and part of the verdict."""

import pytest

from floatref_conformance.case_files import KeptCase
from floatref_conformance.checks.case import Case
from floatref_conformance.checks.verdict import Outcome, Verdict
from floatref_conformance.classes import DeviceClass
from floatref_conformance.errors import DeviceError, DeviceSkipped
from floatref_conformance.judge.events import CaseReplayed, CheckFinished
from floatref_conformance.proving_ground.scenario import Scenario

SMOOTH, ROUGH = Scenario(seed=1, iri_m_per_km=1.0), Scenario(seed=1, iri_m_per_km=6.0)


def kept(check, scenario=SMOOTH, device_class=DeviceClass.NOMINAL, **variation):
    return KeptCase(f"{check}-1.json", Case(check, scenario, variation, "kept"), device_class)


def outcomes(result):
    return {replayed["file"]: replayed["outcome"] for replayed in result.replayed}


def test_kept_cases_are_run_after_the_others_and_listed(plan, events_of, fake_device):
    events, result = events_of(plan(fake_device(), kept=(kept("toy", runs=2),)))
    assert result.verdict is Verdict.PASS
    assert [type(e) for e in events[-3:-1]] == [CaseReplayed, CheckFinished]
    (replayed,) = result.replayed
    assert replayed == events[-3].replayed
    assert replayed["outcome"] == "pass"
    assert replayed["value"] <= replayed["limit"] == 0.1
    assert replayed["unit"] == "m/km"


def test_a_kept_case_that_still_fails_makes_a_run_fail_whose_checks_all_pass(
    plan, result_of, clipping
):
    result = result_of(plan(clipping, searching=False, kept=(kept("toy", ROUGH), kept("toy"))))
    assert [c.outcome for c in result.checks] == [Outcome.PASS]
    assert [r["outcome"] for r in result.replayed] == ["fail", "pass"]
    assert "limit 0.1 m/km" in result.replayed[0]["reason"]
    assert result.verdict is Verdict.FAIL


def test_a_kept_case_is_judged_by_the_class_of_the_run(plan, result_of, fake_device):
    device = fake_device(lambda tracks: {name: 0.99 * z for name, z in tracks.items()})
    again = (kept("toy", ROUGH, DeviceClass.REFERENCE),)
    for device_class, outcome in zip(DeviceClass, ("pass", "pass", "fail"), strict=True):
        result = result_of(plan(device, kept=again, device_class=device_class))
        assert outcomes(result) == {"toy-1.json": outcome}


@pytest.mark.parametrize(
    ("error", "outcome", "verdict"),
    [
        (DeviceError("crashed"), "error", Verdict.FAIL),
        (DeviceSkipped("crashed"), "skip", Verdict.INCOMPLETE),
    ],
)
def test_a_kept_case_that_crashes_or_is_skipped_says_so(
    plan, result_of, raising, error, outcome, verdict
):
    device = raising(error, lambda number: number == 3)
    result = result_of(plan(device, searching=False, kept=(kept("toy"),)))
    (replayed,) = result.replayed
    assert (replayed["outcome"], replayed["reason"]) == (outcome, "crashed")
    assert (replayed["value"], replayed["limit"], replayed["unit"]) == (None, None, None)
    assert result.verdict is verdict


def test_kept_cases_of_checks_that_are_not_run_are_listed_as_skipped(
    plan, result_of, fake_device, toy_check
):
    needy = toy_check(id="needy", needs=frozenset({"gnss"}))
    again = tuple(map(kept, ("needy", "other", "gone")))
    result = result_of(plan(fake_device(), toy_check(), needy, left_out=("other",), kept=again))
    assert outcomes(result) == {
        "needy-1.json": "not-applicable",
        "other-1.json": "skip",
        "gone-1.json": "skip",
    }
    reasons = {r["check"]: r["reason"] for r in result.replayed}
    assert reasons["other"] == "not selected"
    assert reasons["gone"] == "unknown check"
    assert "gnss" in reasons["needy"]


def test_a_kept_case_of_a_check_that_is_gone_leaves_a_pass_incomplete(plan, result_of, fake_device):
    result = result_of(plan(fake_device(), kept=(kept("gone"),)))
    assert result.verdict is Verdict.INCOMPLETE


def test_kept_numbers_that_make_no_drive_any_more_are_skipped(
    plan, result_of, fake_device, toy_check
):
    class Driven(toy_check):
        def judge(self, case, bench):
            if case.name == "kept":
                bench.simulate(case.scenario)
            return super().judge(case, bench)

    undrivable = Scenario(manoeuvre="braking", event_speed_kmh=90.0)
    result = result_of(plan(fake_device(), Driven(), kept=(kept("toy", undrivable),)))
    (replayed,) = result.replayed
    assert replayed["outcome"] == "skip"
    assert "manoeuvre braking" in replayed["reason"]
    assert result.verdict is Verdict.INCOMPLETE


def test_a_waiver_holds_for_the_kept_cases_of_its_check_too(plan, result_of, halving, toy_check):
    checks = (toy_check(), toy_check(id="second"))
    again = (kept("toy"), kept("second"))
    result = result_of(plan(halving, *checks, kept=again, waivers={"toy": "known"}))
    assert {c.id: c.outcome for c in result.checks} == {"toy": "waived", "second": "fail"}
    assert outcomes(result) == {"toy-1.json": "waived", "second-1.json": "fail"}
    alone = result_of(plan(halving, kept=(kept("toy"),), waivers={"toy": "known"}))
    assert alone.verdict is Verdict.INCOMPLETE


def test_a_waiver_covers_no_kept_case_that_crashes(plan, result_of, raising):
    device = raising(DeviceError("crashed"), lambda number: number == 3)
    again, waivers = (kept("toy"),), {"toy": "known"}
    result = result_of(plan(device, searching=False, kept=again, waivers=waivers))
    assert outcomes(result) == {"toy-1.json": "error"}
    assert result.verdict is Verdict.FAIL


def test_a_kept_case_is_waived_though_its_check_passes(plan, result_of, clipping):
    waivers = {"toy": "tops are lost"}
    again = (kept("toy", ROUGH),)
    result = result_of(plan(clipping, searching=False, kept=again, waivers=waivers))
    assert result.checks[0].outcome is Outcome.PASS
    assert outcomes(result) == {"toy-1.json": "waived"}
    assert result.verdict is Verdict.INCOMPLETE
