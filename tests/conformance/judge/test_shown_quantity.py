"""Which quantity the judge's table shows: errors first, flagged lengths where they fail."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref_conformance.checks.faults.fault_scores import measure_fault
from floatref_conformance.checks.faults.injection import Faulty
from floatref_conformance.checks.flags import measure_flags
from floatref_conformance.checks.scoring import Compared
from floatref_conformance.checks.verdict import CaseResult, Measurement, Outcome
from floatref_conformance.classes import DeviceClass, same_limit
from floatref_conformance.errors import SuiteError
from floatref_conformance.judge.judging import check_result
from floatref_conformance.plugins import load_registry
from floatref_conformance.proving_ground.scenario import Scenario

NOMINAL = DeviceClass.NOMINAL
VALUES = st.floats(0.0, 2.0)
CHECK = load_registry().check("stop")
DISTANCE = 0.1 * np.arange(5001)


def error(value, limits=None):
    limits = same_limit(1.0, 1.0) if limits is None else limits
    return Measurement("IRI error", "left", value, "%", limits)


def flagged(value):
    return replace(error(value), quantity="flagged at an end", unit="m", is_flagged_length=True)


def judged(*cases):
    """Return the result of a check with the measurements of each of ``cases``."""
    named = [CaseResult(f"stop-{n}", {}, tuple(case)) for n, case in enumerate(cases, 1)]
    return check_result(CHECK, named, NOMINAL)


def compared(valid):
    zero = np.zeros(DISTANCE.size)
    return Compared("left", DISTANCE, zero, zero, valid, 0.1)


@settings(deadline=None, max_examples=60)
@given(errors=st.lists(VALUES, min_size=1, max_size=4), lengths=st.lists(VALUES, max_size=4))
def test_a_check_that_passes_shows_its_worst_error_and_one_that_fails_what_is_worst(
    errors, lengths
):
    made = judged([*map(flagged, lengths), *map(error, errors)])
    if made.outcome is Outcome.PASS:
        assert (made.shown.quantity, made.shown.value) == ("IRI error", max(errors))
    else:
        assert made.shown is made.worst


def test_a_flagged_length_is_shown_where_no_error_has_a_limit():
    unlimited = error(5.0, {DeviceClass.ADEQUATE: 1.0})
    assert judged([flagged(0.5)], [flagged(0.2)]).shown.value == 0.5
    assert judged([unlimited, flagged(0.5)]).shown.value == 0.5
    assert judged([unlimited]).shown is unlimited


def test_the_case_is_that_of_the_quantity():
    made = judged([flagged(0.9), error(0.1)], [error(0.3)], [flagged(0.5)])
    assert (made.shown.value, made.shown_case) == (0.3, "stop-2")
    assert (made.worst.value, made.worst_case) == (0.9, "stop-1")


def test_nothing_is_shown_where_nothing_was_measured():
    made = judged([])
    assert (made.shown, made.shown_case, made.outcome) == (None, "", Outcome.ERROR)


def test_the_reference_confirms_what_is_shown():
    class Other:
        def value(self, reference):
            return 0.7

    with pytest.raises(SuiteError, match=r"by the reference 0\.7"):
        judged([flagged(0.9), replace(error(0.3), evidence=Other())])


@pytest.mark.parametrize("events", [(), (300.0,)])
def test_the_flagged_lengths_of_a_drive_are_no_errors(events):
    found = measure_flags(compared(DISTANCE > 50.0), Scenario(), events)
    assert [m.is_flagged_length for m in found] == [True, True]


def test_the_flagged_length_beyond_a_fault_is_no_error():
    before, after = compared(DISTANCE >= 0.0), compared(DISTANCE < 0.0)
    (length,) = measure_fault(before, after, Faulty(None, 0.0, 0.0, 0.0), "laser")
    assert length.is_flagged_length
