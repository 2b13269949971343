"""The page on the C library: its program runs, and its tables are those of the library."""

import importlib
import re
import shutil
from pathlib import Path

import pytest

import floatref
from floatref_conformance import golden

ROOT = Path(__file__).parents[2]
PROGRAM = ROOT / "docs" / "examples" / "c_library" / "profile.c"
PAGE = (ROOT / "docs" / "c-library.md").read_text(encoding="utf-8")
HEADER = (floatref.c_sources() / "floatref.h").read_text(encoding="utf-8")


def table(title: str) -> str:
    return PAGE.partition(f"## {title}\n")[2].partition("\n## ")[0]


def test_the_program_of_the_page_is_the_example_and_short() -> None:
    (shown,) = re.findall(r"^```c\n(.*?)^```$", PAGE, re.M | re.S)
    assert shown == PROGRAM.read_text(encoding="utf-8")
    assert len(shown.splitlines()) <= 60


@pytest.mark.slow
def test_every_command_prints_what_the_page_shows(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.syspath_prepend(str(ROOT / ".ci"))
    consoles = importlib.import_module("consoles")
    shutil.copy(PROGRAM, tmp_path)
    found = consoles.performed(PAGE, consoles.Shell(tmp_path))
    assert consoles.differences(PAGE, found) == []


def test_every_vector_is_in_the_table_once() -> None:
    rows = re.findall(r"^\| (`.*?) \| ", table("Golden vectors"), re.M)
    names = [name for row in rows for name in re.findall(r"`(.*?)`", row)]
    assert sorted(names) == sorted(golden.names())


def test_every_function_that_is_named_is_in_the_header() -> None:
    stages = set(re.findall(r"typedef struct (fr_\w+) fr_\w+;", HEADER))
    for name in set(re.findall(r"`(fr_[a-z]\w+)(?:\(\))?`", PAGE)):
        assert name in stages or f"{name}(" in HEADER or f" {name};" in HEADER, name
    assert stages <= set(re.findall(r"`(fr_\w+)`", table("Stage by stage")))
