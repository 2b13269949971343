"""Fractions found again from the floats that they were rounded to."""

from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from floatref_adapters.shared.simplest_ratio import find_simplest


@given(st.integers(-(10**6), 10**6), st.integers(1, 10**6))
def test_a_ratio_of_moderate_numbers_is_found_again(above: int, below: int) -> None:
    assert find_simplest(above / below) == Fraction(above, below)


@given(st.floats(allow_nan=False, allow_infinity=False))
def test_the_fraction_rounds_to_the_float(value: float) -> None:
    found = find_simplest(value)
    assert float(found) == value
    assert found.denominator <= Fraction(value).denominator


@pytest.mark.parametrize("value", [float("nan"), float("inf")])
def test_what_is_not_finite_is_refused(value: float) -> None:
    with pytest.raises((ValueError, OverflowError)):
        find_simplest(value)
