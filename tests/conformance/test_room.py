"""A full disk ends a run in one line with the folder and the bytes; the device is not to blame."""

import errno
import shutil
import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace

import pytest

from floatref.errors import InputError
from floatref_conformance.errors import DeviceRefused, NoRoom
from floatref_conformance.room import needing_room

LIMITED = """
import resource, sys
resource.setrlimit(resource.RLIMIT_FSIZE, (int(sys.argv.pop(1)),) * 2)
from floatref_conformance.__main__ import start
start()
"""


def free(number: int) -> object:
    return lambda path: SimpleNamespace(free=number)


@pytest.mark.parametrize("number", [errno.ENOSPC, errno.EDQUOT, errno.EFBIG])
@pytest.mark.parametrize("wrapped", [False, True])
def test_a_full_disk_is_named_whoever_finds_it(tmp_path: Path, number: int, wrapped: bool) -> None:
    def write() -> None:
        with needing_room(tmp_path, 4711, "TMPDIR"):
            try:
                raise OSError(number, "full")
            except OSError as error:
                if wrapped:
                    raise InputError("cannot be written") from error
                raise

    with pytest.raises(NoRoom, match=r"needs 4711 bytes \(full\); .* variable TMPDIR") as caught:
        write()
    assert str(caught.value).startswith(f"{tmp_path}: no room for a recording")


def test_too_little_is_refused_before_the_work(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(shutil, "disk_usage", free(4710))
    with pytest.raises(NoRoom, match="4710 bytes are free"), needing_room(tmp_path, 4711, "X"):
        raise AssertionError("began")
    with needing_room(tmp_path, 4710, "X"):
        pass


def test_a_device_that_finds_the_disk_full_is_not_blamed(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def refuse() -> None:
        with needing_room(tmp_path / "new" / "folder", 100, "X"):
            monkeypatch.setattr(shutil, "disk_usage", free(99))
            raise DeviceRefused("cannot write")

    with pytest.raises(NoRoom, match="99 bytes are free"):
        refuse()


def test_other_errors_pass(tmp_path: Path) -> None:
    for error in (DeviceRefused("no"), OSError(errno.EACCES, "no"), InputError("no")):
        with pytest.raises(type(error), match="no"), needing_room(tmp_path, 1, "X"):
            raise error


@pytest.mark.slow
@pytest.mark.posix
@pytest.mark.parametrize("full", ["cache", "temporary"])
@pytest.mark.parametrize("jobs", [(), ("--jobs", "2")])
def test_a_run_without_room_is_one_line(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, full: str, jobs: tuple[str, ...]
) -> None:
    """No file may grow beyond 100 kB, as on a disk that has no more."""
    (tmp_path / "temporary").mkdir()
    monkeypatch.setenv("FLOATREF_CACHE", str(tmp_path / "cache"))
    monkeypatch.setenv("TMPDIR", str(tmp_path / "temporary"))
    words = ["run", "--device", "builtin:temporal-basic", "--check", "bounce", *jobs]
    if full == "temporary":
        # No cache can be made in a file: recordings are held in memory.
        (tmp_path / "file").touch()
        monkeypatch.setenv("FLOATREF_CACHE", str(tmp_path / "file" / "cache"))
    limited = [sys.executable, "-c", LIMITED, "100000", *words]
    done = subprocess.run(limited, capture_output=True, text=True, check=False, cwd=tmp_path)
    assert done.returncode == 2, done.stderr
    last = done.stderr.splitlines()[-1]
    # A process of a pool has a folder of its own there.
    assert last.startswith(f"Error: {tmp_path / full}")
    assert ": no room for a recording, which needs " in last
    assert "Traceback" not in done.stderr
    assert list((tmp_path / "temporary").iterdir()) == []
    assert list(tmp_path.glob("cache/.*")) == []
