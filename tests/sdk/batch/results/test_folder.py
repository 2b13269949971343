"""The output folder of a batch: ours or empty, one command at a time, swept of leftovers."""

import subprocess
import sys
from contextlib import ExitStack
from pathlib import Path

import pytest

from floatref.batch.jobs.job import Job
from floatref.batch.results.folder import mark_working, not_given, prepare_folder, sweep
from floatref.errors import InputError

HOLDER = """
import sys
from pathlib import Path
from floatref.batch.results.folder import mark_working, prepare_folder
with {context}:
    print("held", flush=True)
    sys.stdin.read()
"""


def holder(context: str) -> "subprocess.Popen[str]":
    """Start a process that holds ``context`` until it ends, and wait until it does."""
    command = [sys.executable, "-c", HOLDER.format(context=context)]
    process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
    assert process.stdout is not None
    assert process.stdout.readline() == "held\n"
    return process


def done_in(out: Path, name: str = "a") -> None:
    (out / "profiles" / name).mkdir()
    (out / "records" / f"{name}.json").write_text("{}", encoding="ascii")


def test_a_new_folder_is_made_and_kept_once_something_is_in_it(tmp_path: Path) -> None:
    out = tmp_path / "out"
    with prepare_folder(out, resume=False):
        done_in(out)
    assert (out / "records" / "a.json").is_file()


def test_a_new_folder_goes_again_if_nothing_was_done(tmp_path: Path) -> None:
    with pytest.raises(RuntimeError), prepare_folder(tmp_path / "out", resume=False):
        raise RuntimeError("no cluster")
    assert list(tmp_path.iterdir()) == []


def test_an_empty_folder_is_used(tmp_path: Path) -> None:
    for _ in range(2):
        with prepare_folder(tmp_path, resume=False):
            pass
    assert tmp_path.is_dir()


def test_what_was_done_is_kept_on_purpose_only(tmp_path: Path) -> None:
    with prepare_folder(tmp_path, resume=False):
        done_in(tmp_path)
    with pytest.raises(InputError, match="is not empty; choose another folder, or go on with"):
        prepare_folder(tmp_path, resume=False).__enter__()
    with prepare_folder(tmp_path, resume=True):
        assert (tmp_path / "records" / "a.json").is_file()


@pytest.mark.parametrize("resume", [False, True])
def test_a_folder_with_the_files_of_others_is_left_alone(tmp_path: Path, resume: bool) -> None:
    (tmp_path / "thesis.tex").write_text("years", encoding="ascii")
    with pytest.raises(InputError, match="choose another folder"):
        prepare_folder(tmp_path, resume).__enter__()
    assert [path.name for path in tmp_path.iterdir()] == ["thesis.tex"]


def test_notes_beside_a_batch_do_not_hinder_it(tmp_path: Path) -> None:
    with prepare_folder(tmp_path, resume=False):
        done_in(tmp_path)
    (tmp_path / "map.png").touch()
    with prepare_folder(tmp_path, resume=True):
        pass
    assert (tmp_path / "map.png").is_file()


def test_a_file_and_a_missing_parent_are_said(tmp_path: Path) -> None:
    (tmp_path / "a").touch()
    with pytest.raises(InputError, match="a: is not a folder"):
        prepare_folder(tmp_path / "a", resume=False).__enter__()
    with pytest.raises(InputError, match=r"its folder does not exist; make .*none first"):
        prepare_folder(tmp_path / "none" / "out", resume=False).__enter__()


def test_two_commands_never_share_a_folder(tmp_path: Path) -> None:
    other = holder(f"prepare_folder(Path({str(tmp_path)!r}), resume=False)")
    try:
        with pytest.raises(InputError, match="another batch works there"):
            prepare_folder(tmp_path, resume=True).__enter__()
    finally:
        other.kill()
        other.communicate()
    # The lock has ended with its process.
    with prepare_folder(tmp_path, resume=True):
        pass


def test_tasks_of_a_killed_command_are_waited_for(tmp_path: Path) -> None:
    with ExitStack() as stack:
        stack.enter_context(mark_working(tmp_path))
        other = holder(f"mark_working(Path({str(tmp_path)!r}))")
        with pytest.raises(InputError, match="workers still process files there"):
            prepare_folder(tmp_path, resume=True, patience_s=0.0).__enter__()
        other.kill()
        other.communicate()
        with pytest.raises(InputError, match="workers still process files there"):
            prepare_folder(tmp_path, resume=True, patience_s=0.0).__enter__()
    with prepare_folder(tmp_path, resume=True, patience_s=0.0):
        pass


def test_leftovers_go_and_nothing_else(tmp_path: Path) -> None:
    with prepare_folder(tmp_path, resume=False):
        done_in(tmp_path)
        (tmp_path / "profiles" / "road" / ".floatref-0a").mkdir(parents=True)
        (tmp_path / "profiles" / "road" / ".floatref-0a" / "left.f64").touch()
        (tmp_path / "records" / ".floatref-0b.json").touch()
        (tmp_path / ".floatref-0c.csv").touch()
        before = {path for path in tmp_path.rglob("*") if ".floatref-" not in str(path)}
        sweep(tmp_path)
        assert set(tmp_path.rglob("*")) == before


def test_files_that_are_no_longer_given_are_named(tmp_path: Path) -> None:
    with prepare_folder(tmp_path, resume=False):
        for name in ("a.mf4", "b.mf4"):
            done_in(tmp_path, name)
        (tmp_path / "records" / "A1").mkdir()
        (tmp_path / "records" / "A1" / "c.json").touch()
    jobs = [Job(Path("/in/b.mf4"), "b.mf4", tmp_path)]
    assert not_given(tmp_path, jobs) == ("A1/c", "a.mf4")


def test_a_command_begins_without_what_another_left_half_written(tmp_path: Path) -> None:
    (tmp_path / "records").mkdir()
    (tmp_path / "profiles" / ".floatref-0a").mkdir(parents=True)
    with prepare_folder(tmp_path, resume=True):
        assert list((tmp_path / "profiles").iterdir()) == []
