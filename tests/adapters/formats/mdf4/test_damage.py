"""MDF 4 that is damaged or unfinished: read as far as it goes, or refused in one line."""

import contextlib
import os
import random
import signal
import struct
import subprocess
import sys
import tempfile
import tracemalloc
import zlib
from functools import partial
from itertools import islice
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from tests.adapters.damage import with_wrong_numbers

from floatref import InputError
from floatref_adapters.formats.mdf4.adapter import Mdf4
from floatref_adapters.formats.mdf4.mdf_opening import SPARE
from floatref_adapters.testing.mdf4 import (
    MASTER,
    VALUE,
    VIRTUAL_MASTER,
    Stored,
    StoredGroup,
    write,
)
from floatref_adapters.testing.whole_reading import read_whole, refusal

NS = (1e-9, 0.0)
KILLED = """
import os, signal, sys
from pathlib import Path
from floatref_adapters.formats.mdf4.adapter import Mdf4
opened = Mdf4().streams(Path(sys.argv[1]), {})
os.kill(os.getpid(), signal.SIGKILL)
"""
read = partial(read_whole, Mdf4())
refused = partial(refusal, Mdf4())


def small(path: Path, compressed: bool = False) -> bytes:
    """Write a small file of two groups to ``path`` and return its bytes."""
    n = 6
    master = Stored("t", np.arange(n), "s", NS, MASTER)
    virtual = Stored("t", np.empty(n, "V0"), "s", (0.1, 0.0), VIRTUAL_MASTER)
    x = Stored("x", np.arange(n, dtype="i2"), "m", (0.5, 1.0), VALUE, np.arange(n) % 2 == 0)
    groups = [StoredGroup("a", [master, x], 0, compressed), StoredGroup("b", [virtual, x])]
    write(groups, path)
    return path.read_bytes()


@pytest.mark.slow
@pytest.mark.parametrize("compressed", [False, True])
def test_a_damaged_file_is_refused_or_read_and_nothing_else(
    tmp_path: Path, compressed: bool
) -> None:
    path, draw = tmp_path / "a.mf4", random.Random(compressed)
    sound = small(path, compressed)
    for damaged in islice(with_wrong_numbers(sound, draw, 8), 150):
        path.write_bytes(damaged)
        with contextlib.suppress(InputError):
            _, numbers = read(path)
            assert all(len(v) <= 6 for values, _ in numbers for v in values.values())


def patched(path: Path, sound: bytes, kind: bytes, offset: int, layout: str, *values: int) -> None:
    """Write ``sound`` to ``path`` with ``values`` at ``offset`` of its first block of ``kind``."""
    damaged = bytearray(sound)
    struct.pack_into(layout, damaged, sound.index(b"##" + kind) + offset, *values)
    path.write_bytes(damaged)


def test_more_rows_than_there_are_is_told_and_those_there_are_delivered(tmp_path: Path) -> None:
    path = tmp_path / "a.mf4"
    sound = small(path)
    patched(path, sound, b"CG", 24 + 48 + 8, "<Q", 2**60)
    native, numbers = read(path)
    assert sorted(stream.count for stream in native.streams) == [6, 6]
    assert {len(values["x"]) for values, _ in numbers} == {6}
    assert f"{2**60 - 6} of {2**60} rows are missing" in native.warnings[0]


def write_unfinished(path: Path) -> bytes:
    """Write a recording that was not finished to ``path``; return its bytes."""
    master = Stored("t", np.arange(5), "s", NS, MASTER)
    write([StoredGroup("g", [master, Stored("x", np.arange(5.0))])], path)
    unfinished = bytearray(path.read_bytes())
    struct.pack_into("<8s", unfinished, 0, b"UnFinMF ")
    struct.pack_into("<H", unfinished, 60, 0b101)
    struct.pack_into("<Q", unfinished, unfinished.index(b"##CG") + 24 + 48 + 8, 0)
    struct.pack_into("<Q", unfinished, unfinished.index(b"##DT") + 8, 24)
    path.write_bytes(unfinished)
    return bytes(unfinished)


def test_an_unfinished_recording_is_read_as_far_as_it_goes(tmp_path: Path) -> None:
    path = tmp_path / "a.mf4"
    unfinished = write_unfinished(path)
    assert Mdf4().recognises(path)
    _, [(values, ticks)] = read(path)
    np.testing.assert_array_equal(values["x"], np.arange(5.0))
    np.testing.assert_array_equal(ticks, np.arange(5))
    assert path.read_bytes() == unfinished


