"""A mistyped name is refused with the one that was meant, and a name of nothing with a list."""

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from floatref.values.display.similar_names import (
    did_you_mean,
    hint_at,
    list_names,
    nearest,
    suggest,
)

WORDS = st.text("abcdefgh_", min_size=6, max_size=12)


@given(st.lists(WORDS, min_size=1, max_size=6, unique=True), st.data())
def test_one_wrong_letter_is_a_hint_at_a_name_that_is_known(known: list[str], data) -> None:
    meant = data.draw(st.sampled_from(known))
    at = data.draw(st.integers(0, len(meant) - 1))
    typed = f"{meant[:at]}z{meant[at + 1 :]}"
    assert nearest(typed, known) in known
    if len(known) == 1:
        assert nearest(typed, known) == meant


@given(WORDS, st.lists(st.text("stuvwxy", min_size=3, max_size=9), min_size=1, max_size=99))
def test_a_name_that_is_like_no_other_lists_what_there_is(name: str, known: list[str]) -> None:
    assert did_you_mean(name, known) == hint_at(name, known) == ""
    line = suggest(name, known, "choose from")
    assert line == f"choose from {list_names(known)}"
    assert all(each in line for each in known[:5])
    assert (" more" in line) == (len(known) > 24)


@given(WORDS, st.text("stuvwxy", min_size=1, max_size=30))
def test_a_name_that_goes_on_behind_it_is_meant(beginning: str, rest: str) -> None:
    assume(not beginning.endswith("_"))
    longer = f"{beginning}_{rest}"
    assert nearest(beginning, [f"{beginning[1:]}", longer]) == longer


@pytest.mark.parametrize(
    ("name", "known", "meant"),
    [
        ("lift", ["left", "right"], "left"),
        ("LEFT", ["left", "right"], "left"),
        ("speed", ["seed", "speed_kmh"], "speed_kmh"),
        ("iri", ["seed", "iri_m_per_km"], "iri_m_per_km"),
        ("quarter_car", ["half-car", "quarter-car"], "quarter-car"),
        ("xyz", ["left", "right"], ""),
        ("", ["left", "right"], ""),
        (0, ["left"], ""),
        ("a" * 10_000, ["b" * 10_000], ""),
    ],
)
def test_what_was_meant(name: object, known: list[str], meant: str) -> None:
    assert nearest(name, known) == meant
    assert hint_at(name, known) == (f"; did you mean {meant}?" if meant else "")
