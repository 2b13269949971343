"""Looking a piece at a time finds what looking at the whole finds."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as npst

from floatref.values import scanning
from floatref.values.scanning import (
    chunks,
    every,
    first_step_where,
    first_where,
    longest_gap,
    longest_step,
    median_step,
    stretch_edges,
    take,
)

SAMPLES = npst.arrays(
    np.float64,
    st.integers(1, 40),
    elements=st.sampled_from([np.nan, 0.0, 1.0, -2.5, 7.0]),
)
PIECES = settings(deadline=None, max_examples=80)


@pytest.fixture(autouse=True, scope="module")
def small_chunks() -> object:
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(scanning, "CHUNK", 4)
        yield


@given(SAMPLES)
@PIECES
def test_the_chunks_in_turn_are_the_whole(values: np.ndarray) -> None:
    whole = np.concatenate([chunk for _, chunk in chunks(values)])
    np.testing.assert_array_equal(whole, values)
    for first, chunk in chunks(values, overlap=1):
        np.testing.assert_array_equal(chunk, values[first : first + 5])


@given(SAMPLES, st.integers(1, 50))
@PIECES
def test_every_so_many_samples_are_those_of_the_whole(values: np.ndarray, stride: int) -> None:
    np.testing.assert_array_equal(every(stride, values), values[::stride])


STEPS = st.one_of(st.sampled_from([0.25, 1e-3]), st.floats(1e-300, 1e6))


@pytest.mark.slow
@given(st.lists(STEPS, min_size=1, max_size=40))
@PIECES
def test_median_and_longest_step_are_those_of_the_whole(steps: list[float]) -> None:
    times = np.unique(np.cumsum([0.0, *steps]))
    whole = np.diff(times)
    assert median_step(times) == np.median(whole)
    assert longest_step(times) == (np.argmax(whole), whole.max())


@given(SAMPLES)
@PIECES
def test_the_first_sample_and_step_are_those_of_the_whole(values: np.ndarray) -> None:
    places = [k for k in range(values.size) if np.isnan(values[k])]
    assert first_where(np.isnan, values) == (places[0] if places else None)
    falls = [k for k in range(1, values.size) if values[k] < values[k - 1]]
    assert first_step_where(lambda steps: steps < 0, values) == (falls[0] if falls else None)


@given(SAMPLES)
@PIECES
def test_the_longest_gap_is_that_of_the_text(values: np.ndarray) -> None:
    text = "".join("x" if np.isnan(value) else " " for value in values)
    longest = max(text.split(" "), key=len)
    assert longest_gap(values) == (text.index(longest) if longest else 0, len(longest))


@given(st.lists(st.integers(0, 4999), max_size=3000))
@settings(max_examples=10)
def test_samples_are_taken_where_they_are(index: list[int]) -> None:
    values = np.random.default_rng(0).normal(size=5000)
    chosen = np.array(index, dtype=np.int64)
    np.testing.assert_array_equal(take(values, chosen), values[chosen])


@given(flags=npst.arrays(np.bool_, st.integers(0, 40)))
@PIECES
def test_edges_are_those_of_the_whole(flags):
    whole = np.flatnonzero(np.diff(flags, prepend=False, append=False))
    np.testing.assert_array_equal(stretch_edges(flags), whole)
