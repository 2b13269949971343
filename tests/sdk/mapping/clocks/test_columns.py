"""A stream is read once, in bounded memory, and what comes out is what went in, and when."""

import tracemalloc
from collections.abc import Callable, Iterator, Sequence
from fractions import Fraction
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref.mapping import spool as spools
from floatref.mapping.clocks.columns import Wanted, as_they_are, take
from floatref.mapping.spool import Spool
from floatref.values.native import Column, Epoch, NativeClock, Rows, Stream

few = settings(deadline=None, max_examples=50)

Make = Callable[..., Any]
cuts = st.lists(st.integers(0, 200), max_size=5)


def many_pieces(pieces: int, size: int) -> Callable[[Sequence[str]], Iterator[Rows]]:
    def read(names: Sequence[str]) -> Iterator[Rows]:
        for at in range(pieces):
            ticks = np.arange(at * size, (at + 1) * size)
            yield Rows({"row": ticks.astype(np.float64)}, 10 * ticks + ticks % 7)

    return read


@few
@given(
    steps=st.lists(st.integers(0, 9), min_size=1, max_size=200),
    start=st.integers(-(10**6), 10**6),
    cuts=cuts,
    floats=st.booleans(),
    epoch=st.sampled_from(Epoch),
    origin=st.integers(-(10**18), 10**18),
)
def test_every_row_has_its_own_time_whatever_the_pieces(
    steps: list[int],
    start: int,
    cuts: list[int],
    floats: bool,
    epoch: Epoch,
    origin: int,
    reading: Make,
    taken: Make,
    times: Make,
) -> None:
    ticks = start + np.cumsum(np.array(steps, np.int64))
    kind = ticks.astype(np.float64) if floats else ticks
    cuts = [c for c in cuts if c <= ticks.size]
    clock = {"tick_s": Fraction(1, 1000), "epoch": epoch, "origin_ns": origin}
    repeated = ticks.size - np.unique(ticks).size
    stream = reading(kind, cuts, **clock)
    try:
        found = taken(stream)
    except InputError:
        assert repeated > ticks.size / 2
        return
    true = np.array([float(Fraction(origin, 10**9) + Fraction(int(t), 1000)) for t in ticks])
    rows = found.columns[0].astype(int)
    tolerance = 1.001e-3 if found.rate is not None and not floats else 0
    np.testing.assert_allclose(times(found), true[rows], rtol=0, atol=tolerance + 3e-7)
    assert found.warnings == () or repeated
    if found.rate is None:
        assert (np.diff(times(found)) > 0).all() or abs(origin) > 1e15
        assert np.array_equal(np.unique(ticks), ticks[rows])


def test_rows_that_go_back_take_their_samples_with_them(
    reading: Make, taken: Make, times: Make
) -> None:
    ticks = np.arange(0, 3000, 3)
    ticks[[500, 800]] = 7
    found = taken(reading(ticks, [500, 501]), columns=2)
    for column in found.columns:
        np.testing.assert_array_equal(column, np.delete(np.arange(1000.0), [500, 800]))
    np.testing.assert_array_equal(times(found), np.delete(ticks, [500, 800]))
    assert found.warnings == (
        "time goes back in 2 rows, first at row 500, from 1497 to 7; they are dropped",
    )


def test_rows_without_a_time_take_their_samples_with_them(
    reading: Make, taken: Make, times: Make
) -> None:
    ticks = np.arange(1000.0)
    ticks[[0, 1, 400]] = np.nan
    found = taken(reading(ticks, [1]))
    assert found.columns[0].tolist() == np.delete(np.arange(1000.0), [0, 1, 400]).tolist()
    assert times(found).tolist() == np.delete(np.arange(1000.0), [0, 1, 400]).tolist()
    assert found.warnings == ("3 rows have no time; they are dropped",)


def test_repeated_stamps_keep_the_first_of_each(reading: Make, taken: Make) -> None:
    ticks = np.arange(100)
    ticks[50] = 49
    found = taken(reading(ticks, [49, 50]), columns=2)
    assert [c.tolist() for c in found.columns] == [np.delete(np.arange(100.0), 50).tolist()] * 2
    assert found.warnings == ("1 rows repeat the time of another; only the first of each is used",)


