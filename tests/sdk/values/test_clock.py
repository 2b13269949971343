"""Time never accumulates float error, and clocks that cannot be are refused."""

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref.values.clock import StampedClock, UniformClock, rational

RATES = st.floats(0.001, 1e7) | st.fractions(1, 48000, max_denominator=10**6)


@given(RATES, st.integers(0, 10**9), st.integers(1, 1000))
@settings(deadline=None, max_examples=100)
def test_every_time_is_within_rounding_of_the_exact_fraction(
    rate: float | Fraction, first: int, step: int
) -> None:
    clock = UniformClock(rational(rate))
    for index, time in enumerate(clock.times(3, first, step)):
        exact = (first + index * step) / rational(rate)
        assert abs(Fraction(float(time)) - exact) <= exact * Fraction(3, 2**53)


@given(st.floats(0.001, 1e7))
@settings(deadline=None)
def test_a_rate_becomes_a_fraction_that_rounds_to_it(rate: float) -> None:
    assert float(rational(rate)) == rate


@given(st.integers(1, 10**4), st.integers(1, 1000))
@settings(deadline=None)
def test_a_simple_fraction_is_found_behind_its_float(numerator: int, denominator: int) -> None:
    rate = Fraction(numerator, denominator)
    assert rational(float(rate)) == rate


@pytest.mark.parametrize("rate", [0.0, -1.0, 1e12, 1e-9, np.nan, np.inf, -np.inf])
def test_a_rate_that_no_sensor_has_is_refused(rate: float) -> None:
    with pytest.raises(InputError, match=r"rate_hz is .*"):
        UniformClock.of(rate)


@pytest.mark.parametrize("start", [np.nan, np.inf])
def test_a_start_that_is_not_finite_is_refused(start: float) -> None:
    with pytest.raises(InputError, match=r"start_s is .*; it must be finite"):
        UniformClock.of(1.0, start)


def test_a_start_that_no_epoch_explains_is_refused() -> None:
    with pytest.raises(InputError, match=r"start_s is -1e\+308; give times in s, within 1e\+12 s"):
        UniformClock.of(1.0, -1e308)


def test_stamped_times_are_those_given() -> None:
    clock = StampedClock.of([0.0, 0.5, 2.0, 3.0, 7.0])
    assert clock.times(2, 1, 2).tolist() == [0.5, 3.0]
    assert clock.times(5).tolist() == [0.0, 0.5, 2.0, 3.0, 7.0]


@pytest.mark.parametrize(
    ("times", "text"),
    [
        ([0.0, 1.0, 1.0], "time stamp 2 is 1 s, not after 1 s; times must increase"),
        ([0.0, -1.0], "time stamp 1 is -1 s, not after 0 s"),
        ([0.0, np.nan], "time stamp 1 is nan; every sample needs a time"),
        ([np.inf, 1.0], "time stamp 0 is inf; every sample needs a time"),
        ([0.0, 1e308], r"time stamp 1 is 1e\+308 s; give times in s, within 1e\+12 s of zero"),
    ],
)
def test_times_that_do_not_increase_are_refused(times: list[float], text: str) -> None:
    with pytest.raises(InputError, match=text):
        StampedClock.of(times)
