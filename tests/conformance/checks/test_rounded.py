"""Numbers of few digits, and seeds that no two cases share."""

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref_conformance.checks.faults import faulty_drives
from floatref_conformance.checks.rounded import SEED, rounded_numbers, seed_of_its_own
from floatref_conformance.checks.sameness import changed_drives
from floatref_conformance.editions.edition import find_edition


@settings(deadline=None, max_examples=25)
@given(st.data(), st.floats(-50.0, 50.0), st.integers(0, 3))
def test_rounded_numbers_have_no_more_digits_and_stay_within(data, low, digits):
    number = data.draw(rounded_numbers(low, low + 10.0, digits))
    assert round(number, digits) == number
    assert low - 10.0**-digits <= number <= low + 10.0 + 10.0**-digits


@settings(deadline=None, max_examples=25)
@given(st.integers(0, SEED), st.lists(st.floats(0.0, 100.0), min_size=2, unique=True))
def test_the_same_draw_makes_another_seed_for_other_numbers(seed, speeds):
    made = {seed_of_its_own(seed, {"speed_kmh": s}, {"fault": "gap"}) for s in speeds}
    assert len(made) == len(speeds)
    assert all(0 <= one <= SEED for one in made)
    assert seed_of_its_own(seed, {"a": 1, "b": 2}) == seed_of_its_own(seed, {"b": 2, "a": 1})


@pytest.mark.parametrize("drives", [faulty_drives, changed_drives], ids=lambda d: d.CHECK)
def test_no_two_drawn_cases_share_a_road_though_the_same_seed_is_drawn(drives, monkeypatch):
    monkeypatch.setattr(drives, "seeds", lambda: st.just(7))
    cases = set()

    @settings(deadline=None, max_examples=40, database=None)
    @given(drives.case_strategy(find_edition()))
    def collect(case):
        cases.add(case)

    collect()
    assert len({case.scenario.seed for case in cases}) == len(cases) > 5
