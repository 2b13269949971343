"""What is a number in a table."""

import pytest

from floatref_adapters.formats.csv_table.table_fields import parse

DIGITS = "1" * 100_000


@pytest.mark.parametrize("text", [DIGITS + "x", DIGITS + ".x", "." + DIGITS + "x"])
def test_a_field_of_many_digits_is_looked_at_once(text: str) -> None:
    """It took minutes: each digit could be before an absent point or behind it."""
    assert parse(text) is None


@pytest.mark.parametrize("text", ["1", "1.", "1.5", ".5", "-1e3", "+.5E-2", "inf", "-Infinity"])
def test_a_number_is_what_python_reads(text: str) -> None:
    assert parse(text) == float(text)


@pytest.mark.parametrize("text", ["", ".", "1..5", "1.5.2", "e3", "1e", "1_000", "0x1", "nan"])
def test_all_else_is_no_number(text: str) -> None:
    assert parse(text) is None
