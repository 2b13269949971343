"""A mapped file that is cut short while it is read is an InputError; no result is made of zeros."""

import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from floatref.files.mapped.cut_files import CutFile
from floatref.files.mapped.mapped_files import map_bytes
from floatref.files.samples import read_samples

pytestmark = pytest.mark.skipif(
    sys.platform != "linux", reason="other systems have no signal to spare, or cut no mapped file"
)
FOREIGN = """
import mmap, os, sys
from pathlib import Path
from floatref.files.mapped.mapped_files import map_bytes
map_bytes(Path(sys.argv[1]))
with open(sys.argv[2], "rb") as file:
    mapped = mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ)
os.truncate(sys.argv[2], 0)
mapped[50000]
"""
IN_A_THREAD = """
import os, sys, threading
from pathlib import Path
from floatref.files.mapped.mapped_files import map_bytes
mapped = map_bytes(Path(sys.argv[1]))
os.truncate(sys.argv[1], 0)
thread = threading.Thread(target=lambda: print(mapped.sum()))
thread.start()
thread.join()
print("not ended")
"""


@given(left=st.integers(0, 40_000), count=st.integers(1, 3))
def test_reading_behind_the_cut_raises(
    tmp_path_factory: pytest.TempPathFactory, left: int, count: int
) -> None:
    folder = tmp_path_factory.mktemp("cut")
    paths = [folder / f"{k}.f64" for k in range(count)]
    for path in paths:
        path.write_bytes(np.ones(20_000).tobytes())
    mapped = [read_samples(path) for path in paths]
    for path in paths:
        os.truncate(path, left)
    with pytest.raises(CutFile, match=r"\.f64: was cut short while it was read; wait until"):
        sum(float(values.sum()) for values in mapped)


def test_what_is_still_there_is_read(tmp_path: Path) -> None:
    path = tmp_path / "a"
    path.write_bytes(bytes(range(250)) * 400)
    mapped = map_bytes(path)
    os.truncate(path, 8192)
    assert mapped[:8192].tobytes() == path.read_bytes()


def test_a_file_that_grows_is_read_as_it_was(tmp_path: Path) -> None:
    path = tmp_path / "a"
    path.write_bytes(b"a" * 9000)
    mapped = map_bytes(path)
    with path.open("ab") as end:
        end.write(b"b" * 9000)
    assert mapped.size == 9000
    assert set(mapped.tobytes()) == set(b"a")


def test_a_file_cut_twice_raises_twice(tmp_path: Path) -> None:
    path = tmp_path / "a"
    path.write_bytes(b"a" * 100_000)
    mapped = map_bytes(path)
    for left in (50_000, 5_000):
        os.truncate(path, left)
        with pytest.raises(CutFile):
            mapped.sum()


@pytest.mark.slow
@pytest.mark.parametrize(("script", "code"), [(FOREIGN, -7), (IN_A_THREAD, 2)])
def test_what_cannot_be_raised_ends_the_process(tmp_path: Path, script: str, code: int) -> None:
    """A map that is not ours ends it as ever; ours in another thread with a line."""
    for name in "ab":
        (tmp_path / name).write_bytes(b"x" * 100_000)
    command = [sys.executable, "-c", script, str(tmp_path / "a"), str(tmp_path / "b")]
    done = subprocess.run(command, capture_output=True, text=True)
    assert done.returncode == code
    assert done.stdout == ""
    assert ("was cut short while it was read" in done.stderr) == (code == 2)
