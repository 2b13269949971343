"""Whatever holds real numbers becomes float64, and its owner's array stays as it was."""

from decimal import Decimal
from fractions import Fraction

import numpy as np
import pytest

from floatref.errors import InputError
from floatref.values.plain import above_zero, numbers


@pytest.mark.parametrize(
    "values",
    [
        [1, 2, 3],
        (1.0, Decimal(2), Fraction(3)),
        np.array([1, 2, 3], np.uint8),
        np.array([1, 2, 3], np.float16),
        np.array([1, 2, 3], np.longdouble),
        np.array([1.0, 0.0, 2.0, 0.0, 3.0])[::2],
    ],
)
def test_real_numbers_are_taken(values):
    found = numbers("x", values)
    assert found.dtype == np.float64
    assert found.flags.c_contiguous
    assert found.tolist() == [1.0, 2.0, 3.0]


def test_a_float64_array_is_seen_and_not_frozen():
    given = np.ones((2, 3))
    found = numbers("x", given)
    assert np.shares_memory(given, found)
    assert given.flags.writeable
    assert not found.flags.writeable


@pytest.mark.parametrize("kind", [float, int, object])
def test_what_is_masked_is_missing_whatever_lies_below(kind):
    given = np.ma.array(np.array([1, 2, 3], dtype=kind), mask=[False, True, False])
    np.testing.assert_array_equal(numbers("x", given), [1.0, np.nan, 3.0])
    assert given.data.tolist() == [1, 2, 3]


@pytest.mark.parametrize("value", [np.inf, -np.inf, np.longdouble("1e4000")])
def test_what_is_beyond_float64_is_named(value):
    with pytest.raises(InputError, match=r"^x sample 2 is -?inf; give NaN for a missing one$"):
        numbers("x", np.array([1.0, np.nan, value], dtype=np.longdouble))


@pytest.mark.parametrize("value", [1, 0.5, np.float32(0.5), Fraction(1, 2)])
def test_a_number_above_zero_is_that_number(value):
    assert above_zero("x", value) == value


@pytest.mark.parametrize("value", [0, -1.0, np.nan, np.inf, "1", None, True, 1j, Decimal(1), [1.0]])
def test_anything_else_is_refused_by_name(value):
    with pytest.raises(InputError, match=r"^x is .*above zero$"):
        above_zero("x", value)
