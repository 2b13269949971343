"""Damaged CAN logs of python-can's writers: read or refused in a line, and nothing stays behind.

Where a BLF log is deflated, damage to its bytes ends in its sums; so objects are damaged before
they are packed. In logs of text whole fields and lines are exchanged, lost, doubled or cut.
"""

import gc
import struct
import tracemalloc
import zlib
from collections.abc import Mapping
from pathlib import Path

import can
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from tests.adapters.formats.can_log.files_of_frames import logged

from floatref import InputError
from floatref_adapters.formats.can_log.adapter import CanLog
from floatref_adapters.testing.can_log import WHEELS_DBC, WHEELS_ID, wheels_data
from floatref_adapters.testing.whole_reading import table_of

pytestmark = pytest.mark.slow
damage = settings(deadline=None)
HEADER, OBJECTS = 144, 16 + 16
"""Bytes of a BLF log before its container, and of the container before its objects."""
MOST_BYTES = 64 << 20
NUMBERS = st.sampled_from([0, 1, 2, 16, 255, 2**16 - 1, 2**31, 2**32 - 1])
PLACES = st.integers(0, 999)
"""Places in a text whose length differs from log to log: python-can writes the date into it."""
FIELDS = st.sampled_from(
    ["", "-1", "0", "1e300", "nan", "99999999999.9", "9" * 60, "FFFFFFFF", "x", "65", "\0", "é"]
)


def check(path: Path, folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Assert that a log is read or refused, in bounded memory, and leaves no temporary file."""
    temporary = folder / "temporary"
    temporary.mkdir()
    monkeypatch.setattr("tempfile.tempdir", str(temporary))
    (folder / "bus.dbc").write_text(WHEELS_DBC, encoding="utf-8")
    tracemalloc.start()
    for options in ({}, {"dbc": str(folder / "bus.dbc")}):
        line = read(path, options)
        assert "\n" not in line
        assert not line or path.name in line
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    gc.collect()
    assert peak < MOST_BYTES
    assert list(temporary.iterdir()) == []


def read(path: Path, options: Mapping[str, str]) -> str:
    """Read all rows of a log; return why it is refused, "" if it is not."""
    try:
        with CanLog().streams(path, options) as native:
            for stream in native.streams:
                values, ticks = table_of(stream)
                assert {len(ticks), *map(len, values.values())} == {stream.count}
    except InputError as error:
        return str(error)
    return ""


def write_blf(path: Path) -> bytearray:
    """Write a log whose objects are stored as they are, and return it."""
    with can.BLFWriter(str(path), compression_level=0) as log:
        for k in range(12):
            content = {"arbitration_id": WHEELS_ID, "data": wheels_data([k] * 4)}
            log(can.Message(k / 64, is_extended_id=False, is_fd=k % 3 == 2, channel=0, **content))
    return bytearray(path.read_bytes())


def deflate(log: bytearray) -> bytes:
    """Return the log with the objects of its one container deflated."""
    objects = bytes(log[HEADER + OBJECTS :])
    packed = zlib.compress(objects)
    head = struct.pack("<4sHHLL", b"LOBJ", 16, 1, OBJECTS + len(packed), 10)
    size = struct.pack("<H6xL4x", 2, len(objects))
    return bytes(log[:HEADER]) + head + size + packed + bytes((OBJECTS + len(packed)) % 4)


@damage
@given(data=st.data(), deflated=st.booleans())
def test_objects_of_a_blf_log_that_are_damaged(
    tmp_path_factory: pytest.TempPathFactory, data: st.DataObject, deflated: bool
) -> None:
    folder = tmp_path_factory.mktemp("blf")
    log = write_blf(folder / "run.blf")
    first = HEADER + OBJECTS if deflated else 0
    for _ in range(data.draw(st.integers(1, 6))):
        width = data.draw(st.sampled_from([1, 2, 4]))
        at = data.draw(st.integers(first, len(log) - width))
        number = data.draw(NUMBERS) % 2 ** (8 * width)
        log[at : at + width] = number.to_bytes(width, "little")
    del log[data.draw(st.integers(first, len(log)) | st.just(len(log))) :]
    (folder / "run.blf").write_bytes(deflate(log) if deflated else bytes(log))
    with pytest.MonkeyPatch.context() as patched:
        check(folder / "run.blf", folder, patched)


@damage
@given(data=st.data(), form=st.sampled_from(["asc", "log", "trc", "csv"]))
def test_fields_and_lines_of_a_text_log_that_are_damaged(
    tmp_path_factory: pytest.TempPathFactory, data: st.DataObject, form: str
) -> None:
    folder = tmp_path_factory.mktemp(form)
    path = folder / f"run.{form}"
    content = logged(path, [wheels_data([k] * 4) for k in range(8)])
    lines = content.decode("ascii").split("\n")
    for _ in range(data.draw(st.integers(1, 5))):
        at = data.draw(PLACES) % len(lines)
        fields = lines[at].split(" ")
        place = data.draw(PLACES) % len(fields)
        act = data.draw(st.sampled_from(["field", "lose", "double", "move", "cut"]))
        if act == "field":
            fields[place] = data.draw(FIELDS)
            lines[at] = " ".join(fields)
        elif act == "lose" and len(lines) > 1:
            del lines[at]
        elif act == "double":
            lines.insert(at, lines[at])
        elif act == "move":
            lines.insert(data.draw(PLACES) % len(lines), lines.pop(at))
        else:
            lines[at] = lines[at][: data.draw(PLACES) % (len(lines[at]) + 1)]
    path.write_bytes("\n".join(lines).encode("utf-8"))
    with pytest.MonkeyPatch.context() as patched:
        check(path, folder, patched)
