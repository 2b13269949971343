"""No text of the summary is a formula or commands a terminal, and each can be read back."""

import csv
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from floatref.batch.results.cells import read_cell, write_cell
from floatref.batch.results.record import Record
from floatref.batch.results.summary import CSV, write_summary

texts = st.text(st.characters(exclude_categories=["Cs"])) | st.text("=+-@'\t\r\n \x1b\\x05a1.,e")
NAMES = ["=cmd|' /C calc'!A0", "+1+1", "-2+3", "@SUM(A1)", " =1", "\t=1", "＝1+1", "\x1b[31mred"]


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


@pytest.mark.parametrize("name", NAMES)
def test_a_hostile_name_is_harmless_in_the_summary(tmp_path: Path, name: str) -> None:
    pytest.importorskip("pyarrow", reason="pyarrow writes Parquet; it comes with floatref[batch]")
    write_summary([Record(name, name, error=f"{name}: no such file")], tmp_path)
    with (tmp_path / CSV).open(encoding="utf-8", newline="") as stream:
        (row,) = csv.DictReader(stream)
    for column in ("file", "name"):
        assert row[column][0] == "'" or name[0] == "\x1b"
        assert "\x1b" not in row[column]
        assert read_cell(row[column]) == name
