"""Time stamps that come again at midnight and at a leap second go on as time did."""

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from floatref.mapping.clocks.folded_times import Unfolding
from floatref.measures.clocks.gnss_time import FIRST_DAYS, LEAPS_UNIX_S
from floatref.values.native import Epoch, NativeClock

MS = Fraction(1, 1000)
DAY_MS = 86_400_000
laws = settings(deadline=None, max_examples=60)
steps_ms = st.integers(1, 5000)
cuts = st.lists(st.integers(0, 400), max_size=4)


def unfold(clock: NativeClock, ticks: np.ndarray, at: list[int]) -> tuple[np.ndarray, list[str]]:
    """Return the ticks of a stream that is read in pieces, and the warnings."""
    unfolding = Unfolding(clock)
    pieces = [unfolding(piece) for piece in np.split(ticks, sorted(at))]
    return np.concatenate(pieces), list(unfolding.warnings())


@laws
@given(
    number=st.integers(0, len(FIRST_DAYS) - 1),
    step=steps_ms,
    before=st.integers(1, 300),
    ahead_ms=st.integers(0, 4999),
    seconds=st.sampled_from(["60", "59"]),
    cut=cuts,
    real=st.booleans(),
    origin_s=st.sampled_from([0, 900_000_000]),
)
# The first piece has a single row, and time goes back behind it.
@example(number=0, step=1, before=1, ahead_ms=0, seconds="59", cut=[1], real=False, origin_s=0)
def test_a_leap_second_is_counted_whichever_second_comes_again(
    number: int,
    step: int,
    before: int,
    ahead_ms: int,
    seconds: str,
    cut: list[int],
    real: bool,
    origin_s: int,
) -> None:
    """Some clocks write 23:59:60 as the second behind it, others repeat 23:59:59."""
    leap = 1000 * LEAPS_UNIX_S[number]
    begin = leap - step * before + min(ahead_ms, step - 1)
    passed = begin + step * np.arange(before + 5001 // step + 90)
    back = leap + 1000 if seconds == "60" else leap
    stamps = passed - 1000 * (passed >= back) - 1000 * origin_s
    clock = NativeClock(tick_s=MS, epoch=Epoch.UTC, origin_ns=origin_s * 10**9)
    found, lines = unfold(clock, stamps.astype(np.float64) if real else stamps, cut)
    assert found.dtype.kind == ("f" if real else "i")
    np.testing.assert_array_equal(np.diff(found), step)
    assert lines == [
        f"the leap second before {FIRST_DAYS[number]} is counted: time stamps come again there"
    ]


@laws
@given(start=st.integers(10**12, 2 * 10**12), step=steps_ms, cut=cuts)
def test_stamps_that_go_on_stay_and_a_leap_second_among_them_is_told(
    start: int, step: int, cut: list[int]
) -> None:
    stamps = start + step * np.arange(400)
    found, lines = unfold(NativeClock(tick_s=MS, epoch=Epoch.UTC), stamps, cut)
    np.testing.assert_array_equal(found, stamps)
    within = [
        day
        for s, day in zip(LEAPS_UNIX_S, FIRST_DAYS, strict=True)
        if stamps[0] < 1000 * s <= stamps[-1]
    ]
    assert [line.split()[4] for line in lines] == within
    assert all("may be 1 s off beside GPS time" in line for line in lines)


@pytest.mark.parametrize("epoch", [Epoch.LOCAL, Epoch.DAY, Epoch.GPS])
def test_only_utc_has_leap_seconds(epoch: Epoch) -> None:
    leap = 1000 * LEAPS_UNIX_S[-1]
    stamps = np.concatenate([leap + np.arange(-900, 1000, 100), leap + np.arange(0, 900, 100)])
    found, lines = unfold(NativeClock(tick_s=MS, epoch=epoch), stamps, [])
    assert found is stamps or np.array_equal(found, stamps)
    assert lines == []


@laws
@given(
    start=st.integers(0, DAY_MS - 1),
    step=st.integers(1, 9 * 3_600_000),
    cut=cuts,
    late=st.lists(st.integers(1, 398), max_size=3, unique=True),
)
def test_times_of_a_day_go_on_over_midnights(
    start: int, step: int, cut: list[int], late: list[int]
) -> None:
    """A row that comes late, from before midnight, keeps its day."""
    passed = start + step * np.arange(400)
    for row in late if step < 1000 else ():
        passed[row] -= 2 * step
    clock = NativeClock(tick_s=MS, epoch=Epoch.DAY, turn_s=Fraction(86_400))
    found, lines = unfold(clock, passed % DAY_MS, cut)
    np.testing.assert_array_equal(found - found[0], passed - passed[0])
    assert lines == []


def test_rows_without_a_time_stay_without() -> None:
    clock = NativeClock(tick_s=Fraction(1), turn_s=Fraction(86_400))
    found, _ = unfold(clock, np.array([86_398.0, np.nan, 0.0, np.nan, 2.0]), [2])
    np.testing.assert_array_equal(found, [86_398.0, np.nan, 86_400.0, np.nan, 86_402.0])
