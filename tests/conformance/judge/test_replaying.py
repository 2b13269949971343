"""Replaying one case: numbers that its check does not have are refused, and no others."""

from dataclasses import replace

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref_conformance.case_files import KeptCase
from floatref_conformance.classes import DeviceClass, Effort
from floatref_conformance.judge.replaying import refuse_foreign, replay
from floatref_conformance.plugins import load_registry

CHECKS = load_registry().checks


@pytest.mark.slow
@pytest.mark.parametrize("id_", CHECKS)
@settings(deadline=None, max_examples=15, suppress_health_check=list(HealthCheck))
@given(data=st.data())
def test_whatever_a_check_may_ask_is_a_case_of_it(id_, data):
    check = CHECKS[id_]
    for case in (check.simplest, *check.cases(3, Effort.QUICK), data.draw(check.strategy())):
        refuse_foreign(check, case)


@pytest.mark.parametrize("id_", CHECKS)
def test_a_number_that_a_check_does_not_have_is_refused_before_the_device_is_asked(
    id_, fake_device
):
    check = CHECKS[id_]
    own = check.simplest.variation
    case = replace(check.simplest, variation={**own, "bump_hight_mm": 20.0})
    device = fake_device()
    with pytest.raises(InputError, match=r"^variation bump_hight_mm: unknown; ") as caught:
        replay(device, check, case, check.edition)
    assert "\n" not in str(caught.value)
    assert (device.seen, device.closed) == ([], 1)


def test_a_kept_case_with_a_number_of_no_check_is_skipped(plan, events_of, halving, toy_check):
    check = toy_check(id="braking")
    case = replace(check.simplest, variation={"bump_hight_mm": 20.0})
    kept = (KeptCase("braking-1.json", case, DeviceClass.NOMINAL),)
    _, result = events_of(plan(halving, check, kept=kept, searching=False))
    (replayed,) = result.replayed
    assert replayed["outcome"] == "skip"
    assert replayed["reason"] == "variation bump_hight_mm: unknown; braking has no variation"


def test_a_plug_in_may_have_numbers_that_none_of_its_fixed_cases_has(toy_check):
    check = toy_check()
    refuse_foreign(check, replace(check.simplest, variation={"runs": 2}))
