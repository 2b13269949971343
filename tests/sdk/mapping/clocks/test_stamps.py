"""The clock behind rounded time stamps, and the rows that come too late."""

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref.mapping.clocks.stamps import Advancing, as_ticks, uniform_clock, warn_of_leap
from floatref.values.clock import UniformClock
from floatref.values.scanning import CHUNK

few = settings(deadline=None, max_examples=80)
MS = 1e-3


@few
@given(
    rate=st.floats(1.0, 50_000.0),
    start=st.floats(-1e4, 1e5),
    count=st.integers(2, 400),
    decimals=st.integers(3, 9),
)
def test_rounded_stamps_of_a_constant_rate_are_a_uniform_clock(
    rate: float, start: float, count: int, decimals: int
) -> None:
    true = start + np.arange(count) / rate
    stamps = np.round(true, decimals)
    if stamps[-1] == stamps[0] or 0.98 <= 10.0**decimals / rate < 1.2:
        return
    clock = uniform_clock(stamps, 10.0**-decimals)
    assert clock is not None
    np.testing.assert_allclose(clock.times(count), true, rtol=0, atol=1.6 * 10.0**-decimals + 1e-10)


@few
@given(
    rate=st.sampled_from([100.0, 128.0, 1000.0, 3240.0, 4000.0, 16000.0, 12.5]),
    start=st.integers(-1000, 86_400).map(lambda x: x / 8),
)
def test_a_round_rate_is_found_exactly(rate: float, start: float) -> None:
    clock = uniform_clock(np.round(start + np.arange(3000) / rate, 6), 1e-6)
    assert clock is not None
    assert clock.rate == rate


@few
@given(rate=st.floats(0.01, 1e6), start=st.floats(-1e6, 1e9), count=st.integers(2, 300))
def test_floats_of_a_constant_rate_need_no_unit(rate: float, start: float, count: int) -> None:
    times = start + np.arange(count) / rate
    if not (np.diff(times) > 0).all():
        return
    clock = uniform_clock(times, 0.0)
    if clock is not None:
        off = np.abs(clock.times(count) - times).max()
        assert off <= 8 * np.spacing(np.abs(times).max())
    else:
        # Too few digits are left of a step for a rate to be one.
        assert 1 / rate < 64 * np.spacing(np.abs(times).max())


def test_a_third_of_a_second_is_not_taken_for_a_rate_that_it_is_not() -> None:
    clock = uniform_clock(np.round(np.arange(3000) / 3, 3), MS)
    assert clock is not None
    assert clock.rate == 3


@few
@given(at=st.integers(1, 98), late=st.floats(2.5e-3, 9e-3))
def test_a_late_stamp_is_of_no_uniform_clock(at: int, late: float) -> None:
    stamps = np.round(np.arange(100) / 100, 3)
    stamps[at] += late
    assert uniform_clock(stamps, MS) is None


@pytest.mark.parametrize("at", [1, 100, 198])
def test_a_row_that_is_missing_or_repeated_is_no_constant_rate(at: int) -> None:
    stamps = np.arange(200) / 1000.0
    assert uniform_clock(np.delete(stamps, at), MS) is None
    stamps[at] = stamps[at - 1]
    assert uniform_clock(stamps, MS) is None


@pytest.mark.parametrize("at", [CHUNK - 1, CHUNK, CHUNK + 1])
def test_a_row_that_is_missing_where_two_pieces_meet_is_seen(at: int) -> None:
    stamps = np.arange(CHUNK + 1000) / 1000.0
    assert uniform_clock(stamps, MS) == UniformClock.of(1000.0)
    assert uniform_clock(np.delete(stamps, at), MS) is None


@pytest.mark.parametrize("rate", [700.0, 3240.0, 16_000.0])
def test_stamps_coarser_than_the_samples_keep_their_rate(rate: float) -> None:
    clock = uniform_clock(np.round(np.arange(5000) / rate, 3), MS)
    assert clock is not None
    assert float(clock.rate) == pytest.approx(rate, rel=1e-3)


@pytest.mark.parametrize(
    "times",
    [[0.0], [1.0, 1.0], [0.0, 1e-320], [0.0, 5e3], [0.0, 1e-8], [-1e300, 1e300], [0.0, 1e12]],
)
def test_what_ticks_like_no_clock_is_none(times: list[float]) -> None:
    assert uniform_clock(np.array(times), MS) is None


@few
@given(step=st.floats(1e-9, 1e5), count=st.integers(2, 5), unit=st.sampled_from([0.0, 1e-9, MS]))
def test_the_rate_of_a_clock_that_is_found_is_one_that_a_recording_may_have(
    step: float, count: int, unit: float
) -> None:
    clock = uniform_clock(step * np.arange(count), unit)
    assert clock is None or Fraction(1, 1000) <= clock.rate <= 10_000_000


