"""A target appears complete or not at all, and the old one stays until the new is complete."""

import os
from collections.abc import Callable
from contextlib import AbstractContextManager
from pathlib import Path

import numpy as np
import pytest

from floatref.errors import InputError
from floatref.files import (
    read_profile,
    read_recording,
    write_profile,
    write_profile_csv,
    write_recording,
)
from floatref.files.atomic import check_target, replace_directory, replace_file
from floatref.values.profile import Profile, ProfileTrack
from floatref.values.recording import Recording


def profile(value: float = 0.0) -> Profile:
    return Profile(0.25, (ProfileTrack.of("left", np.full(5, value)),))


def listing(folder: Path) -> dict[str, bytes]:
    return {str(p.relative_to(folder)): p.read_bytes() for p in folder.rglob("*") if p.is_file()}


FAILURES = [RuntimeError, KeyboardInterrupt, OSError, SystemExit, GeneratorExit]


@pytest.mark.parametrize("failure", FAILURES)
@pytest.mark.parametrize("old", [True, False])
def test_a_failure_in_the_middle_leaves_everything_as_it_was(
    tmp_path: Path, failure: type[BaseException], old: bool
) -> None:
    if old:
        write_profile(profile(), tmp_path / "p")
        (tmp_path / "f.csv").write_text("old")
    before = listing(tmp_path)

    def fill_folder() -> None:
        with replace_directory(tmp_path / "p", True, "profile.json") as folder:
            (folder / "left.f64").write_bytes(b"half")
            raise failure

    def fill_file() -> None:
        with replace_file(tmp_path / "f.csv", True) as beside:
            beside.write_text("half")
            raise failure

    for fill in (fill_folder, fill_file):
        with pytest.raises((failure, InputError)):
            fill()
        assert listing(tmp_path) == before
        assert not list(tmp_path.glob(".floatref*"))


@pytest.mark.parametrize("step", ["mkdir", "rename"])
@pytest.mark.parametrize("failure", [OSError(28, "No space left on device"), KeyboardInterrupt()])
def test_a_failure_of_the_system_leaves_everything_as_it_was(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, step: str, failure: BaseException
) -> None:
    write_profile(profile(1.0), tmp_path / "p")
    before = listing(tmp_path)
    original = getattr(os, step)

    def failing(*paths: object, **options: object) -> None:
        is_last = step == "mkdir" or not str(paths[1]).endswith("-old")
        if is_last and not str(paths[0]).endswith("-old"):
            raise failure
        original(*paths, **options)

    monkeypatch.setattr(os, step, failing)
    with pytest.raises((InputError, KeyboardInterrupt)):
        write_profile(profile(2.0), tmp_path / "p", overwrite=True)
    monkeypatch.undo()
    assert listing(tmp_path) == before
    assert not list(tmp_path.glob(".floatref*"))


