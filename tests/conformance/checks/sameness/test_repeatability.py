"""`repeatability` reads by how much two passes differ, and passes no two that show no road."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from tests.conformance.checks import benches

import floatref
from floatref.errors import InputError
from floatref.measures import high_pass
from floatref.values.profile import Profile, ProfileTrack
from floatref_conformance.checks.case import Case
from floatref_conformance.checks.sameness.repeatability import (
    LABELS,
    RepeatabilityCheck,
    move_to_road,
    passes_of,
)
from floatref_conformance.checks.sameness.two_passes import compare_passes
from floatref_conformance.checks.scoring import filter_truth
from floatref_conformance.classes import DeviceClass, Effort
from floatref_conformance.editions.edition import find_edition
from floatref_conformance.errors import DeviceError
from floatref_conformance.judge.oracle import confirm
from floatref_conformance.proving_ground.staging import road_of

FIRST, SECOND = (RepeatabilityCheck(edition=find_edition(name)) for name in ("2026.1", "2026.2"))
BETWEEN, DIFFERENCE, TO_TRUTH = SECOND.limits
CASE = SECOND.simplest
both = pytest.mark.parametrize("check", [FIRST, SECOND], ids=["2026.1", "2026.2"])


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


def read(check=SECOND, **changes):
    measured = check.judge(check.simplest, spoiled(**changes))
    return {name: max(m.value for m in measured if m.quantity == name) for name in check.limits}


def failing(case=CASE, device_class=DeviceClass.NOMINAL, check=SECOND, **changes):
    measured = check.judge(case, spoiled(**changes))
    return {m.quantity for m in measured if not m.within(device_class)}


def times(factor):
    return lambda z: factor * z


@pytest.mark.slow
@both
def test_the_truth_of_both_passes_agrees_whatever_the_vehicle(check):
    for case in (check.simplest, check.cases(3, Effort.QUICK)[1]):
        assert failing(case, DeviceClass.REFERENCE, check) == set()


@pytest.mark.slow
@both
@settings(deadline=None, max_examples=6)
@given(factor=st.floats(0.5, 2.0))
def test_a_second_pass_of_another_height_is_read_in_percent_of_the_rougher(check, factor):
    lost = 1 - min(factor, 1 / factor)
    values = read(check, second=times(factor))
    assert values[DIFFERENCE] == pytest.approx(100 * lost, abs=0.1)
    assert values[TO_TRUTH] == pytest.approx(lost, abs=0.001)
    # On two lines, a pass of another height may also come nearer to the other line's.
    assert values[BETWEEN] <= lost + 0.001
    assert check is SECOND or values[BETWEEN] == pytest.approx(lost, abs=0.001)


@pytest.mark.slow
def test_on_two_lines_true_roads_differ_and_two_passes_without_errors_lose_nothing_more():
    lines = [taken_of(scenario) for scenario in passes_of(CASE)]
    truths = [move_to_road(filter_truth(taken.truth), taken.scenario) for taken in lines]
    for track in ("left", "right"):
        apart = {m.quantity: m.value for m in compare_passes(*truths, track)}
        assert apart[BETWEEN] > 0.01
        assert apart[DIFFERENCE] > 0.1
    assert read(SECOND) == pytest.approx({BETWEEN: 0.0, DIFFERENCE: 0.0, TO_TRUTH: 0.0}, abs=1e-9)


@pytest.mark.slow
def test_a_flat_road_has_no_share_of_its_roughness_and_is_refused():
    numbers = {"road": "flat", "wander_m": 0.0, "wander_within_m": 0.0}
    with pytest.raises(InputError, match="flat; give one with an IRI above 0"):
        failing(replace(CASE, scenario=replace(CASE.scenario, **numbers)))


def test_the_text_says_on_what_lines_the_editions_passes_are():
    assert "take the same path" in FIRST.derivation
    assert "lines of their own" in SECOND.derivation
    assert "beyond the loss between the true roads" in SECOND.derivation
    assert "lines of their own" not in FIRST.derivation


@pytest.mark.slow
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
    measured = FIRST.judge(FIRST.simplest, spoiled(**flat))
    failed = {m.quantity for m in measured if not m.within(DeviceClass.NOMINAL)}
    assert failed == failing(**flat) == {BETWEEN, TO_TRUTH}
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


@pytest.mark.slow
@both
def test_the_passes_of_a_case_meet_one_road_with_other_errors_on_the_editions_lines(check):
    for case in check.cases(0, Effort.CERTIFICATION):
        first, second = passes_of(case)
        assert first.seed != second.seed
        assert {
            name: getattr(second, name) for name in check.edition.wander
        } == check.edition.wander
        alone = [replace(s, wander_m=0.0, wander_within_m=0.0) for s in (first, second)]
        assert same_road(*alone)
        assert same_road(first, second) is (check is FIRST)
        assert Case.of("repeatability", case.parameters, case.name) == case


def same_road(*passes):
    roads = [road_of(scenario, 60.0).elevation["left"] for scenario in passes]
    return np.array_equal(*roads)


@pytest.mark.slow
def test_the_recommended_pipeline_repeats_itself():
    case = FIRST.cases(0, Effort.QUICK)[0]
    name = "temporal-adaptive-hpf-spatial-backward"
    seen = []

    def make(taken, label):
        seen.append(label)
        return floatref.process(taken.recording, name)

    measured = FIRST.judge(case, Bench(make))
    assert all(m.ratio(DeviceClass.NOMINAL) <= 0.7 for m in measured)
    assert tuple(seen) == LABELS
    confirm("repeatability", next(m for m in measured if m.quantity == DIFFERENCE))
