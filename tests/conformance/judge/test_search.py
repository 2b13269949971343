"""The search: how many cases it draws, which ones, and what becomes of them."""

import sys
from types import ModuleType

import pytest

from floatref.errors import InputError
from floatref_conformance.checks.case import Case
from floatref_conformance.checks.verdict import Outcome, Verdict
from floatref_conformance.classes import Effort
from floatref_conformance.errors import SuiteError
from floatref_conformance.judge.events import CaseFinished, SearchStarted
from floatref_conformance.judge.search import check_installed, search
from floatref_conformance.proving_ground.scenario import Scenario


@pytest.fixture
def drawn(toy_check):
    """Return a function that searches and returns the cases that were tried."""

    def make(seed, count, ratio=lambda case: 0.5, check=None):
        cases = []

        def judge(case):
            cases.append(case)
            return ratio(case)

        search(check or toy_check(), seed, count, judge)
        return cases

    return make


@pytest.mark.parametrize("count", [0, 1, 3, 30, 100])
def test_the_budget_is_a_number_of_cases(drawn, count):
    assert len(drawn(0, count)) == count


def test_a_check_with_fewer_cases_than_the_budget_has_each_tried_once(drawn, toy_check):
    from hypothesis import strategies as st

    class Small(toy_check):
        def strategy(self):
            return st.sampled_from([4, 6, 7]).map(lambda n: Case(self.id, Scenario(seed=n)))

    assert sorted(case.scenario.seed for case in drawn(0, 20, check=Small())) == [4, 6, 7]


def test_the_seed_draws_the_cases(drawn):
    assert drawn(3, 30) == drawn(3, 30)
    (first, *rest), (_, *others) = drawn(3, 9), drawn(4, 9)
    assert set(rest).isdisjoint(others)
    assert first.scenario == Scenario(iri_m_per_km=1.0)


def test_each_check_draws_its_own_cases(drawn, toy_check):
    numbers = [
        {case.scenario for case in drawn(3, 9, check=toy_check(id=id_))} for id_ in ("one", "two")
    ]
    assert len(numbers[0] & numbers[1]) == 1


@pytest.mark.slow
def test_the_modules_that_happen_to_be_imported_are_without_effect(drawn, tmp_path, monkeypatch):
    before = drawn(3, 300)
    numbers = tmp_path / "of_mine.py"
    numbers.write_text(f"NUMBERS = {list(range(777_000, 777_500))}\n")
    module = ModuleType("of_mine")
    module.__file__ = str(numbers)
    monkeypatch.setitem(sys.modules, "of_mine", module)
    assert drawn(3, 300) == before


def test_it_moves_towards_the_limit(drawn):
    def ratio(case):
        return case.scenario.iri_m_per_km / 6.0

    for seed in range(5):
        later = sorted(map(ratio, drawn(seed, 60, ratio)[30:]))
        assert later[len(later) // 2] > 0.8
        assert later[-1] > 0.95


def test_ratios_without_bound_do_not_disturb_it(drawn):
    assert len(drawn(0, 30, lambda case: float("inf") if case.scenario.seed % 2 else 0.0)) == 30


@pytest.mark.parametrize("error", [KeyError("x"), SystemExit(2), SuiteError("no plate")])
def test_what_the_judge_raises_is_raised_at_once(toy_check, error):
    asked = []

    def judge(case):
        asked.append(case)
        if len(asked) == 3:
            raise error
        return 0.0

    with pytest.raises(type(error)) as caught:
        search(toy_check(), 0, 30, judge)
    assert caught.value is error
    assert len(asked) == 3


def test_without_hypothesis_there_is_a_line_that_says_how_to_get_it(monkeypatch):
    monkeypatch.setitem(sys.modules, "hypothesis", None)
    with pytest.raises(InputError, match=r"pip install -e \"\.\[conformance\]\""):
        check_installed()


@pytest.mark.slow
def test_it_finds_a_failure_that_the_seeded_cases_miss(plan, events_of, clipping):
    _, seeded = events_of(plan(clipping, searching=False))
    assert seeded.verdict is Verdict.PASS
    _, result = events_of(plan(clipping, effort=Effort.CERTIFICATION))
    check = result.checks[0]
    assert check.outcome is Outcome.FAIL
    assert check.worst_case.startswith("toy-search-")
    assert check.counterexample["parameters"]["scenario"]["iri_m_per_km"] > 2.4
    assert check.cases == 2 + Effort.CERTIFICATION.searched


def test_a_device_that_cannot_be_asked_anything_else_is_not_searched(plan, events_of, clipping):
    events, result = events_of(plan(clipping, searching=False))
    assert not any(isinstance(e, SearchStarted) for e in events)
    assert result.checks[0].cases == 2


def test_what_the_search_draws_is_named_and_counted_beside_the_seeded_cases(
    plan, events_of, fake_device
):
    events, result = events_of(plan(fake_device()))
    names = [e.result.name for e in events if isinstance(e, CaseFinished)]
    assert names[:2] == ["toy-1", "toy-2"]
    assert all(name.startswith("toy-search-") for name in names[2:])
    assert result.checks[0].cases == len(set(names)) == len(names)


def test_a_case_that_is_drawn_again_is_judged_once(plan, events_of, fake_device, toy_check):
    class Repeating(toy_check):
        def strategy(self):
            from hypothesis import strategies as st

            return st.integers(0, 10**6).map(lambda n: Case(self.id, Scenario(seed=n % 2)))

    device = fake_device()
    _, result = events_of(plan(device, Repeating(), effort=Effort.CERTIFICATION))
    assert result.checks[0].cases == len(device.seen) == 2
