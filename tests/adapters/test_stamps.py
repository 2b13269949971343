"""The clock behind rounded time stamps."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref import InputError, StampedClock, UniformClock
from floatref_adapters.stamps import clock_of, decimals_of

few = settings(deadline=None, max_examples=60)


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
    clock = clock_of(stamps, decimals)
    assert isinstance(clock, UniformClock)
    np.testing.assert_allclose(clock.times(count), true, rtol=0, atol=1.6 * 10.0**-decimals + 1e-10)


@few
@given(
    rate=st.sampled_from([100.0, 128.0, 1000.0, 3240.0, 4000.0, 16000.0, 12.5]),
    start=st.integers(-1000, 86_400).map(lambda x: x / 8),
)
def test_a_round_rate_is_found_exactly(rate: float, start: float) -> None:
    stamps = np.round(start + np.arange(3000) / rate, 6)
    clock = clock_of(stamps, 6)
    assert isinstance(clock, UniformClock)
    assert clock.rate == rate


def test_a_third_of_a_second_is_not_taken_for_a_rate_that_it_is_not() -> None:
    clock = clock_of(np.round(np.arange(3000) / 3, 3), 3)
    assert isinstance(clock, UniformClock)
    assert clock.rate == 3


@few
@given(at=st.integers(1, 98), late=st.floats(2.5e-3, 9e-3))
def test_a_late_stamp_keeps_all_stamps(at: int, late: float) -> None:
    stamps = np.round(np.arange(100) / 100, 3)
    stamps[at] += late
    clock = clock_of(stamps, 3)
    assert isinstance(clock, StampedClock)
    np.testing.assert_array_equal(clock.times_s, stamps)


def test_stamps_that_go_back_are_refused() -> None:
    with pytest.raises(InputError, match="times must increase"):
        clock_of(np.array([0.0, 0.1, 0.05, 0.2]), 2)


@pytest.mark.parametrize(
    ("text", "decimals"),
    [
        ("12", 0),
        ("12.", 0),
        ("0.0625", 4),
        ("6.25e-05", 7),
        ("1.5E2", -1),
        ("0e-9999", 300),
        ("0e9999", -300),
    ],
)
def test_decimals_are_counted_with_the_exponent(text: str, decimals: int) -> None:
    assert decimals_of(text) == decimals


def test_stamps_closer_than_any_clock_ticks_stay_stamps() -> None:
    assert isinstance(clock_of(np.array([0.0, 1e-320]), 320), StampedClock)


@pytest.mark.parametrize("at", [1, 100, 198])
def test_swapped_and_repeated_stamps_of_whole_milliseconds_are_refused(at: int) -> None:
    swapped, repeated = (np.arange(200) / 1000.0 for _ in range(2))
    swapped[[at, at - 1]] = swapped[[at - 1, at]]
    repeated[at] = repeated[at - 1]
    for stamps in (swapped, repeated):
        with pytest.raises(InputError, match="times must increase"):
            clock_of(stamps, 3)


def test_a_row_that_is_missing_is_no_constant_rate() -> None:
    stamps = np.delete(np.arange(200) / 1000.0, 100)
    clock = clock_of(stamps, 3)
    assert isinstance(clock, StampedClock)
    np.testing.assert_array_equal(clock.times_s, stamps)


@pytest.mark.parametrize("rate", [700.0, 3240.0, 16_000.0])
def test_stamps_coarser_than_the_samples_keep_their_rate(rate: float) -> None:
    stamps = np.round(np.arange(5000) / rate, 3)
    clock = clock_of(stamps, 3)
    assert isinstance(clock, UniformClock)
    assert float(clock.rate) == pytest.approx(rate, rel=1e-3)
