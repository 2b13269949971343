"""The oracle: it confirms what the suite measures rightly, and denies every wrong value."""

from dataclasses import replace
from math import inf, nan

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.measures import iri
from floatref_conformance.checks.evidence import Pair, Roughness
from floatref_conformance.checks.scoring import (
    bridge,
    correlation,
    roughness_percent,
    roughness_within,
)
from floatref_conformance.checks.verdict import Measurement
from floatref_conformance.classes import DeviceClass
from floatref_conformance.errors import SuiteError
from floatref_conformance.judge.oracle import DIMENSIONLESS, SMALLEST, TOLERANCE, confirm

INTERVAL, POINTS = 0.05, 1200
LIMITS = dict.fromkeys(DeviceClass, 1.0)
EITHER = dict.fromkeys(DeviceClass, (5.0, 0.1))


def pair(seed, gain=0.9, shift=3, holes=False):
    """A rough road and what a device made of it: lower, late, and in places not at all."""
    random = np.random.default_rng(seed)
    road = np.cumsum(random.standard_normal(POINTS + shift)) * 2e-3
    truth, result = road[shift:], gain * road[:POINTS] + 1e-4 * random.standard_normal(POINTS)
    counted = np.ones(POINTS - 1, dtype=bool)
    if holes:
        result[400:460] = np.nan
        counted[399:460] = False
    return Pair(truth, bridge(result, truth), INTERVAL, counted)


def roughness(compared, track):
    value = iri(compared.result, INTERVAL)
    return Measurement("IRI", track, value, "m/km", LIMITS, Roughness(compared.result, INTERVAL))


def correlated(compared, track):
    return correlation(compared, track, LIMITS)


def in_percent(compared, track):
    return roughness_percent(compared, track, LIMITS)


def in_m_per_km(compared, track):
    return roughness_within(compared, track, "IRI error", EITHER)


KINDS = pytest.mark.parametrize("measure", [roughness, correlated, in_percent, in_m_per_km])


@pytest.mark.slow
@KINDS
@pytest.mark.parametrize("holes", [False, True])
@settings(deadline=None, max_examples=8)
@given(seed=st.integers(0, 1000), gain=st.floats(0.3, 1.5), shift=st.integers(0, 15))
def test_what_is_measured_rightly_is_confirmed(measure, holes, seed, gain, shift):
    confirm("toy", measure(pair(seed, gain, shift, holes), "left"))


@pytest.mark.slow
@KINDS
@settings(deadline=None, max_examples=8)
@given(seed=st.integers(0, 1000), share=st.floats(-0.5, 0.5).filter(lambda s: abs(s) > 2e-3))
def test_what_is_measured_wrongly_is_the_suites_fault(measure, seed, share):
    right = measure(pair(seed), "left")
    least = SMALLEST.get(right.unit, DIMENSIONLESS)
    wrong = replace(right, value=right.value + share * max(abs(right.value), least))
    with pytest.raises(SuiteError, match=f"check toy, track left: {right.quantity} is"):
        confirm("toy", wrong)


@KINDS
@pytest.mark.parametrize("value", [nan, inf, -inf])
def test_a_value_that_is_no_number_is_not_confirmed(measure, value):
    with pytest.raises(SuiteError):
        confirm("toy", replace(measure(pair(1), "left"), value=value))


@KINDS
def test_a_value_of_another_profile_is_not_confirmed(measure):
    other = measure(pair(4), "left")
    with pytest.raises(SuiteError):
        confirm("toy", replace(measure(pair(1), "left"), evidence=other.evidence))


def test_errors_of_nothing_are_compared_with_the_smallest_that_matters():
    exact = pair(3, gain=1.0, shift=0)
    exact = replace(exact, result=exact.truth)
    for measure, least in ((in_percent, 0.1), (in_m_per_km, 1e-3), (correlated, 1e-3)):
        measured = measure(exact, "left")
        confirm("toy", replace(measured, value=measured.value + 0.9 * TOLERANCE * least))
        with pytest.raises(SuiteError):
            confirm("toy", replace(measured, value=measured.value + 1.1 * TOLERANCE * least))


def test_a_measurement_without_evidence_is_left_alone():
    confirm("toy", Measurement("plate height error", "left", nan, "mm", LIMITS))