@pytest.mark.slow
def test_nothing_of_an_unfinished_recording_is_left(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path, temporary = tmp_path / "a.mf4", tmp_path / "temporary"
    temporary.mkdir()
    monkeypatch.setattr(tempfile, "tempdir", str(temporary))
    unfinished = write_unfinished(path)
    refusals = []
    for damaged in islice(with_wrong_numbers(unfinished, random.Random(3), 2), 40):
        path.write_bytes(damaged)
        try:
            read(path)
        except InputError as error:
            refusals.append(str(error))
        assert not list(temporary.iterdir())
    # Some of them behind the copy, which asammdf stumbles over.
    assert any("asammdf cannot read it" in text for text in refusals)


@pytest.mark.slow
@pytest.mark.posix
@pytest.mark.skipif(not Path("/proc/self").exists(), reason="nothing tells that a process ended")
def test_what_a_killed_process_left_of_it_the_next_one_removes(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path, temporary = tmp_path / "a.mf4", tmp_path / "temporary"
    temporary.mkdir()
    write_unfinished(path)
    environment = {**os.environ, "TMPDIR": str(temporary)}
    killed = subprocess.run([sys.executable, "-c", KILLED, str(path)], env=environment)
    assert killed.returncode == -signal.SIGKILL
    assert len(list(temporary.glob("floatref-*"))) == 1
    monkeypatch.setattr(tempfile, "tempdir", str(temporary))
    read(path)
    assert not list(temporary.iterdir())


def test_the_copy_of_an_unfinished_recording_needs_room(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    write_unfinished(tmp_path / "a.mf4")
    full = SimpleNamespace(total=1 << 40, used=1 << 40, free=SPARE)
    monkeypatch.setattr("shutil.disk_usage", lambda _: full)
    assert "set TMPDIR to a folder with more" in refused(tmp_path / "a.mf4")


def test_links_that_lead_in_a_ring_are_refused(tmp_path: Path) -> None:
    path = tmp_path / "a.mf4"
    sound = small(path)
    for kind in (b"CN", b"CG", b"DG", b"FH"):
        patched(path, sound, kind, 24, "<Q", sound.index(b"##" + kind))
        assert "has a wrong link to it" in refused(path)
    patched(path, sound, b"CC", 24 + 24, "<Q", sound.index(b"##CC"))
    read(path)
    conversion = bytearray(sound)
    start = sound.index(b"##CC")
    struct.pack_into("<QQ", conversion, start + 8, 24 + 5 * 8 + 40, 5)
    struct.pack_into("<Q", conversion, start + 24 + 32, start)
    path.write_bytes(conversion)
    assert "called in a loop" in refused(path)


def test_a_data_list_that_leads_to_itself_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "a.mf4"
    sound = small(path, compressed=True)
    patched(path, sound, b"DL", 24, "<Q", sound.index(b"##DL"))
    refused(path)


def test_a_compressed_block_gives_what_it_says_or_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "a.mf4"
    sound = small(path, compressed=True)
    patched(path, sound, b"DZ", 32, "<Q", 2**40)
    assert "says it holds 1099511627776 bytes" in refused(path)
    bomb = zlib.compress(bytes(1 << 26))
    head = struct.pack("<4s4xQQ2sBxIQQ", b"##DZ", 48 + len(bomb), 0, b"DT", 0, 0, 60, len(bomb))
    bombed = bytearray(sound) + head + bomb
    struct.pack_into("<Q", bombed, sound.index(b"##DL") + 32, len(sound))
    path.write_bytes(bombed)
    tracemalloc.start()
    why = refused(path)
    _, most = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert "does not hold 60 bytes" in why
    assert most < 1 << 24


def test_what_is_no_mdf_4_is_refused_in_one_line(tmp_path: Path) -> None:
    path = tmp_path / "a.mf4"
    for start in (b"", b"MDF     ", b"TDSm" + bytes(80)):
        path.write_bytes(start)
        assert Mdf4().recognises(path) == (start[:3] == b"MDF")
        assert "not an MDF file" in refused(path)
    assert not Mdf4().recognises(tmp_path / "none.mf4")
    assert "check the name" in refused(tmp_path / "none.mf4")


def test_without_asammdf_one_line_says_what_to_install(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    small(tmp_path / "a.mf4")
    monkeypatch.setitem(sys.modules, "asammdf", None)
    line = refused(tmp_path / "a.mf4")
    assert 'needs asammdf; run in a clone of floatref: pip install -e ".[adapters]"' in line
