"""Samples on the disk come back as they were, and nothing stays behind."""

import errno
import os
import tempfile
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from floatref.errors import InputError
from floatref.mapping import spool as spools
from floatref.mapping.spool import SPARE, Spool


@pytest.mark.slow
@settings(deadline=None, max_examples=30)
@given(pieces=st.lists(arrays(np.float64, st.integers(0, 20)), max_size=6))
def test_samples_come_back_bit_for_bit(pieces: list[np.ndarray]) -> None:
    with Spool() as spool:
        column = spool.column()
        for piece in pieces:
            column.append(piece)
        found = column.finish()
        assert found.tobytes() == b"".join(piece.tobytes() for piece in pieces)
        kept = np.arange(found.size) % 3 == 1
        assert spool.thin(found, kept).tobytes() == found[kept].tobytes()


def test_nothing_stays_behind_and_arrays_outlive_the_folder(temporary: Path) -> None:
    with Spool() as spool:
        column = spool.column()
        column.append(np.arange(5.0))
        assert len(list(temporary.iterdir())) == 1
        found = column.finish()
    assert list(temporary.iterdir()) == []
    assert found.tolist() == [0, 1, 2, 3, 4]


def open_files() -> int:
    return len(os.listdir("/proc/self/fd"))


@pytest.mark.skipif(not Path("/proc/self/fd").exists(), reason="counts open files of the process")
def test_after_an_error_neither_folder_nor_open_files_stay_behind(temporary: Path) -> None:
    before = open_files()

    def spoilt() -> None:
        with Spool() as spool:
            columns = [spool.column() for _ in range(5)]
            columns[0].append(np.arange(5.0))
            assert open_files() == before + 5
            raise KeyError

    with pytest.raises(KeyError):
        spoilt()
    assert list(temporary.iterdir()) == []
    assert open_files() == before


@pytest.mark.parametrize(("free", "room"), [(SPARE + 800, 100), (SPARE, 0), (0, 0)])
def test_room_is_asked_for_before_the_work(
    temporary: Path, monkeypatch: pytest.MonkeyPatch, free: int, room: int
) -> None:
    monkeypatch.setattr(spools.shutil, "disk_usage", lambda path: SimpleNamespace(free=free))
    with Spool() as spool:
        if room:
            spool.check_room(room)
        with pytest.raises(InputError) as caught:
            spool.check_room(room + 1)
    assert str(caught.value).startswith("reading it needs ")
    assert f"{temporary} has " in str(caught.value)
    assert "set TMPDIR to a folder with more" in str(caught.value)


def test_a_disk_that_is_full_is_told_in_one_line(
    temporary: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    class Full(np.ndarray):
        def tofile(self, *args: object) -> None:
            raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr(spools.np, "ascontiguousarray", lambda *a: np.zeros(3).view(Full))
    with Spool() as spool, pytest.raises(InputError) as caught:
        spool.column().append(np.zeros(3))
    assert str(caught.value) == (
        f"{temporary}: No space left on device while reading; set TMPDIR to a folder with more room"
    )


def test_a_system_without_a_temporary_folder_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(tempfile, "tempdir", "/nowhere/at/all")
    with pytest.raises(InputError, match=r"no folder for samples: No such file .*; set TMPDIR"):
        Spool()
