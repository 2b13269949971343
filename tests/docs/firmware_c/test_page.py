"""The tutorial of the firmware in C prints what it shows, and shows what is in the sources."""

import importlib
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[3]
SOURCE = ROOT / "docs" / "examples" / "firmware_c"
PAGE = ROOT / "docs" / "firmware.md"


@pytest.mark.slow
def test_every_command_of_the_page_prints_what_the_page_shows(monkeypatch, tmp_path):
    monkeypatch.syspath_prepend(str(ROOT / ".ci"))
    consoles = importlib.import_module("consoles")
    shutil.copytree(SOURCE, tmp_path / "firmware_c")
    text = PAGE.read_text(encoding="utf-8")
    found = consoles.performed(text, consoles.Shell(tmp_path / "firmware_c"))
    assert consoles.differences(text, found) == []


def test_every_piece_of_c_on_the_page_is_in_the_sources():
    sources = "\n".join(file.read_text(encoding="ascii") for file in SOURCE.glob("*.[ch]"))
    pieces = re.findall(r"^```c\n(.*?)^```$", PAGE.read_text(encoding="utf-8"), re.M | re.S)
    assert len(pieces) >= 5
    for piece in pieces:
        assert piece in sources


@pytest.mark.parametrize("file", ["firmware.c", "firmware_road_prior.c"])
def test_a_signal_path_is_one_file_of_the_length_that_the_pages_state(file):
    lines = len((SOURCE / file).read_text(encoding="ascii").splitlines())
    assert lines <= 150
    for page in (PAGE, SOURCE / "README.md"):
        assert f"{lines} lines" in " ".join(page.read_text(encoding="utf-8").split())


def test_the_readme_lists_every_source_file_once():
    readme = (SOURCE / "README.md").read_text(encoding="utf-8")
    files = re.findall(r"`(\w+\.c)`", re.search(r"\| file .*?\n\n", readme, re.S)[0])
    unlisted = {"failure.c"}
    assert sorted(files) == sorted({file.name for file in SOURCE.glob("*.c")} - unlisted)


@pytest.mark.posix
@pytest.mark.slow
def test_the_commands_of_the_readme_work_from_the_top_of_the_tree(tmp_path):
    readme = (SOURCE / "README.md").read_text(encoding="utf-8")
    shutil.copytree(SOURCE, tmp_path / SOURCE.relative_to(ROOT))
    (commands,) = re.findall(r"^```sh\n(.*?)^```$", readme, re.M | re.S)
    # The Makefile asks `python3` of an activated environment where the sources are.
    path = os.pathsep.join([str(Path(sys.executable).parent), os.environ["PATH"]])
    environment = {**os.environ, "PATH": path}
    subprocess.run(
        ["sh", "-e"], input=commands, text=True, cwd=tmp_path, check=True, env=environment
    )
    built = {path.name for path in (tmp_path / SOURCE.relative_to(ROOT)).iterdir()}
    assert {"firmware", "hello", "golden"} <= built
