"""NovAtel logs of every header: their streams, units and clock, antenna and answers."""

import struct
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from tests.adapters.formats.novatel.files_of_logs import NOW_MS, ONE, opened

from floatref import Epoch
from floatref_adapters.formats.novatel.adapter import NovAtel
from floatref_adapters.testing.novatel import ascii_log, binary_log, long_log, short_log, text_log
from floatref_adapters.testing.whole_reading import stream_of, table_of


def test_streams_say_their_units_and_their_clock(tmp_path: Path) -> None:
    of = stream_of(opened(tmp_path, binary_log(ONE)), "BESTPOS")
    units = {column.name: column.unit for column in of.columns}
    assert (units["latitude"], units["height"], units["diff_age"]) == ("deg", "m", "s")
    assert (units["position_type"], units["ellipsoidal_height"]) == ("", "m")
    assert (of.clock.epoch, of.clock.tick_s * 1000, of.clock.origin_ns) == (Epoch.GPS, 1, 0)
    velocity = stream_of(opened(tmp_path, binary_log(ONE)), "BESTVEL")
    assert {c.name: c.unit for c in velocity.columns}["z"] == "m/s"


def test_short_headers_are_read(tmp_path: Path) -> None:
    body = struct.pack("<Iddddddddddi", 2300, 12.5, -33.5, 151.25, 42.5, 1, 2, 3, 4, 5, 6, 3)
    values, ticks = table_of(
        stream_of(opened(tmp_path, short_log(508, NOW_MS + 12_500, body)), "INSPVAS")
    )
    assert ticks.tolist() == [NOW_MS + 12_500]
    assert (values["latitude"][0], values["height"][0], values["up_vel"][0]) == (-33.5, 42.5, 3)
    assert values["pitch"][0] == 5


def test_two_antennas_are_two_streams(tmp_path: Path) -> None:
    first = ascii_log(ONE).splitlines()[0]
    fields = first.partition(b";")[2].partition(b"*")[0].decode()
    second = text_log("BESTPOSA_1", NOW_MS, 0xB1F6, fields, "FINE")
    file = opened(tmp_path, first + b"\n" + second)
    assert [s.name for s in file.streams] == ["BESTPOS", "BESTPOS_1"]
    assert [s.count for s in file.streams] == [1, 1]


def test_the_kind_of_a_binary_log_tells_its_antenna_and_answers(tmp_path: Path) -> None:
    body = binary_log(ONE)[28:100]
    log = b"".join(long_log(42, NOW_MS, body, kind=kind) for kind in (0, 0x11, 0x80, 0x11))
    file = opened(tmp_path, log)
    assert {s.name: s.count for s in file.streams} == {"BESTPOS": 1, "BESTPOS_17": 2}
    assert file.warnings == ("1 answers to commands: not read",)


@settings(deadline=None)
@given(ahead=st.binary(max_size=40), behind=st.binary(max_size=400))
def test_three_bytes_of_another_file_are_no_log(
    tmp_path_factory: pytest.TempPathFactory, ahead: bytes, behind: bytes
) -> None:
    path = tmp_path_factory.mktemp("run") / "run.parquet"
    path.write_bytes(b"PAR1" + ahead + b"\xaaD\x13" + behind)
    assert not NovAtel().recognises(path)
    path.write_bytes(path.read_bytes() + short_log(508, NOW_MS, bytes(80)))
    assert NovAtel().recognises(path)