def test_running_out_of_space_names_the_target_and_leaves_nothing(
    recording: Recording, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    import floatref.files.recording_directory as module

    def full(values: object, path: Path) -> None:
        path.write_bytes(b"half")
        raise OSError(28, "No space left on device", str(path))

    monkeypatch.setattr(module, "write_samples", full)
    with pytest.raises(InputError, match=rf"^{tmp_path}/run: cannot be written \(No space left"):
        write_recording(recording, tmp_path / "run")
    assert list(tmp_path.iterdir()) == []


def test_an_existing_target_is_refused_and_kept(recording: Recording, tmp_path: Path) -> None:
    writers: list[tuple[str, Callable[[Path], None]]] = [
        ("p", lambda path: write_profile(profile(), path)),
        ("p.csv", lambda path: write_profile_csv(profile(), path)),
        ("run", lambda path: write_recording(recording, path)),
    ]
    for name, write in writers:
        write(tmp_path / name)
        before = listing(tmp_path)
        with pytest.raises(InputError, match=f"{name}: exists; choose another name"):
            write(tmp_path / name)
        assert listing(tmp_path) == before


def test_overwriting_replaces_the_whole_and_keeps_files_of_others(tmp_path: Path) -> None:
    write_profile(profile(1.0), tmp_path / "p")
    (tmp_path / "p" / "note.txt").write_text("mine")
    (tmp_path / "p" / "stale.f64").write_bytes(bytes(8))
    write_profile(profile(2.0), tmp_path / "p", overwrite=True)
    assert read_profile(tmp_path / "p").tracks[0].elevation[0] == 2.0
    assert (tmp_path / "p" / "note.txt").read_text() == "mine"
    assert not (tmp_path / "p" / "stale.f64").exists()
    assert [path.name for path in tmp_path.iterdir()] == ["p"]
    write_profile_csv(profile(1.0), tmp_path / "p.csv")
    write_profile_csv(profile(3.0), tmp_path / "p.csv", overwrite=True)
    assert read_profile(tmp_path / "p.csv").tracks[0].elevation[0] == 3.0


def test_a_folder_that_holds_something_else_is_never_replaced(
    recording: Recording, tmp_path: Path
) -> None:
    (tmp_path / "home").mkdir()
    (tmp_path / "home" / "thesis.tex").write_text("years of work")
    write_recording(recording, tmp_path / "run")
    for name in ("home", "run"):
        with pytest.raises(InputError, match=f"{name}: holds other files and no profile.json"):
            write_profile(profile(), tmp_path / name, overwrite=True)
    assert read_recording(tmp_path / "run").tracks == ("left",)
    (tmp_path / "empty").mkdir()
    write_profile(profile(), tmp_path / "empty", overwrite=True)
    assert read_profile(tmp_path / "empty").tracks[0].name == "left"


@pytest.mark.posix
def test_files_and_folders_are_not_taken_for_each_other(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("x")
    (tmp_path / "folder").mkdir()
    with pytest.raises(InputError, match="file: is not a folder; give the name of a folder"):
        write_profile(profile(), tmp_path / "file", overwrite=True)
    with pytest.raises(InputError, match="folder: is not a file; give the name of a file"):
        write_profile_csv(profile(), tmp_path / "folder", overwrite=True)
    with pytest.raises(InputError, match="is not a file"):
        write_profile_csv(profile(), Path("/dev/null"), overwrite=True)


@pytest.mark.posix
def test_a_link_stays_a_link_to_what_is_replaced(tmp_path: Path) -> None:
    write_profile_csv(profile(1.0), tmp_path / "real.csv")
    (tmp_path / "link.csv").symlink_to("real.csv")
    write_profile_csv(profile(2.0), tmp_path / "link.csv", overwrite=True)
    assert (tmp_path / "link.csv").is_symlink()
    assert read_profile(tmp_path / "real.csv").tracks[0].elevation[0] == 2.0


@pytest.mark.posix
def test_impossible_targets_are_named(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("x")
    (tmp_path / "loop").symlink_to("loop")
    for path, text in (
        (tmp_path / "none" / "p", "its folder does not exist; make .*none first"),
        (tmp_path / "file" / "p", "its folder does not exist"),
        (tmp_path / "loop", "exists; choose another name"),
        (tmp_path / ("x" * 300), r"cannot be written \(File name too long\)"),
        (Path("a\x00b"), "no possible file name"),
    ):
        for write in (write_profile, write_profile_csv):
            with pytest.raises(InputError, match=text):
                write(profile(), path)
    assert sorted(path.name for path in tmp_path.iterdir()) == ["file", "loop"]


@pytest.mark.posix
def test_a_folder_that_may_not_be_written_is_named(
    tmp_path: Path, unprivileged: Callable[[], AbstractContextManager[None]]
) -> None:
    (tmp_path / "closed").mkdir()
    (tmp_path / "closed").chmod(0o555)
    for write in (write_profile, write_profile_csv):
        target = tmp_path / "closed" / "p"
        with (
            unprivileged(),
            pytest.raises(InputError, match=r"closed/p: cannot be written \(Permission denied\)"),
        ):
            write(profile(), target)
    assert list((tmp_path / "closed").iterdir()) == []


def test_the_temporary_name_keeps_the_suffix_and_the_folder(tmp_path: Path) -> None:
    with replace_file(tmp_path / "plot.png") as beside:
        assert (beside.parent, beside.suffix) == (tmp_path, ".png")
        assert not (tmp_path / "plot.png").exists()
        beside.write_bytes(b"x")
    assert listing(tmp_path) == {"plot.png": b"x"}


def test_a_target_that_appears_meanwhile_is_kept(tmp_path: Path) -> None:
    def fill() -> None:
        with replace_file(tmp_path / "f") as beside:
            beside.write_text("ours")
            (tmp_path / "f").write_text("theirs")

    with pytest.raises(InputError, match="f: exists"):
        fill()
    assert listing(tmp_path) == {"f": b"theirs"}


def test_a_target_can_be_checked_before_the_work(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("x")
    with pytest.raises(InputError, match="file: exists; choose another name"):
        check_target(tmp_path / "file")
    with pytest.raises(InputError, match=r"its folder does not exist; make .*none first"):
        check_target(tmp_path / "none" / "p")
    check_target(tmp_path / "file", overwrite=True)
    check_target(tmp_path / "new")
    assert [path.name for path in tmp_path.iterdir()] == ["file"]


@pytest.mark.posix
def test_a_loop_of_links_is_no_target_of_a_file(tmp_path: Path) -> None:
    (tmp_path / "one").symlink_to("two")
    (tmp_path / "two").symlink_to("one")
    for name in ("one", "two"):
        with pytest.raises(InputError, match=f"{name}: is a loop of links; remove it, or"):
            check_target(tmp_path / name, overwrite=True)
    (tmp_path / "away").symlink_to("new")
    check_target(tmp_path / "away", overwrite=True)


@pytest.mark.posix
@pytest.mark.parametrize("overwrite", [False, True])
def test_a_pipe_is_no_target(tmp_path: Path, overwrite: bool) -> None:
    os.mkfifo(tmp_path / "pipe")
    with pytest.raises(InputError, match=r"pipe: (is not a file or folder|exists); "):
        check_target(tmp_path / "pipe", overwrite)
