"""A folder for temporary files is gone with its process, wherever a signal has ended its use."""

import subprocess
import sys
from pathlib import Path

import pytest

from floatref import scratch_folder

BEGIN = """
import os, shutil, sys
from floatref.files import scratch
folder = scratch.make_scratch("tried")
(folder / "some").write_text("bytes")
print(folder, flush=True)
"""
BETWEEN = BEGIN + "sys.exit(130)"
"""Behind the making, before anybody knows of it."""
IN_REMOVAL = (
    BEGIN
    + """
def stop(*_, **__):
    shutil.rmtree = rmtree
    raise KeyboardInterrupt

rmtree, shutil.rmtree = shutil.rmtree, stop
scratch.remove_scratch(folder)
"""
)
IN_A_CHILD = (
    BEGIN
    + """
if os.fork() == 0:
    sys.exit(0)
os.wait()
print(folder.exists())
"""
)


IN_A_THREAD = (
    BEGIN
    + """
mark = scratch.owner_mark

def mark_later():
    scratch.owner_mark = mark
    scratch.remove_scratch(scratch.make_scratch("of a thread"))
    scratch._MADE.add(folder.with_name("of another"))
    return mark()

scratch.owner_mark = mark_later
"""
)
"""A thread makes folders while those that are left are looked for."""


def run(script: str, temporary: Path) -> list[str]:
    """Return the lines that ``script`` prints."""
    environment = {"TMPDIR": str(temporary)}
    done = subprocess.run(
        [sys.executable, "-c", script], capture_output=True, text=True, env=environment
    )
    return done.stdout.splitlines()


@pytest.mark.parametrize("script", [BETWEEN, IN_REMOVAL, IN_A_THREAD])
def test_nothing_is_left_wherever_a_signal_comes(tmp_path: Path, script: str) -> None:
    (name,) = run(script, tmp_path)
    assert Path(name).parent == tmp_path
    assert list(tmp_path.iterdir()) == []


@pytest.mark.posix
def test_a_child_removes_nothing_of_its_parent(tmp_path: Path) -> None:
    assert run(IN_A_CHILD, tmp_path)[-1] == "True"
    assert list(tmp_path.iterdir()) == []


def test_it_is_gone_behind_its_use() -> None:
    with scratch_folder("tried") as folder:
        (folder / "some").write_text("bytes", encoding="utf-8")
    assert not folder.exists()
