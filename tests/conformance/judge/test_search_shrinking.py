"""Making a failing case simpler: it still fails, within the budget, by what is needed alone."""

from dataclasses import fields, replace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref_conformance.checks.case import CHANNELS_BY_NEED, Case
from floatref_conformance.classes import Effort
from floatref_conformance.errors import DeviceHung
from floatref_conformance.judge.events import CaseFinished
from floatref_conformance.judge.search import simplify
from floatref_conformance.judge.trial import MOST_HANGS
from floatref_conformance.proving_ground.scenario import Scenario

UNLIKE = {
    "seed": 7,
    "road": "measured",
    "iri_m_per_km": 3.0,
    "bump_mm": 20.0,
    "vehicle": "pickup",
    "manoeuvre": "stop",
    "speed_kmh": 60.0,
    "deceleration_g": 0.3,
    "dwell_s": 2.0,
    "stops": 3,
    "grade_percent": 2.0,
    "rate_hz": 4000.0,
}
OWN = {"gap_s": 0.5, "fault": "drop-out", "at_m": 300.0}
BASE = Case("toy", Scenario(), {"fault": "none"})
NAMES = st.frozensets(st.sampled_from([*UNLIKE, *OWN]))


def case_of(names):
    scenario = Scenario(**{name: UNLIKE[name] for name in names if name in UNLIKE})
    return Case("toy", scenario, {**BASE.variation, **{n: OWN[n] for n in names if n in OWN}})


def unlike(case):
    """Return the names of the numbers in which ``case`` differs from `BASE`."""
    own = {*case.variation, *BASE.variation}
    return frozenset(n for n in own if case.variation.get(n) != BASE.variation.get(n)) | frozenset(
        f.name
        for f in fields(Scenario)
        if getattr(case.scenario, f.name) != getattr(BASE.scenario, f.name)
    )


def counted(fails):
    tried = []

    def judge(case):
        tried.append(case)
        return fails(case)

    return judge, tried


@settings(deadline=None, max_examples=100)
@given(NAMES, NAMES)
def test_only_what_the_failure_needs_remains(names, needed):
    """A device that fails by certain numbers together, whatever the others are."""
    needed &= names
    fails, tried = counted(lambda case: needed <= unlike(case))
    found = simplify(case_of(names), BASE, 1000, fails)
    assert unlike(found) == needed
    assert len(tried) == len(set(tried)) <= 3 * len(names)


@pytest.mark.slow
@settings(deadline=None, max_examples=100)
@given(NAMES, st.lists(NAMES.filter(bool), min_size=1, max_size=3))
def test_of_several_failures_one_remains_and_nothing_can_go(names, reasons):
    """Any of several sets of numbers makes it fail: more numbers never make it pass."""

    def failing(present):
        return any(reason <= present for reason in reasons)

    start = names.union(reasons[0])
    left = unlike(simplify(case_of(start), BASE, 1000, lambda case: failing(unlike(case))))
    assert failing(left)
    assert not any(failing(left - {name}) for name in left)


@settings(deadline=None, max_examples=100)
@given(NAMES, st.integers(0, 12), st.randoms(use_true_random=False))
def test_whatever_fails_the_result_failed_and_the_budget_is_kept(names, budget, random):
    start = case_of(names)
    fails, tried = counted(lambda case: random.random() < 0.5)
    answers = {}

    def recorded(case):
        answers[case] = fails(case)
        return answers[case]

    found = simplify(start, BASE, budget, recorded)
    assert len(tried) <= budget
    assert found == start or answers[found]
    assert unlike(found) <= names


def test_what_fails_by_everything_takes_one_case():
    fails, tried = counted(lambda case: True)
    assert simplify(case_of([*UNLIKE, *OWN]), BASE, 12, fails) == BASE
    assert len(tried) == 1


def test_the_simplest_case_of_all_is_not_tried():
    fails, tried = counted(lambda case: True)
    assert simplify(BASE, BASE, 12, fails) == BASE
    assert tried == []


def test_numbers_that_make_no_scenario_together_are_passed_over():
    base = Case("toy", Scenario(speed_kmh=72.0))
    start = Case("toy", Scenario(manoeuvre="dead-start", speed_kmh=0.0, seed=5))

    def fails(case):
        return case.scenario.speed_kmh == 0.0

    found = simplify(start, base, 12, fails)
    assert found.scenario == Scenario(manoeuvre="dead-start", speed_kmh=0.0)


def test_numbers_that_make_no_drive_are_passed_over():
    def fails(case):
        if case.scenario.manoeuvre != "stop":
            raise InputError("cannot be driven")
        return True

    assert unlike(simplify(case_of(UNLIKE), BASE, 100, fails)) == {"manoeuvre"}


def test_channels_follow_from_the_device_and_are_left_alone():
    without = replace(BASE.scenario, **dict.fromkeys(CHANNELS_BY_NEED, False), seed=3)
    fails, tried = counted(lambda case: True)
    found = simplify(replace(BASE, scenario=without), BASE, 12, fails)
    assert found.scenario == replace(without, seed=0)
    assert len(tried) == 1


@pytest.fixture
def odd(toy_check):
    """A check whose only case differs from the simplest in many numbers."""

    class Odd(toy_check):
        def cases(self, seed, effort):
            return (Case(self.id, case_of(UNLIKE).scenario, name="only"),)

    return Odd()


@pytest.fixture
def fickle(fake_device):
    """Return a function that makes a device whose runs end by turns as the words say."""

    class Fickle(fake_device):
        def run(self, recording, profile):
            super().run(recording, profile)
            if self.words[(len(self.seen) - 1) % len(self.words)] == "hangs":
                raise DeviceHung("no answer within 1 s")

        def spoil(self, tracks):
            fails = self.words[(len(self.seen) - 1) % len(self.words)] == "fails"
            return {name: z * (not fails) for name, z in tracks.items()}

    def make(*words):
        device = Fickle()
        device.words, device.spoil = words, lambda tracks: Fickle.spoil(device, tracks)
        return device

    return make


@pytest.mark.parametrize("effort", list(Effort))
def test_a_run_never_tries_more_than_its_budget(plan, events_of, odd, fickle, effort):
    events, result = events_of(plan(fickle("fails", "passes", "passes"), odd, effort=effort))
    judged = [e for e in events if isinstance(e, CaseFinished)]
    assert 1 < len(judged) <= 1 + effort.shrunk
    assert result.checks[0].cases == 1


def test_a_device_that_hangs_on_the_way_leaves_a_case_that_it_was_asked(
    plan, result_of, odd, fickle
):
    device = fickle("fails", "passes", *20 * ["hangs"])
    (check,) = result_of(plan(device, odd)).checks
    assert len(device.seen) == 2 + MOST_HANGS
    assert check.counterexample["reason"] == "no answer within 1 s"
    assert len(check.counterexample["parameters"]["scenario"]) > 1
