"""No text of a CSV is a formula or commands a terminal, and each can be read back."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from floatref.values.display.spreadsheet_cells import read_cell, write_cell

texts = st.text(st.characters(exclude_categories=["Cs"])) | st.text("=+-@'\t\r\n \x1b\\x05a1.,e")


@given(texts)
def test_every_text_comes_back(text: str) -> None:
    assert read_cell(write_cell(text)) == text


@given(texts)
def test_no_cell_is_a_formula_or_holds_a_control_character(text: str) -> None:
    cell = write_cell(text)
    assert all(c.isprintable() or ord(c) > 0x9F for c in cell)
    if cell.strip()[:1] in tuple("=+-@＝＋－＠"):
        float(cell.replace(",", "."))


@given(st.floats(allow_nan=False, allow_infinity=False).map(repr) | st.integers().map(str))
def test_a_number_stays_a_number(text: str) -> None:
    assert write_cell(text) == text


@given(st.from_regex(r"[A-Za-z0-9_./ ][A-Za-z0-9_./ é道-]*", fullmatch=True))
def test_an_ordinary_name_stays_as_it_is(text: str) -> None:
    if not text.strip().startswith("-"):
        assert write_cell(text) == text


@pytest.mark.parametrize("cell", ["'left", "'", "a\\x41", "\\x5g", "left"])
def test_a_cell_of_another_program_stays_as_it_is(cell: str) -> None:
    assert read_cell(cell) == cell
