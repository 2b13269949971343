"""The summary: both files hold the same, every file is in it, and memory stays bounded."""

import csv
import json
import tracemalloc
from collections.abc import Iterator
from dataclasses import replace
from math import isnan, nan
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.batch.results import summary
from floatref.batch.results.record import Record, Row
from floatref.batch.results.summary import COLUMNS, CSV, NOT_COLUMNS, PARQUET, write_summary
from floatref.values.display.spreadsheet_cells import read_cell

parquet = pytest.importorskip(
    "pyarrow.parquet", reason="pyarrow writes Parquet; it comes with floatref[batch]"
)

number = st.floats(allow_infinity=False)
words = st.text(st.characters(exclude_categories=["Cs"])) | st.sampled_from(
    ['a,"b"', "two\nlines", "a\rb\r\nc", "Straße – 道路", "\u2028", " ", "'=1+1", "null", "nan"]
)
rows = st.builds(
    Row, words, st.integers(0, 10**6), number, number, number, number, number, number, number
)
records = st.builds(
    Record,
    name=words,
    source=words,
    error=st.just(""),
    rows=st.lists(rows, min_size=1, max_size=4).map(tuple),
    warnings=st.lists(words, max_size=2).map(tuple),
    remarks=st.lists(words, max_size=2).map(tuple),
    key=st.just({"asked": {"pipeline": "p", "versions": {"floatref": "1"}}, "adapter": "mdf4"}),
    inputs=st.dictionaries(words, words, max_size=2),
    outputs=st.dictionaries(words, words, max_size=2),
)
failures = st.builds(Record, name=words, source=words, error=words.filter(bool))


def read(folder: Path) -> tuple[list[dict[str, Any]], list[dict[str, Any]]]:
    with (folder / CSV).open(encoding="utf-8", newline="") as stream:
        lines = [
            {
                k: read_cell(v) if COLUMNS[k] is str else COLUMNS[k](v) if v else None
                for k, v in line.items()
            }
            for line in csv.DictReader(stream)
        ]
    return lines, parquet.read_table(folder / PARQUET).to_pylist()


def known(value: float) -> float | None:
    return None if isnan(value) else value


@pytest.mark.slow
@settings(max_examples=60, deadline=None)
@given(st.lists(records | failures, max_size=6))
def test_both_files_hold_every_row_as_it_is(given: list[Record]) -> None:
    with TemporaryDirectory() as folder:
        write_summary(iter(given), Path(folder))
        sheet, table = read(Path(folder))
    # An empty track is a track, and CSV cannot tell it from none.
    assert sheet == [{**line, "track": line["track"] or ""} for line in table]
    expected = [(record, row) for record in given for row in record.rows or (None,)]
    assert len(table) == len(expected)
    for line, (record, row) in zip(table, expected, strict=True):
        assert list(line) == list(COLUMNS)
        assert (line["file"], line["name"]) == (record.source, record.name)
        assert line["error"] == record.error
        assert line["status"] == ("failed" if record.error else "done")
        assert json.loads(line["inputs"]) == record.inputs
        assert line["warnings"] == " | ".join([*record.warnings, *record.remarks])
        for name in Row.__dataclass_fields__.keys() - set(NOT_COLUMNS):
            value = getattr(row, name) if row else None
            assert line[name] == (known(value) if isinstance(value, float) else value)


ROW = Row("left", 0, 0.0, 100.0, nan, nan, 1.25, nan, 0.0)


def test_what_a_reader_of_the_summary_finds(tmp_path: Path) -> None:
    key = {
        "asked": {"pipeline": "p", "settings": {"a": 1}, "versions": {"numpy": "2"}},
        "settings": {"a": 1.0, "b": nan},
        "adapter": "mdf4",
        "pipeline": "taken",
    }
    good = Record("x/run.mf4", "/data/run.mf4", rows=(ROW,), key=key, outputs={"left.f64": "0"})
    bad = Record("y", "/data/y", error="no such file", key={"asked": key["asked"]})
    write_summary([good, bad], tmp_path)
    first, second = read(tmp_path)[1]
    assert first["profile"] == "profiles/x/run.mf4"
    assert json.loads(first["settings"]) == {"a": 1.0, "b": None}
    assert json.loads(first["versions"]) == {"numpy": "2"}
    assert (first["adapter"], first["pipeline"]) == ("mdf4", "taken")
    assert (second["status"], second["track"], second["profile"]) == ("failed", None, "")
    assert json.loads(second["settings"]) == {"a": 1}
    # What failed has taken none, and a record of an earlier version does not tell.
    assert second["pipeline"] == "p"


def test_a_name_that_is_no_text_is_written_out(tmp_path: Path) -> None:
    odd = Record("r\udce9.csv", "/data/r\udce9.csv", rows=(replace(ROW, track="a\ud800"),))
    write_summary([odd], tmp_path)
    sheet, table = read(tmp_path)
    assert sheet == table
    assert (table[0]["name"], table[0]["track"]) == ("r\\udce9.csv", "a\\ud800")


def test_the_same_records_give_the_same_bytes(tmp_path: Path) -> None:
    given = [Record(f"r{k}", f"/r{k}", rows=(ROW,) * 3) for k in range(5)]
    contents = []
    for _ in range(2):
        write_summary(given, tmp_path)
        contents.append([(tmp_path / name).read_bytes() for name in (CSV, PARQUET)])
    assert contents[0] == contents[1]


@pytest.mark.slow
def test_records_go_through_in_bounded_memory(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(summary, "TOGETHER", 8)
    long, count = 50_000, 200

    def given() -> Iterator[Record]:
        for k in range(count):
            yield Record(f"r{k}", f"/r{k}", rows=(ROW,), warnings=(f"{k:0{long}}",))

    write_summary(given(), tmp_path)
    tracemalloc.start()
    try:
        write_summary(given(), tmp_path)
        most = tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()
    assert most < long * count / 4
    assert [int(line["warnings"][-9:]) for line in read(tmp_path)[1]] == list(range(count))


def test_a_summary_is_complete_or_the_old_one_stays(tmp_path: Path) -> None:
    write_summary([Record("a", "/a", rows=(ROW,))], tmp_path)
    before = {path.name: path.read_bytes() for path in tmp_path.iterdir()}

    def broken() -> Iterator[Record]:
        yield Record("b", "/b", rows=(ROW,) * 10_000)
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        write_summary(broken(), tmp_path)
    assert {path.name: path.read_bytes() for path in tmp_path.iterdir()} == before


def test_no_records_give_a_head_alone(tmp_path: Path) -> None:
    write_summary([], tmp_path)
    assert read(tmp_path) == ([], [])
    assert (tmp_path / CSV).read_text().split("\n")[0].strip() == ",".join(COLUMNS)


@pytest.mark.parametrize(
    "name", ["=cmd|' /C calc'!A0", "+1+1", "-2+3", "@SUM(A1)", " =1", "\t=1", "\x1b[31mred"]
)
def test_a_hostile_name_is_harmless(tmp_path: Path, name: str) -> None:
    write_summary([Record(name, name, error=f"{name}: no such file")], tmp_path)
    with (tmp_path / CSV).open(encoding="utf-8", newline="") as stream:
        (row,) = csv.DictReader(stream)
    for column in ("file", "name"):
        assert row[column][0] == "'" or name[0] == "\x1b"
        assert "\x1b" not in row[column]
        assert read_cell(row[column]) == name
