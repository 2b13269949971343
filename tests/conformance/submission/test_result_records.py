"""A result comes back from JSON bit for bit, and what is none is refused in a line."""

import json
import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref_conformance.checks.nees import PathNees
from floatref_conformance.checks.verdict import CaseResult, Measurement
from floatref_conformance.classes import DeviceClass
from floatref_conformance.submission.agreement import SCORED, agrees, compare_results
from floatref_conformance.submission.result_records import read_result, write_result

TEXTS = st.text(max_size=5)
LENGTHS = st.floats(0.0, 1e6)
LIMITS = st.dictionaries(st.sampled_from(DeviceClass), st.floats(1e-9, 1e9))
MEASUREMENTS = st.builds(
    Measurement, TEXTS, TEXTS, st.floats(), TEXTS, LIMITS, is_flagged_length=st.booleans()
)
RESULTS = st.builds(
    CaseResult,
    TEXTS,
    st.fixed_dictionaries({"scenario": st.just({"seed": 3}), "variation": st.just({"at": 0.1})}),
    st.lists(MEASUREMENTS, max_size=3).map(tuple),
    st.none() | TEXTS,
    st.booleans(),
    st.none() | TEXTS,
    LENGTHS,
    LENGTHS,
    false_alarms=st.integers(0, 5),
    nees=st.lists(st.builds(PathNees, TEXTS, st.floats(0.0, 9.0), st.integers(1, 9))).map(tuple),
)


def copy(result):
    return read_result(json.loads(json.dumps(write_result(result), allow_nan=False)), "here")


@settings(max_examples=30)
@given(RESULTS)
def test_every_figure_comes_back(result):
    again = copy(result)
    assert write_result(again) == write_result(result)
    for before, now in zip(result.measurements, again.measurements, strict=True):
        same = (before.value, before.limits) == (now.value, now.limits)
        assert same or (math.isnan(before.value) and math.isnan(now.value))
    assert list(compare_results(result, again, 0.0)) == []


@given(st.floats(1e-3, 1e3), st.floats(1.0 + 10 * SCORED, 2.0), st.booleans())
def test_a_figure_that_differs_is_named(value, factor, of_limit):
    def make(value, limit):
        measured = Measurement("IRI error", "left", value, "m/km", {DeviceClass.NOMINAL: limit})
        return CaseResult("case", {}, (measured,))

    other = make(value, value * factor) if of_limit else make(value * factor, value)
    (line,) = compare_results(make(value, value), other, SCORED)
    assert "IRI error, track left" in line


@given(st.floats(), st.floats(), st.floats(allow_nan=False))
def test_agreement_goes_both_ways(one, other, scale):
    assert agrees(one, one, scale, 0.0)
    assert agrees(one, other, scale, SCORED) == agrees(other, one, scale, SCORED)


@pytest.mark.parametrize("found", [None, {}, [], {"name": "a"}, "text", 3])
def test_what_is_no_result_is_refused(found):
    with pytest.raises(InputError, match="here: not the result of a case"):
        read_result(found, "here")
