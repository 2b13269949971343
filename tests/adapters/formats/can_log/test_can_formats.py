"""Formats of CAN logs: what python-can writes is read, and declared sizes are not trusted."""

import struct
import zlib
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from tests.adapters.formats.can_log.files_of_frames import logged, opened

from floatref import Epoch, InputError
from floatref_adapters.formats.can_log.adapter import CanLog
from floatref_adapters.testing.can_log import (
    FAST_ID,
    WHEELS_DBC,
    WHEELS_ID,
    asc_log,
    candump_log,
    wheels_data,
)
from floatref_adapters.testing.whole_reading import read_or_refused, stream_of, table_of

TRC = """;$FILEVERSION=1.1
;$STARTTIME=43008.920986006946
;
;---+--   ----+----  --+--  ----+---  +  -+ -- -- -- -- -- -- --
     1)         1.0  Rx         04B0  8  01 00 02 00 00 03 00 04
     2)        17.5  Rx         04B0  8  02 00 02 00 00 03 00 04
     3)        34.0  Rx     1A23B4C5  2  02 00
     4)        40.0  Error      0004  3  01 02 03
"""
CSV = """timestamp,arbitration_id,extended,remote,error,dlc,data
1704067200.015625,0x4b0,0,0,0,8,AQACAAADAAQ=
1704067200.03125,0x4b0,0,0,0,8,AgACAAADAAQ=
"""


@pytest.mark.parametrize("writer", ["asc", "blf", "csv", "log", "trc"])
def test_what_python_can_writes_is_read(tmp_path: Path, writer: str) -> None:
    name = f"run.{writer}"
    data = [wheels_data([k, 2 * k, 3 * k, 65535 - k]) for k in range(500)]
    file = opened(tmp_path, logged(tmp_path / name, data), name)
    values, ticks = table_of(stream_of(file, "WheelSpeeds"))
    np.testing.assert_allclose(values["RearLeft"], 0.03 * np.arange(500), rtol=1e-12)
    steps = np.diff(ticks) * float(stream_of(file, "WheelSpeeds").clock.tick_s)
    # TRC has whole us, CSV and candump the digits of a float; all have these times but for that.
    np.testing.assert_allclose(steps, 1 / 64, atol=2e-6)


def test_files_that_are_no_can_log_are_refused(tmp_path: Path) -> None:
    for name, content in (("a.asc", b"ncols 4\n"), ("b.blf", b"LOG"), ("c.log", b"(1) x\n")):
        path = tmp_path / name
        path.write_bytes(content)
        assert not CanLog().recognises(path)
        with pytest.raises(InputError, match="no CAN log of"):
            CanLog().streams(path, {})
    with pytest.raises(InputError, match="not a file"):
        CanLog().streams(tmp_path, {})
    path.write_text(asc_log([]))
    with pytest.raises(InputError, match="no CAN data frame that is sound"):
        CanLog().streams(path, {})


def blf(tmp_path: Path, frames: int = 40) -> bytes:
    """Return a BLF log of wheel speeds, as python-can writes it."""
    return logged(tmp_path / "written.blf", [wheels_data([k] * 4) for k in range(frames)])


def container(data: bytes, size: int | None = None) -> bytes:
    """Return a deflated BLF container of ``data``."""
    packed = zlib.compress(data, 9)
    declared = 32 + len(packed) if size is None else size
    head = struct.pack("<4sHHLL", b"LOBJ", 16, 1, declared, 10)
    return head + struct.pack("<H6xL4x", 2, len(data)) + packed + bytes(declared % 4)


@pytest.mark.parametrize(
    ("bad", "warning"),
    [
        (container(bytes(1 << 25)), "1 containers that are damaged or unpack to more than 16 MiB"),
        (container(struct.pack("<4sHHLLQQ", b"LOBJ", 32, 1, 0, 1, 0, 0)), "objects that are dam"),
        (container(struct.pack("<4sHHLLQQ", b"LOBJ", 32, 1, 33, 86, 0, 0)), "objects that are da"),
        (container(b"", 0xFFFFFFFF), "1 ends of the log that are cut off"),
        (container(b"", 8), "1 ends of the log that are cut off"),
        (b"JUNK" * 20, "1 ends of the log that are cut off"),
    ],
)
def test_a_blf_log_that_declares_wrong_sizes_keeps_what_is_sound(
    tmp_path: Path, bad: bytes, warning: str
) -> None:
    file = opened(tmp_path, blf(tmp_path) + bad, "run.blf")
    assert stream_of(file, "WheelSpeeds").count == 40
    assert any(warning in line for line in file.warnings)


@pytest.mark.parametrize("cut", [8, 20, 60])
def test_a_blf_log_that_is_cut_off_keeps_what_was_written(tmp_path: Path, cut: int) -> None:
    file = opened(tmp_path, blf(tmp_path)[:-cut], "run.blf")
    of = stream_of(file, "WheelSpeeds")
    assert 0 < of.count <= 40
    assert len(table_of(of)[1]) == of.count
    assert file.warnings


@pytest.mark.slow
@settings(deadline=None, max_examples=120)
@given(data=st.data(), form=st.sampled_from(["asc", "log", "blf", "trc", "csv"]))
def test_mutated_logs_are_read_or_refused(
    tmp_path_factory: pytest.TempPathFactory, data: st.DataObject, form: str
) -> None:
    folder = tmp_path_factory.mktemp("mutated")
    frames = [(10 * k, WHEELS_ID, wheels_data([k] * 4)) for k in range(6)]
    log = bytearray(
        {
            "asc": asc_log([*frames, (70, FAST_ID, bytes(16))]).encode(),
            "log": candump_log([*frames, (70, FAST_ID, bytes(16))]).encode(),
            "blf": blf(folder, 6) if form == "blf" else b"",
            "trc": TRC.encode(),
            "csv": CSV.encode(),
        }[form]
    )
    for _ in range(data.draw(st.integers(1, 4))):
        at = data.draw(st.integers(0, len(log)))
        log[at : at + data.draw(st.integers(0, 12))] = data.draw(st.binary(max_size=6))
    path = folder / f"run.{form}"
    path.write_bytes(log)
    (folder / "bus.dbc").write_text(WHEELS_DBC)
    read_or_refused(CanLog(), path, {})
    read_or_refused(CanLog(), path, {"dbc": str(folder / "bus.dbc")})


def test_a_peak_trace_is_read(tmp_path: Path) -> None:
    file = opened(tmp_path, TRC, "run.trc")
    values, ticks = table_of(stream_of(file, "WheelSpeeds"))
    assert ticks.tolist() == [1_000_000, 17_500_000]
    assert values["FrontLeft"].tolist() == [0.01, 0.02]
    assert values["RearRight"].tolist() == [0.04, 0.04]
    assert "1 frames of 1 ids not in the database: not decoded (0x1A23B4C5)" in file.warnings
    assert "1 events that are no data frames: not read" in file.warnings


def test_the_table_of_python_can_is_read(tmp_path: Path) -> None:
    of = stream_of(opened(tmp_path, CSV, "run.csv"), "WheelSpeeds")
    assert of.clock.epoch is Epoch.UTC
    values, ticks = table_of(of)
    assert ticks.tolist() == [1_704_067_200_015_625_000, 1_704_067_200_031_250_000]
    assert values["FrontLeft"].tolist() == [0.01, 0.02]