def test_a_clock_that_stands_still_is_refused(reading: Make, taken: Make) -> None:
    ticks = np.repeat([0, 5, 11, 19], 25)
    with pytest.raises(InputError, match="96 of 100 rows repeat the time of the one before"):
        taken(reading(ticks))


@pytest.mark.parametrize("more", [1, 10**6])
def test_a_stream_that_ends_early_is_told(more: int, reading: Make, taken: Make) -> None:
    lines = taken(reading(np.arange(100), count=100 + more)).warnings
    assert lines == (f"has 100 of {100 + more} rows; the file is truncated",)
    uniform = reading(None, size=100, count=100 + more, rate=Fraction(10))
    assert taken(uniform).warnings == lines


@pytest.mark.parametrize("ticks", [np.empty(0), np.empty(0, np.int64)])
def test_a_stream_without_rows_is_refused(ticks: np.ndarray, reading: Make, taken: Make) -> None:
    with pytest.raises(InputError, match="stream 's' holds no rows; copy the complete file"):
        taken(reading(ticks))


def test_a_stream_that_yields_nothing_is_refused(taken: Make) -> None:
    stream = Stream("s", (Column("row"),), 5, NativeClock(), lambda names: iter(()))
    with pytest.raises(InputError, match="holds no rows"):
        taken(stream)


@pytest.mark.parametrize(
    "rows",
    [
        Rows({"row": np.zeros(3)}, np.arange(4)),
        Rows({"row": np.zeros((4, 1))}, np.arange(4)),
        Rows({"row": np.float64(1)}, np.arange(4)),
        Rows({"row": np.zeros(4)}, np.arange(4) > 1),
        Rows({"row": np.zeros((2, 2))}, np.zeros((2, 2))),
    ],
)
def test_rows_that_do_not_fit_together_are_refused(rows: Rows, taken: Make) -> None:
    stream = Stream("s", (Column("row"),), 4, NativeClock(), lambda names: iter([rows]))
    with pytest.raises(ValueError, match=r"differ in shape|do not fit"):
        taken(stream)


def test_columns_of_different_length_are_refused_where_a_rate_counts() -> None:
    rows = Rows({"row": np.zeros(4), "b": np.zeros(3)})
    clock = NativeClock(Fraction(5))
    stream = Stream("s", (Column("row"), Column("b")), 4, clock, lambda names: iter([rows]))
    with Spool() as spool, pytest.raises(ValueError, match="column 'b' and its times differ"):
        take(stream, [Wanted("row", as_they_are), Wanted("b", as_they_are)], spool)


def test_a_column_wanted_twice_is_read_once(taken: Make) -> None:
    asked: list[Sequence[str]] = []

    def read(names: Sequence[str]) -> Iterator[Rows]:
        asked.append(names)
        yield Rows({"row": np.arange(3.0)}, np.array([0, 1, 3]))

    stream = Stream("s", (Column("row"),), 3, NativeClock(), read)
    assert len(taken(stream, columns=2).columns) == 2
    assert asked == [["row"]]


def test_progress_goes_up_to_the_number_of_rows(reading: Make) -> None:
    seen: list[int] = []
    with Spool() as spool:
        stream = reading(np.arange(100), [10, 40])
        take(stream, [Wanted("row", as_they_are)], spool, None, seen.append)
    assert seen == [10, 40, 100]


def test_memory_does_not_grow_with_the_file(taken: Make) -> None:
    peaks = []
    for pieces in (8, 64):
        stream = Stream(
            "s", (Column("row"),), pieces << 15, NativeClock(), many_pieces(pieces, 1 << 15)
        )
        tracemalloc.start()
        found = taken(stream)
        peaks.append(tracemalloc.get_traced_memory()[1])
        tracemalloc.stop()
        assert found.columns[0].size == found.times_s.size == pieces << 15
    # One byte for each row, of which repeated ones are marked, against 16 that are read.
    assert peaks[1] - peaks[0] < 2 * (56 << 15)


def test_a_declared_size_beyond_the_disk_is_refused_before_reading(
    monkeypatch: pytest.MonkeyPatch, reading: Make, taken: Make
) -> None:
    monkeypatch.setattr(spools.shutil, "disk_usage", lambda path: SimpleNamespace(free=10**10))
    with pytest.raises(InputError, match=r"needs 16\.0 GB on disk .* set TMPDIR"):
        taken(reading(np.arange(5), count=10**9))
