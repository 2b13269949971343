"""Short texts: bounded, on one line, and no share is rounded to all or to nothing."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from floatref.values.display.short_text import (
    LONGEST_NAME,
    in_mm_or_m,
    join_some,
    percent,
    range_text,
    rate_text,
    share_of,
    shorten,
)


@given(st.text())
def test_a_name_is_short_and_on_one_line(name: str) -> None:
    short = shorten(name)
    assert len(short) <= LONGEST_NAME
    assert short.isprintable()
    if len(name) <= LONGEST_NAME and name.isprintable():
        assert short == name


@given(st.integers(1, 10**9), st.data())
def test_only_nothing_is_0_and_only_all_is_100_per_cent(size: int, data: st.DataObject) -> None:
    count = data.draw(st.integers(0, size))
    shown = percent(count / size)
    assert (shown == "0.0 %") == (count == 0)
    assert (shown == "100.0 %") == (count == size)
    assert abs(float(shown.removesuffix(" %")) - 100.0 * count / size) <= 0.1


@given(st.lists(st.text(min_size=1), max_size=12), st.integers(1, 5))
def test_items_that_are_not_listed_are_counted(items: list[str], most: int) -> None:
    text = join_some(items, most)
    assert text.startswith(", ".join(items[:most]))
    assert text.endswith(f" and {len(items) - most} more") == (len(items) > most)


def test_quantities_have_their_unit() -> None:
    assert in_mm_or_m(0.00508) == "5.08 mm"
    assert in_mm_or_m(1.5) == "1.5 m"
    assert rate_text(16000.0) == "16000 Hz"
    assert rate_text(np.inf) == "–"
    assert range_text(np.array([np.nan, -0.5, 2.0]), "m") == "-0.5 to 2 m"
    assert range_text(np.array([np.nan]), "m") == "–"


def test_the_share_of_nothing_is_0() -> None:
    assert share_of(np.zeros(0, dtype=np.bool_)) == 0.0
    assert share_of(np.array([True, False])) == 0.5
