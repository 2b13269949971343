"""Damaged and strange NovAtel logs: told, dropped or refused, and never trusted."""

import struct
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from tests.adapters.formats.novatel.files_of_logs import NOW_MS, ONE, WEEK_MS, opened

from floatref import InputError
from floatref_adapters.formats.novatel.adapter import NovAtel
from floatref_adapters.testing.novatel import ascii_log, binary_log, long_log, short_log, text_log
from floatref_adapters.testing.whole_reading import read_or_refused, stream_of, table_of


def test_a_wrong_checksum_drops_a_log_and_is_told(tmp_path: Path) -> None:
    sound, text = binary_log(ONE), ascii_log(ONE)
    bad = bytearray(sound + text)
    bad[60] ^= 1
    bad[len(sound) + 120] ^= 1
    file = opened(tmp_path, bytes(bad) + sound)
    assert {s.name: s.count for s in file.streams} == {"BESTPOS": 2 - 1, "BESTVEL": 3}
    assert any(line.startswith("2 beginnings of a log") for line in file.warnings)


def test_logs_without_gps_time_are_dropped_and_coarse_ones_told(tmp_path: Path) -> None:
    fields = ascii_log(ONE).partition(b";")[2].partition(b"*")[0].decode()
    log = b"\n".join(
        text_log("BESTPOSA", NOW_MS + k, 0xB1F6, fields, status)
        for k, status in enumerate(["UNKNOWN", "APPROXIMATE", "COARSE", "FREEWHEELING", "FINE"])
    )
    file = opened(tmp_path, log)
    assert table_of(stream_of(file, "BESTPOS"))[1].tolist() == [NOW_MS + k for k in (2, 3, 4)]
    assert (
        "BESTPOS: 2 logs without GPS time (status below coarse, or week 0): dropped"
        in file.warnings
    )
    assert "BESTPOS: 2 logs with a coarse or drifting time: taken as they are" in file.warnings


def inertial(ms: int) -> bytes:
    """Return a log of INSPVAS, whose short header says nothing of the time but the time."""
    week, of_week = divmod(ms, WEEK_MS)
    motion = 151.25, 42.5, 1, 2, 3, 4, 5, 6
    body = struct.pack("<Iddddddddddi", week, of_week / 1000, -33.5, *motion, 3)
    return short_log(508, ms, body)


def test_a_short_header_before_the_time_is_known_is_dropped(tmp_path: Path) -> None:
    file = opened(tmp_path, inertial(5000) + inertial(NOW_MS))
    assert table_of(stream_of(file, "INSPVAS"))[1].tolist() == [NOW_MS]
    assert file.warnings == (
        "INSPVAS: 1 logs without GPS time (status below coarse, or week 0): dropped",
    )


def test_a_week_that_rolled_over_unseen_is_told(tmp_path: Path) -> None:
    early = NOW_MS - 2048 * WEEK_MS
    file = opened(tmp_path, inertial(early) + inertial(early + 10))
    assert stream_of(file, "INSPVAS").count == 2
    (line,) = file.warnings
    assert line.startswith("INSPVAS: 2 logs of a GPS week below 1024")


@pytest.mark.parametrize("size", [0, 1, 40, 71])
def test_a_log_shorter_than_its_definition_never_reaches_the_decoder(
    tmp_path: Path, size: int
) -> None:
    file = opened(tmp_path, long_log(42, NOW_MS, bytes(size)) + binary_log(ONE))
    assert stream_of(file, "BESTPOS").count == 1
    assert "BESTPOS: 1 logs that do not fit their definition: dropped" in file.warnings


def test_lists_and_unknown_logs_are_listed_or_told(tmp_path: Path) -> None:
    wild = long_log(43, NOW_MS, b"\xff" * 100) + long_log(65_000, NOW_MS, bytes(8))
    file = opened(tmp_path, wild + binary_log(ONE))
    assert stream_of(file, "RANGE").columns == ()
    assert "RANGE: 1 logs with lists of varying length: not decoded" in file.warnings
    assert "65000: 1 logs that novatel_edie does not know: not decoded" in file.warnings


def test_sentences_between_logs_are_told(tmp_path: Path) -> None:
    gga = b"$GPGGA,123519,4807.038,N,01131.000,E,1,08,0.9,545.4,M,46.9,M,,*47\r\n"
    file = opened(tmp_path, gga * 3 + ascii_log(ONE) + gga)
    assert "4 of these are NMEA 0183 sentences; read them with the adapter nmea" in file.warnings


def test_time_that_goes_back_is_told(tmp_path: Path) -> None:
    early = long_log(42, NOW_MS - 1000, binary_log(ONE)[28:100])
    file = opened(tmp_path, binary_log(ONE) + early)
    assert "BESTPOS: time goes back 1 times" in file.warnings


@pytest.mark.parametrize("content", [b"", b"\xaaD\x12", b"#BESTPOSA,", b"\xaaD\x13" * 50, b"abc"])
def test_a_file_without_a_log_is_refused_in_one_line(tmp_path: Path, content: bytes) -> None:
    with pytest.raises(InputError, match=r"run\.gps: no NovAtel log that is sound"):
        opened(tmp_path, content)


def test_beginnings_without_end_are_given_up(tmp_path: Path) -> None:
    start = b"\xaaD\x12\x1c" + bytes(4) + struct.pack("<H", 32_000)
    with pytest.raises(InputError, match="beginnings of NovAtel logs throughout"):
        opened(tmp_path, start * 300_000)


@pytest.mark.slow
@settings(deadline=None, max_examples=150)
@given(data=st.data())
def test_mutated_files_are_read_or_refused(
    tmp_path_factory: pytest.TempPathFactory, data: st.DataObject
) -> None:
    log = bytearray(binary_log(ONE) + b"\r\n" + ascii_log(ONE) + b"\r\n[COM1]" + binary_log(ONE))
    for _ in range(data.draw(st.integers(1, 5))):
        at = data.draw(st.integers(0, len(log)))
        log[at : at + data.draw(st.integers(0, 60))] = data.draw(st.binary(max_size=8))
    path = tmp_path_factory.mktemp("mutated") / "run.gps"
    path.write_bytes(log)
    read_or_refused(NovAtel(), path, {})


@pytest.mark.slow
@settings(deadline=None, max_examples=150)
@given(data=st.data())
def test_strange_logs_with_a_right_checksum_do_no_harm(
    tmp_path_factory: pytest.TempPathFactory, data: st.DataObject
) -> None:
    parts = [binary_log(ONE)]
    for _ in range(data.draw(st.integers(1, 4))):
        number = data.draw(st.sampled_from([42, 43, 48, 99, 140, 174, 507, 812, 1465, 2267]))
        body = data.draw(st.binary(max_size=250))
        parts.append(data.draw(st.sampled_from([long_log, short_log]))(number, NOW_MS, body))
    text = data.draw(st.text(st.characters(min_codepoint=32, max_codepoint=126), max_size=80))
    parts.append(text_log("BESTPOSA", NOW_MS, 0xB1F6, text, "FINE"))
    path = tmp_path_factory.mktemp("strange") / "run.gps"
    path.write_bytes(b"\r\n".join(parts))
    assert read_or_refused(NovAtel(), path, {})
