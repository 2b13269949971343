"""Reports are read from files that anybody may have made."""

import json
import shutil

import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.conformance.matrix.conftest import make_check, make_document

from floatref.errors import InputError
from floatref_conformance.matrix.stored_reports import read_reports

DEEP = '{"a":' * 70 + "1" + "}" * 70


def broken(**changes):
    return json.dumps(make_document({"stop": 0.5}, **changes))


@pytest.mark.parametrize(
    ("content", "reason"),
    [
        ("", "empty"),
        ("[1, 2]", "not that of a report"),
        ('{"format": "conformance-table/1"}', 'format "conformance-table/1" is not that'),
        (broken(verdict="SUPERB"), "verdict breaks the format"),
        (broken(checks=[make_check("stop", 0.5)] * 2), 'has the check "stop" 2 times'),
        (broken(stream_checks=[make_check("stop", 0.5)]), 'has the check "stop" 2 times'),
        (broken(device={"spec": "x" * 10_000}), "breaks the format"),
        (broken(device={**make_document({})["device"], "deep": json.loads(DEEP)}), "nested deeper"),
        (broken(checks=[make_check("stop", 0.5, flagged_m=-1.0)]), "checks[0].flagged_m breaks"),
        (broken().replace("0.25", "1e999"), "float64 ends"),
        (broken().replace("0.25", "NaN"), "not JSON"),
        (b"\xff\xfe", "byte 0 is not UTF-8"),
        (b" " * (17 << 20), "larger than any report"),
    ],
)
def test_what_is_no_report_is_one_line_that_names_the_file(tmp_path, content, reason):
    path = tmp_path / "other.json"
    path.write_bytes(content if isinstance(content, bytes) else content.encode())
    with pytest.raises(InputError) as caught:
        read_reports([path])
    assert str(caught.value).startswith(f"{path}: ")
    assert reason in str(caught.value)
    assert len(str(caught.value)) < len(str(path)) + 400


@given(st.integers(0, len(broken()) - 1))
def test_a_report_that_is_cut_anywhere_is_refused(tmp_path_factory, length):
    path = tmp_path_factory.getbasetemp() / "cut.json"
    path.write_text(broken()[:length])
    with pytest.raises(InputError, match=r"cut\.json: "):
        read_reports([path])


def test_folder_and_file_are_the_same_and_given_once(stored):
    folder = stored("a", {"stop": 0.5})
    (one,), (other,) = read_reports([folder]), read_reports([folder / "report.json"])
    assert (one.name, one.document) == (other.name, other.document) == ("a", one.document)
    with pytest.raises(InputError, match="given twice"):
        read_reports([folder, folder / "report.json"])


def test_names_are_as_long_as_it_takes_to_differ(stored, tmp_path):
    paths = [stored(name, {"stop": 0.5}) for name in ("x/old", "y/old", "z/new")]
    assert [r.name for r in read_reports(paths)] == ["x/old", "y/old", "z/new"]
    assert [r.name for r in read_reports(paths[1:])] == ["old", "new"]
    shutil.copy(paths[0] / "report.json", tmp_path / "kept.json")
    assert read_reports([tmp_path / "kept.json"])[0].name == "kept"
