"""Clocks that a file states as metadata: the rate is that which was meant, exactly."""

from fractions import Fraction
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from floatref import InputError
from floatref_adapters.shared.stated_clock import read_stated_clock


@given(
    rate=st.builds(Fraction, st.integers(1, 100_000), st.integers(1, 1000)),
    word=st.sampled_from(["rate_hz", "fs", "Sampling_Rate"]),
    step_word=st.sampled_from(["dt", "sampling_interval", "Time_Step"]),
)
def test_a_rate_and_its_step_state_the_same_clock(
    rate: Fraction, word: str, step_word: str
) -> None:
    step = 1 / rate
    for attributes in (
        {word: str(rate)},
        {word: float(rate)},
        {word: np.array([[float(rate)]])},
        {word: str(rate).encode()},
        {step_word: f"{step.numerator}/{step.denominator}"},
        {step_word: float(step)},
    ):
        clock = read_stated_clock(attributes, "here")
        assert clock is not None
        assert clock.rate == rate


def test_the_start_is_in_ticks_that_hold_it_exactly() -> None:
    clock = read_stated_clock({"rate_hz": 100, "T0": "-12.345"}, "here")
    assert clock is not None
    assert clock.first_tick * clock.tick_s == Fraction(-12345, 1000)
    assert read_stated_clock({"t0": 1.0, "units": "m"}, "here") is None


@pytest.mark.parametrize(
    ("attributes", "said"),
    [
        ({"fs": "fast"}, "here: fs is 'fast'; give a number"),
        ({"fs": "1/0"}, "here: fs is '1/0'; give a number"),
        ({"fs": True}, "here: fs is 'True'; give a number"),
        ({"fs": np.nan}, "here: fs is 'nan'; give a number"),
        ({"fs": 0}, "here: rate in Hz is 0; correct it"),
        ({"fs": 2e9}, r"here: rate in Hz is 2e\+09; correct it"),
        ({"dt": -0.1}, "here: step is -0.1; correct it"),
        ({"dt": 2e6}, r"here: step is 2e\+06; correct it"),
        ({"fs": 1, "t0": "1e300"}, r"here: start in s is 1e\+300; correct it"),
    ],
)
def test_what_no_clock_can_be_made_of_is_refused(attributes: dict[str, Any], said: str) -> None:
    with pytest.raises(InputError, match=said):
        read_stated_clock(attributes, "here")
