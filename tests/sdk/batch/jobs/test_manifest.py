"""Manifests: paths, or a CSV that says how; every mistake is one line that names the line."""

import csv
import io
import json
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.batch.jobs.defaults import Defaults
from floatref.batch.jobs.manifest import Entry, is_manifest, read_manifest
from floatref.errors import InputError

NAMES = st.text("ab,;\"'é .", min_size=1, max_size=6).filter(lambda name: name == name.strip())
CUT_OFF = {"cutoff_wavelength_m": 50.0}


def listed(folder: Path, text: str) -> Path:
    path = folder / "list.csv"
    path.write_bytes(text.encode())
    return path


def entries(folder: Path, text: str, options: Defaults | None = None) -> tuple[Entry, ...]:
    return read_manifest(listed(folder, text), options or Defaults())


def test_a_path_a_line_with_comments_and_any_line_end(tmp_path: Path) -> None:
    (tmp_path / "a b.mf4").touch()
    text = "\ufeff# ours\r\n\r\n  a b.mf4 \r\n/far/c.mf4\n  # not\nsub/d.mf4"
    assert is_manifest(listed(tmp_path, text))
    found = entries(tmp_path, text, Defaults(pipeline="temporal-hpf"))
    names = [tmp_path / "a b.mf4", Path("/far/c.mf4"), tmp_path / "sub/d.mf4"]
    assert [entry.path for entry in found] == names
    assert {entry.options.pipeline for entry in found} == {"temporal-hpf"}


def test_columns_take_the_place_of_the_options_where_they_say_something(tmp_path: Path) -> None:
    (tmp_path / "s.json").write_text(json.dumps(CUT_OFF))
    usual = Defaults(adapter="csv", segment_m=100.0)
    text = "pipeline, file ,settings,Adapter\n,a.csv,,\ntemporal-basic,b.csv,s.json,mdf4\n,c.csv"
    first, second, third = entries(tmp_path, text, usual)
    assert first == Entry(tmp_path / "a.csv", usual)
    assert third == Entry(tmp_path / "c.csv", usual)
    chosen = Defaults("mdf4", None, "temporal-basic", CUT_OFF, 100.0)
    assert second == Entry(tmp_path / "b.csv", chosen)


@given(names=st.lists(NAMES, min_size=1, max_size=5), delimiter=st.sampled_from(",;\t"))
@settings(deadline=None, max_examples=60)
def test_what_a_csv_writer_wrote_is_read_back(
    tmp_path_factory: pytest.TempPathFactory, names: list[str], delimiter: str
) -> None:
    folder = tmp_path_factory.mktemp("m")
    written = io.StringIO(newline="")
    table = csv.writer(written, delimiter=delimiter)
    table.writerow(["file", "adapter"])
    table.writerows([name, "csv"] for name in names)
    found = entries(folder, written.getvalue())
    assert [entry.path for entry in found] == [folder / name for name in names]


@pytest.mark.parametrize(
    ("content", "expected"),
    [
        (b"file\nmissing.mf4\n", True),
        (b"adapter;file\n", True),
        (b"missing.mf4\nthere.mf4\n", True),
        (b"missing.mf4\nother.mf4\n", False),
        (b"time,height\n0.0,1.0\n", False),
        (b"file\n\0\n", False),
        (b"", False),
        (b"# only a remark\n", False),
        (b'"file\n', False),
    ],
)
def test_what_a_manifest_is(tmp_path: Path, content: bytes, expected: bool) -> None:
    (tmp_path / "there.mf4").touch()
    (tmp_path / "list").write_bytes(content)
    assert is_manifest(tmp_path / "list") is expected


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("file,colour\na,b\n", r"list.csv: column 'colour': unknown; there are file, adapter"),
        ("file,map,map\n", r"list.csv: column map: given 2 times"),
        ("file,adapter\na,csv\n\n,csv\n", r"list.csv: line 4: no file; name one"),
        ("file,adapter\na,csv,more\n", r"line 2: 3 values in 2 columns"),
        ('file,adapter\n"a,csv\n', r"line 2: not a valid line of a CSV"),
        ("file,adapter\na,nobody\n", r"line 2: adapter nobody: unknown; there are"),
        ("file,pipeline\na,nothing\n", r"line 2: pipeline nothing: unknown; there are"),
        ("file,map\na,no.toml\n", r"line 2: .*no.toml: No such file"),
        ("file,settings\na,no.json\n", r"line 2: .*no.json: No such file"),
        ("file,settings\na,list.csv\n", r"line 2: .*list.csv: "),
        ("file,map\na,b\0\n", r"line 2: .*not a valid file name"),
    ],
)
def test_every_mistake_is_one_line(tmp_path: Path, text: str, said: str) -> None:
    with pytest.raises(InputError, match=said) as caught:
        entries(tmp_path, text)
    assert "\n" not in str(caught.value)


def test_settings_that_the_pipeline_of_a_line_has_not_are_found_at_once(tmp_path: Path) -> None:
    usual = Defaults(settings=CUT_OFF)
    with pytest.raises(InputError, match="line 3: setting cutoff_wavelength_m: pipeline temporal-"):
        entries(tmp_path, "file,pipeline\na.mf4,\nb.mf4,temporal-hpf\n", usual)


def test_a_list_that_is_no_text_says_so(tmp_path: Path) -> None:
    path = tmp_path / "list"
    path.write_bytes(b"file\n\xff\xfe\n")
    with pytest.raises(InputError, match="byte 5 is not UTF-8"):
        read_manifest(path, Defaults())
