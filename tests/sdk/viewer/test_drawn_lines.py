"""The arrays of a page: every level has the extremes of its samples; nothing invalid is solid."""

import io
import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from floatref.viewer.drawn_lines import FEWEST_BINS, Line, bins_within, write_line
from floatref.viewer.page_writer import PageWriter

FEW = settings(max_examples=25)
COUNTS = st.integers(1, 3000)


class Kept(PageWriter):
    """A page whose arrays stay as they are."""

    def __init__(self) -> None:
        super().__init__(io.StringIO())
        self.kept: list[np.ndarray] = []

    def add(self, values: Any, form: Any = "<f4") -> int:
        self.kept.append(np.asarray(values, form).astype(np.float64))
        return super().add(values, form)


def check(page: Kept, entry: dict[str, Any], part: str, low: np.ndarray, high: np.ndarray) -> None:
    """Hold a part of every level to the samples it covers, to the precision of 32 bits."""
    known = np.concatenate([low[np.isfinite(low)], high[np.isfinite(high)], [entry["base"]]])
    within = 2e-7 * float(np.abs(known - entry["base"]).max()) + 1e-30
    for level in entry["levels"]:
        lows, highs = (page.kept[number] + entry["base"] for number in level[part])
        for k, first in enumerate(range(0, low.size, level["samples"])):
            inside = slice(first, first + level["samples"])
            if np.isnan(low[inside]).all():
                assert np.isnan([lows[k], highs[k]]).all()
            else:
                assert abs(lows[k] - np.nanmin(low[inside])) <= within
                assert abs(highs[k] - np.nanmax(high[inside])) <= within


@pytest.mark.slow
@given(COUNTS, st.integers(FEWEST_BINS, 2000), st.data())
@FEW
def test_solid_dotted_band_and_marks_are_those_of_the_points(
    count: int, bins: int, data: st.DataObject
) -> None:
    seed = data.draw(st.integers(0, 1000))
    valid = data.draw(arrays(np.bool_, count))
    values = np.random.default_rng(seed).normal(1000.0, 1.0, count)
    values[seed % 7 :: 7] = np.nan
    valid &= np.isfinite(values)
    sigma = np.linspace(0.0, 1.0, count)
    page = Kept()
    entry = write_line(page, Line(values, "left", "distance", valid=valid, sigma=sigma), bins)
    solid = np.where(valid, values, np.nan)
    check(page, entry, "values", solid, solid)
    check(page, entry, "sigma", solid - sigma, solid + sigma)
    dotted = np.where(valid, np.nan, values)
    if np.isfinite(dotted).any():
        check(page, entry, "others", dotted, dotted)
    for level in entry["levels"]:
        marked = page.kept[level["marked"]] if "marked" in level else np.zeros(level["bins"])
        starts = np.arange(0, count, level["samples"])
        np.testing.assert_array_equal(marked > 0, np.logical_or.reduceat(~valid, starts))


@given(COUNTS)
@FEW
def test_places_of_stamped_samples_are_those_of_the_first_of_each_bin(count: int) -> None:
    at = np.cumsum(np.random.default_rng(count).uniform(0.1, 1.0, count))
    page = Kept()
    line = Line(np.zeros(count), "vehicle", "time", at[0], at=at)
    for level in write_line(page, line, FEWEST_BINS)["levels"]:
        expected = at[:: level["samples"]]
        np.testing.assert_allclose(page.kept[level["at"]] + at[0], expected, rtol=1e-14)


@given(
    st.lists(st.tuples(st.integers(1, 10**8), st.integers(9, 33)), min_size=1, max_size=9),
    st.integers(10**6, 10**8),
)
@FEW
def test_bins_are_as_many_as_the_size_allows(sizes: list[tuple[int, int]], most: int) -> None:
    bins = bins_within(sizes, most)
    from floatref.values.parts.extremes import samples_per_bin

    text = sum(-(-n // samples_per_bin(n, bins)) * size for n, size in sizes) * 16 / 15 * 4 / 3
    assert text <= most or bins <= FEWEST_BINS


def test_a_page_has_what_was_written_and_its_licence(read_page: Callable[[Path], Any], tmp_path):
    values = [0.0, float("nan"), 1.5]
    with (tmp_path / "p.html").open("w", encoding="utf-8") as stream:
        page = PageWriter(stream)
        page.open("A <b>title</b> & more")
        assert page.add(values) == 0
        page.close({"text": "</script><script>alert(1)</script>"})
    found = read_page(tmp_path / "p.html")
    np.testing.assert_array_equal(found.arrays[0], np.array(values, np.float32))
    assert found.document["text"] == "</script><script>alert(1)</script>"
    assert "alert(1)</script>" not in found.text
    assert "<title>A &lt;b&gt;title&lt;/b&gt; &amp; more</title>" in found.text
    assert "Permission is hereby granted" in found.text
    assert json.dumps(found.document)


@pytest.mark.parametrize("word", ["http:", "@import", "src="])
def test_nothing_of_a_page_is_loaded_over_a_network(word: str) -> None:
    stream = io.StringIO()
    page = PageWriter(stream)
    page.open("title")
    page.close({})
    lines = [line for line in stream.getvalue().splitlines() if word in line]
    assert not [line for line in lines if "github.com" not in line]
