"""What a killed process has left is removed by the next, and what a living one makes never is."""

import errno
import os
import signal
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from floatref.files.atomic import replace_directory, replace_file
from floatref.files.owners import is_abandoned, own_name, owner_mark, sweep_once
from floatref.files.scratch import scratch_folder

pytestmark = [
    pytest.mark.posix,
    pytest.mark.skipif(not os.path.isdir("/proc/self"), reason="marks are read from /proc"),
]
UNFINISHED = """
import os, sys, tempfile
from pathlib import Path
from floatref.files.atomic import replace_directory, replace_file
from floatref.files.scratch import scratch_folder

place = Path(sys.argv[1])
tempfile.tempdir = str(place)
with (
    scratch_folder("trial") as folder,
    replace_file(place / "road.erd") as file,
    replace_directory(place / "road", False, "profile.json") as profile,
):
    for path in (folder / "a", file, profile / "b"):
        path.write_text("unfinished")
    print(flush=True)
    sys.stdin.read()
"""


@contextmanager
def at_work(folder: Path) -> Iterator["subprocess.Popen[bytes]"]:
    """Yield a process that has a temporary folder and two unfinished targets in ``folder``."""
    words = [sys.executable, "-c", UNFINISHED, str(folder)]
    process = subprocess.Popen(words, stdin=subprocess.PIPE, stdout=subprocess.PIPE)
    assert process.stdout is not None
    try:
        assert process.stdout.readline() == b"\n"
        yield process
    finally:
        process.kill()
        process.communicate()


def killed(folder: Path) -> None:
    with at_work(folder) as process:
        process.send_signal(signal.SIGKILL)


def test_what_a_killed_process_left_goes_and_what_lives_stays(tmp_path: Path) -> None:
    killed(tmp_path)
    assert len(list(tmp_path.iterdir())) == 3
    with at_work(tmp_path):
        # It has swept before it made its own; what others made stays for good.
        living = set(tmp_path.iterdir())
        assert len(living) == 3
        (tmp_path / ".floatref-0123456789ab.erd").touch()
        sweep_once(tmp_path)
        assert living < set(tmp_path.iterdir())


@pytest.mark.parametrize("how", ["file", "directory", "scratch"])
def test_every_writer_sweeps_first(
    tmp_path: Path, how: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    killed(tmp_path)
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    with {
        "file": lambda: replace_file(tmp_path / "b.csv"),
        "directory": lambda: replace_directory(tmp_path / "b", False, "profile.json"),
        "scratch": lambda: scratch_folder("trial"),
    }[how]() as made:
        if how == "file":
            made.touch()
        assert list(tmp_path.iterdir()) == [made]


def test_links_are_removed_and_not_followed(tmp_path: Path) -> None:
    (tmp_path / "kept").mkdir()
    (tmp_path / "kept" / "file").touch()
    (tmp_path / "in").mkdir()
    with at_work(tmp_path) as process:
        mark = next(p.name for p in tmp_path.iterdir() if p.name.endswith("trial"))
        process.send_signal(signal.SIGKILL)
    (tmp_path / "in" / f".{mark}").symlink_to(tmp_path / "kept")
    sweep_once(tmp_path / "in")
    assert list((tmp_path / "in").iterdir()) == []
    assert (tmp_path / "kept" / "file").exists()


@given(st.integers(0, 2**32 - 1), st.integers(0, 2**22), st.integers(0, 2**40))
def test_a_mark_of_another_machine_is_never_judged(machine: int, pid: int, start: int) -> None:
    own = owner_mark()
    assert not is_abandoned(own)
    if f"{machine:08x}" != own[:8]:
        assert not is_abandoned(f"{machine:08x}-{pid}-{start}")


def test_a_number_that_was_given_to_another_process_is_not_the_owner() -> None:
    machine, pid, start = owner_mark().split("-")
    assert is_abandoned(f"{machine}-{pid}-{int(start) - 1}")
    assert not is_abandoned(f"{machine}-{pid}-0")


def test_two_names_differ() -> None:
    assert own_name() != own_name()


def test_who_cannot_be_looked_for_is_not_gone(tmp_path: Path) -> None:
    with at_work(tmp_path) as other:
        mark = next(tmp_path.glob(".floatref-*")).name.removeprefix(".floatref-")
        mark = mark.rpartition("-")[0]
        assert not is_abandoned(mark)
        refused = Refusing(other.pid)
        with pytest.MonkeyPatch.context() as patch:
            patch.setattr("floatref.files.owners.PROC", refused)
            assert not is_abandoned(mark)
        assert refused.asked
    assert is_abandoned(mark)


class Refusing:
    """A table of processes in which one file cannot be opened: there are too many open ones."""

    def __init__(self, pid: int) -> None:
        self.pid, self.asked = str(pid), False

    def __truediv__(self, name: str) -> Path:
        if name != self.pid:
            return Path("/proc") / name
        self.asked = True
        raise OSError(errno.EMFILE, "Too many open files")
