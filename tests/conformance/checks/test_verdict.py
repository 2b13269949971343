"""Outcomes, classes and verdicts."""

from math import inf, nan

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref_conformance.checks.verdict import (
    CaseResult,
    Measurement,
    Outcome,
    Verdict,
    verdict_on,
)
from floatref_conformance.classes import DeviceClass, lowest, same_limit
from floatref_conformance.judge.judging import describe_failure

NEUTRAL = [Outcome.PASS, Outcome.NOT_APPLICABLE]
LEFT_OUT = [Outcome.SKIP, Outcome.WAIVED]
FAILED = [Outcome.FAIL, Outcome.ERROR]


@settings(deadline=None, max_examples=60)
@given(st.lists(st.sampled_from(list(Outcome)), max_size=6))
def test_a_failure_outweighs_what_is_left_out_which_outweighs_a_pass(outcomes):
    verdict = verdict_on(outcomes)
    if any(o in FAILED for o in outcomes):
        assert verdict is Verdict.FAIL
    elif any(o in LEFT_OUT for o in outcomes) or Outcome.PASS not in outcomes:
        assert verdict is Verdict.INCOMPLETE
    else:
        assert verdict is Verdict.PASS
        assert set(outcomes) <= set(NEUTRAL)


def test_exit_codes_are_those_that_other_programs_rely_on():
    assert {v.value: v.exit_code for v in Verdict} == {"PASS": 0, "FAIL": 1, "INCOMPLETE": 4}


def measured(value, nominal=1.0, reference=0.5):
    return Measurement("IRI", "left", value, "m/km", same_limit(nominal, reference))


@settings(deadline=None, max_examples=60)
@given(st.floats(0, 10), st.floats(0.01, 10), st.floats(0.1, 1))
def test_the_class_reached_is_the_strictest_whose_limit_is_kept(value, nominal, share):
    reached = measured(value, nominal, nominal * share).class_reached
    if value > nominal:
        assert reached is None
    elif value > nominal * share:
        assert reached is DeviceClass.ADEQUATE
    else:
        assert reached is DeviceClass.REFERENCE


@pytest.mark.parametrize("value", [0.0, 0.5])
def test_what_a_class_does_not_limit_is_never_worse_than_what_it_does(value):
    above = Measurement("loss", "left", nan, "", {DeviceClass.ADEQUATE: 0.08})
    worst = CaseResult("stop-1", {}, (above, measured(value), above)).worst
    assert worst(DeviceClass.NOMINAL).quantity == "IRI"
    assert worst(DeviceClass.ADEQUATE) is above


@pytest.mark.parametrize(("unit", "shown"), [("", "2, limit 1"), ("m", "2 m, limit 1 m")])
def test_a_failure_is_told_with_the_unit_that_there_is(unit, shown):
    worst = Measurement("loss", "left", 2.0, unit, same_limit(1.0, 0.5))
    assert (
        describe_failure(CaseResult("stop-1", {}, (worst,)), DeviceClass.NOMINAL)
        == f"loss, track left: {shown}"
    )


def test_the_limit_itself_is_kept():
    assert measured(1.0).within(DeviceClass.NOMINAL)
    assert not measured(1.0 + 1e-12).within(DeviceClass.NOMINAL)


@pytest.mark.parametrize("value", [nan, inf])
def test_a_value_that_is_no_number_keeps_no_limit(value):
    assert measured(value).ratio(DeviceClass.NOMINAL) == inf
    assert measured(value).class_reached is None


def test_the_class_of_several_is_the_easiest_and_none_spoils_all():
    a, b = DeviceClass.NOMINAL, DeviceClass.REFERENCE
    assert lowest([b, a, b]) is a
    assert lowest([b, None]) is None
    assert lowest([]) is None
