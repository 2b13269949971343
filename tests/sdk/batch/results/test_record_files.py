"""Records survive the disk, and what is no record is refused in one line."""

import json
from dataclasses import replace
from math import isnan, nan
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from floatref.batch.results.record import Effort, Record, Row, read_record, write_record
from floatref.errors import InputError

HASH = "0123456789abcdef" * 4
ROW = Row("left", 0, 0.0, 100.0, nan, nan, 1.5, nan, 2.5)
RECORD = Record("a/run", "/data/run", rows=(ROW,), inputs={"/data/run": HASH}, length_m=100.0)

finite = st.floats(allow_nan=False, allow_infinity=False)
length = st.floats(0.0, allow_infinity=False)
known = st.floats(allow_infinity=False)
count = st.integers(0, 10**15)
rows = st.builds(Row, st.text(), count, finite, length, known, known, known, known, length)
records = st.builds(
    Record,
    name=st.text(),
    source=st.text(),
    error=st.text(),
    rows=st.lists(rows, max_size=4).map(tuple),
    warnings=st.lists(st.text(), max_size=3).map(tuple),
    remarks=st.lists(st.text(), max_size=3).map(tuple),
    key=st.dictionaries(st.text(), finite | st.text() | st.none() | st.booleans()),
    inputs=st.dictionaries(st.text(), st.just(HASH)),
    outputs=st.dictionaries(st.text(), st.just(HASH)),
    length_m=length,
    effort=st.builds(Effort, length, length, count, count, count),
)


def without_nan(record: Record) -> Record:
    bare = [
        replace(row, **{k: None for k, v in vars(row).items() if isinstance(v, float) and isnan(v)})
        for row in record.rows
    ]
    return replace(record, rows=tuple(bare))


@pytest.mark.slow
@given(records)
def test_a_record_comes_back_from_disk(record: Record) -> None:
    with TemporaryDirectory() as folder:
        path = Path(folder) / "deep" / "er" / "run.mf4.json"
        write_record(record, path)
        assert without_nan(read_record(path)) == without_nan(record)
        assert [p.name for p in path.parent.iterdir()] == [path.name]


def test_what_is_not_known_is_null_and_the_rest_is_strict_json(tmp_path: Path) -> None:
    write_record(RECORD, tmp_path / "r.json")
    document = json.loads((tmp_path / "r.json").read_text(), parse_constant=pytest.fail)
    assert document["format"] == "floatref-batch-record/1"
    assert document["rows"][0]["latitude_deg"] is None
    assert "skipped" not in document


def test_whether_it_was_skipped_is_not_written(tmp_path: Path) -> None:
    write_record(replace(RECORD, skipped=True), tmp_path / "r.json")
    assert not read_record(tmp_path / "r.json").skipped


def _changed(document: dict[str, Any], keys: list[Any], value: Any) -> None:
    for key in keys[:-1]:
        document = document[key]
    document[keys[-1]] = value


@pytest.mark.parametrize(
    ("keys", "value", "message"),
    [
        (["format"], "floatref-batch-record/2", "the format of records that this version knows"),
        (["rows"], {}, "rows is {}"),
        (["rows", 0, "segment"], -1, "the number of the segment"),
        (["rows", 0, "start_m"], None, "where the segment starts"),
        (["rows", 0, "iri_m_per_km"], "1.5", "the IRI in m/km"),
        (["inputs", "/data/run"], "12", "a SHA-256 as 64 hexadecimal digits"),
        (["effort", "bytes_in"], 0.5, "the bytes of the inputs"),
        (["error"], None, "one line that says why"),
    ],
)
def test_what_is_no_record_is_refused_in_one_line(
    tmp_path: Path, keys: list[Any], value: Any, message: str
) -> None:
    path = tmp_path / "r.json"
    write_record(RECORD, path)
    document = json.loads(path.read_text())
    _changed(document, keys, value)
    path.write_text(json.dumps(document))
    with pytest.raises(InputError, match=message) as caught:
        read_record(path)
    assert str(caught.value).startswith(f"{path}: ")


@pytest.mark.parametrize("place", [[], ["rows", 0], ["effort"]])
def test_unknown_keys_are_ignored(tmp_path: Path, place: list[Any]) -> None:
    path = tmp_path / "r.json"
    write_record(RECORD, path)
    document = json.loads(path.read_text())
    _changed(document, [*place, "later"], {"any": [1]})
    path.write_text(json.dumps(document))
    assert without_nan(read_record(path)) == without_nan(RECORD)


def test_a_record_may_be_larger_than_other_documents(tmp_path: Path) -> None:
    long = replace(RECORD, rows=(), warnings=("long " * (1 << 20),))
    write_record(long, tmp_path / "r.json")
    assert read_record(tmp_path / "r.json") == long


def test_a_place_that_cannot_be_written_is_one_line(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    with pytest.raises(InputError, match="no such folder can be made"):
        write_record(RECORD, tmp_path / "file" / "r.json")