def kept_by_a_loop(ticks: list[float]) -> tuple[list[bool], int, int]:
    """Return which of ``ticks`` are kept, how many went back, and how many were no time."""
    kept, back, untimed, latest = [], 0, 0, -np.inf
    for tick in ticks:
        known = bool(np.isfinite(tick))
        kept.append(known and tick >= latest)
        untimed += not known
        back += known and tick < latest
        latest = max(latest, tick) if known else latest
    return kept, back, untimed


integers = st.lists(st.integers(-100, 100), max_size=60)
floats = st.lists(
    st.one_of(st.floats(-100, 100), st.sampled_from([np.nan, np.inf, -np.inf])), max_size=60
)


@few
@given(ticks=st.one_of(integers, floats), cuts=st.lists(st.integers(0, 60), max_size=6))
def test_rows_are_kept_unless_one_before_them_was_later(
    ticks: list[float], cuts: list[int]
) -> None:
    whole = all(isinstance(tick, int) for tick in ticks)
    array = np.array(ticks, np.int64 if whole else np.float64)
    advancing = Advancing()
    pieces = np.split(array, sorted(c for c in cuts if c <= array.size))
    found = np.concatenate([advancing(piece) for piece in pieces])
    kept, back, untimed = kept_by_a_loop(ticks)
    assert found.tolist() == kept
    assert (advancing.back, advancing.untimed, advancing.rows) == (back, untimed, len(ticks))


@pytest.mark.parametrize("kind", [np.int64, np.float64])
def test_rows_at_the_ends_of_what_a_tick_can_be_are_kept(kind: type) -> None:
    info = np.iinfo(kind) if kind is np.int64 else np.finfo(kind)
    advancing = Advancing()
    assert advancing(np.array([info.min, 0, info.max], kind)).all()
    assert not advancing(np.array([0], kind)).any()


@pytest.mark.parametrize(
    "kind", [np.uint8, np.uint32, np.uint64, np.int8, np.int16, np.int32, np.float32]
)
def test_ticks_of_any_width_are_the_same(kind: type) -> None:
    ticks = as_ticks(np.array([1, 2, 2, 1, 100], kind))
    assert ticks.dtype in (np.int64, np.float64)
    assert Advancing()(ticks).tolist() == [True, True, True, False, True]


@pytest.mark.parametrize(
    "ticks",
    [
        np.array([1 << 63], np.uint64),
        np.array([True]),
        np.array(["1"]),
        np.array([1], "datetime64[s]"),
        np.array([object()]),
        np.array([1j]),
        np.zeros((2, 2)),
        np.array(5),
    ],
)
def test_ticks_that_are_no_numbers_are_refused(ticks: np.ndarray) -> None:
    with pytest.raises(ValueError, match=r"ticks of .* do not fit"):
        as_ticks(ticks)


def warnings_of(ticks: np.ndarray) -> list[str]:
    advancing = Advancing()
    for piece in np.split(ticks, [ticks.size // 2]):
        advancing(piece)
    return list(advancing.warnings())


def test_a_few_rows_that_go_back_are_dropped_and_told() -> None:
    ticks = np.arange(1000)
    ticks[600] = 500
    ticks[900] = 3
    lines = warnings_of(ticks)
    assert lines == [
        "time goes back in 2 rows, first at row 600, from 599 to 500; they are dropped"
    ]


@pytest.mark.parametrize("second", [np.arange(500), np.arange(500) - 10**9])
def test_a_clock_that_was_set_back_is_refused(second: np.ndarray) -> None:
    with pytest.raises(InputError, match=r"time goes back in 500 of 1000 rows, first at row 500"):
        warnings_of(np.concatenate([np.arange(500) + 10**6, second]))


def test_one_wild_stamp_that_hides_all_the_rest_is_refused() -> None:
    ticks = np.arange(1000)
    ticks[10] = 10**15
    with pytest.raises(InputError, match=r"first at row 11, from 1e\+15 to 11; the clock was set"):
        warnings_of(ticks)


@pytest.mark.parametrize(("step", "warned"), [(3599, False), (3601, True), (1.7e9, True)])
def test_a_clock_that_comes_to_another_epoch_is_told(step: float, warned: bool) -> None:
    times = np.concatenate([np.arange(50.0), 49 + step + np.arange(50.0)])
    line = warn_of_leap(times)
    assert (line is not None) == warned
    if line is not None:
        assert line.startswith(f"no rows for {step:.6g} s after row 49; if the clock was set")
    assert warn_of_leap(times[:1]) is None


def test_rows_without_a_time_are_told() -> None:
    ticks = np.arange(1000.0)
    ticks[[3, 700]] = np.nan, np.inf
    assert warnings_of(ticks) == ["2 rows have no time; they are dropped"]
