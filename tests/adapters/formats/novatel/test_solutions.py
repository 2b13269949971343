"""What NovAtel logs say of a solution: its quality, its latency, heights and angles."""

import struct
from pathlib import Path

import numpy as np
import pytest
from tests.adapters.formats.novatel.files_of_logs import NOW_MS, ONE, opened

from floatref_adapters.testing.novatel import ascii_log, binary_log, long_log, text_log
from floatref_adapters.testing.whole_reading import stream_of, table_of

KINDS = {0: 0, 1: 7, 2: 7, 8: 1, 16: 1, 17: 2, 18: 2, 19: 6, 20: 2, 32: 5, 33: 5, 34: 5}
KINDS |= {48: 4, 49: 4, 50: 4, 51: 4, 52: 2, 53: 1, 54: 2, 55: 5, 56: 4, 57: 2, 58: 5, 59: 5}
KINDS |= {64: 5, 65: 5, 66: 2, 68: 2, 69: 5, 73: 2, 74: 5, 75: 5, 76: 5, 77: 1, 78: 2, 79: 1, 80: 2}
"""Position types of the OEM7 manual, and the quality that its GPGGA table gives them."""


@pytest.mark.parametrize(("kind", "quality"), KINDS.items())
def test_the_kind_of_solution_is_a_quality_of_gga(tmp_path: Path, kind: int, quality: int) -> None:
    body = bytearray(binary_log(ONE)[28:100])
    body[4:8] = kind.to_bytes(4, "little")
    unsolved = b"\1" + bytes(body[1:])
    file = opened(tmp_path, long_log(42, NOW_MS, bytes(body)) + long_log(42, NOW_MS + 1, unsolved))
    values, _ = table_of(stream_of(file, "BESTPOS"))
    assert values["quality"].tolist() == [quality, 0]


@pytest.mark.parametrize("status", range(15))
def test_an_inertial_unit_that_aligns_has_no_solution(tmp_path: Path, status: int) -> None:
    body = struct.pack("<ii3df6d9fIH", status, 56, *range(19), 0, 0)
    values, _ = table_of(stream_of(opened(tmp_path, long_log(1465, NOW_MS, body)), "INSPVAX"))
    assert values["quality"].tolist() == [4 if status in (2, 3, 5, 6, 7) else 0]


def test_definitions_of_other_firmware_add_their_columns(tmp_path: Path) -> None:
    fields = ascii_log(ONE).partition(b";")[2].partition(b"*")[0].decode()
    log = b"\n".join(
        text_log("BESTPOSA", NOW_MS + k, definition, fields, "FINE")
        for k, definition in enumerate([0xB1F6, 0xCDBA])
    )
    values, _ = table_of(stream_of(opened(tmp_path, log), "BESTPOS"))
    np.testing.assert_array_equal(values["height"], [20, np.nan])
    np.testing.assert_array_equal(values["orthometric_height"], [np.nan, 20])
    assert values["ellipsoidal_height"].tolist() == [42.5, 42.5]


@pytest.mark.parametrize("log", [binary_log(ONE), ascii_log(ONE)])
def test_the_latency_of_velocities_is_told(tmp_path: Path, log: bytes) -> None:
    line = "BESTVEL: velocities of up to 0.15 s before their time stamps; state a delay_s"
    assert opened(tmp_path, log).warnings == (line,)


def test_angles_say_which_way_they_go(tmp_path: Path) -> None:
    unit = struct.pack("<ii3df6d9fIH", 3, 56, *range(19), 0, 0)
    pair = struct.pack("<ii6f4s4s8B", 0, 50, *range(6), b"", b"", *range(8))
    file = opened(tmp_path, long_log(1465, NOW_MS, unit) + long_log(1335, NOW_MS, pair))
    notes = {c.name: c.note for c in stream_of(file, "INSPVAX").columns}
    assert (notes["pitch"], notes["roll"]) == ("nose up positive", "left side up positive")
    notes = {c.name: c.note for c in stream_of(file, "HEADING2").columns}
    assert notes["pitch"] == "of the base line, up to the second antenna positive"


def test_a_value_that_is_not_finite_is_missing(tmp_path: Path) -> None:
    body = bytearray(binary_log(ONE)[28:100])
    struct.pack_into("<dfI4s", body, 24, float("inf"), float("-inf"), 61, b"\0\0\xc0\x7f")
    values, _ = table_of(stream_of(opened(tmp_path, long_log(42, NOW_MS, bytes(body))), "BESTPOS"))
    for name in ("height", "undulation", "latitude_std_dev", "ellipsoidal_height"):
        assert np.isnan(values[name]).all()
