"""`repeatability` reads by how much two passes differ, and passes no two that show no road."""

from functools import cache

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from tests.conformance.checks import benches

import floatref
from floatref.measures import high_pass
from floatref.values.profile import Profile, ProfileTrack
from floatref_conformance.checks.case import Case
from floatref_conformance.checks.sameness.repeatability import LABELS, RepeatabilityCheck, passes_of
from floatref_conformance.classes import DeviceClass, Effort
from floatref_conformance.errors import DeviceError
from floatref_conformance.judge.oracle import confirm
from floatref_conformance.proving_ground.staging import road_of

BETWEEN, DIFFERENCE, TO_TRUTH = RepeatabilityCheck().limits
CASE = RepeatabilityCheck().simplest


class Bench:
    """Simulates each pass once; ``make`` of it and its label is the profile."""

    def __init__(self, make):
        self.make = make

    def simulate(self, scenario):
        return taken_of(scenario)

    def run(self, taken, label=""):
        return self.make(taken, label)


taken_of = cache(benches.taken_of)


def spoiled(**changes):
    """Return a device that knows the truth, and gets ``first`` or ``second`` of it wrong."""

    def make(taken, label):
        change = changes.get(label.split()[0], lambda z: z)
        interval = taken.truth.interval_m
        tracks = tuple(
            ProfileTrack.of(t.name, change(high_pass(t.elevation, interval)))
            for t in taken.truth.tracks
        )
        return Profile(interval, tracks)

    return Bench(make)


def read(case=CASE, **changes):
    measured = RepeatabilityCheck().judge(case, spoiled(**changes))
    return {
        name: max(m.value for m in measured if m.quantity == name)
        for name in RepeatabilityCheck().limits
    }


def failing(case=CASE, device_class=DeviceClass.NOMINAL, **changes):
    measured = RepeatabilityCheck().judge(case, spoiled(**changes))
    return {m.quantity for m in measured if not m.within(device_class)}


def times(factor):
    return lambda z: factor * z


@pytest.mark.slow
@pytest.mark.parametrize("case", [CASE, RepeatabilityCheck().cases(3, Effort.QUICK)[1]])
def test_the_truth_of_both_passes_agrees_whatever_the_vehicle(case):
    assert failing(case, DeviceClass.REFERENCE) == set()


@pytest.mark.slow
@settings(deadline=None, max_examples=6)
@given(factor=st.floats(0.5, 2.0))
def test_a_second_pass_of_another_height_is_read_in_percent_of_the_rougher(factor):
    lost = 1 - min(factor, 1 / factor)
    values = read(second=times(factor))
    assert values[DIFFERENCE] == pytest.approx(100 * lost, abs=0.1)
    assert values[BETWEEN] == pytest.approx(lost, abs=0.001)
    assert values[TO_TRUTH] == pytest.approx(lost, abs=0.001)


def test_passes_that_each_keep_within_the_limits_of_accuracy_can_differ_too_much():
    changes = {"first": times(1.035), "second": times(0.965)}
    assert failing(**changes) == {DIFFERENCE}


def test_two_passes_that_show_the_same_wrong_road_fail_against_the_truth():
    other = np.random.default_rng(1).normal(size=200_000).cumsum() * 1e-5

    def elsewhere(z):
        return other[: z.size]

    assert failing(first=elsewhere, second=elsewhere) == {TO_TRUTH}


@pytest.mark.slow
def test_two_flat_passes_fail_and_the_oracle_finds_the_same():
    flat = {"first": times(0.0), "second": times(0.0)}
    measured = RepeatabilityCheck().judge(CASE, spoiled(**flat))
    assert {m.quantity for m in measured if not m.within(DeviceClass.NOMINAL)} == {
        BETWEEN,
        TO_TRUTH,
    }
    confirm("repeatability", measured[0])


def test_a_smoothed_pass_loses_correlation():
    def smooth(z):
        return np.convolve(z, np.full(400, 1 / 400), "same")

    assert failing(second=smooth) >= {BETWEEN, TO_TRUTH}


@pytest.mark.parametrize("which", ["first", "second"])
def test_a_point_without_elevation_is_an_error(which):
    def holed(z):
        return np.where(np.arange(z.size) == 60_000, np.nan, z)

    with pytest.raises(DeviceError, match="points without elevation"):
        read(**{which: holed})


@pytest.mark.parametrize("case", RepeatabilityCheck().cases(0, Effort.CERTIFICATION))
def test_the_passes_of_a_case_meet_one_road_with_other_errors(case):
    first, second = passes_of(case)
    assert first.seed != second.seed
    roads = [road_of(s, 100.0) for s in (first, second)]
    assert np.array_equal(roads[0].elevation["left"], roads[1].elevation["left"])
    assert Case.of("repeatability", case.parameters, case.name) == case


@pytest.mark.slow
def test_the_recommended_pipeline_repeats_itself():
    case = RepeatabilityCheck().cases(0, Effort.QUICK)[0]
    name = "temporal-adaptive-hpf-spatial-backward"
    seen = []

    def make(taken, label):
        seen.append(label)
        return floatref.process(taken.recording, name)

    measured = RepeatabilityCheck().judge(case, Bench(make))
    assert all(m.ratio(DeviceClass.NOMINAL) <= 0.7 for m in measured)
    assert tuple(seen) == LABELS
    confirm("repeatability", next(m for m in measured if m.quantity == DIFFERENCE))
