"""NovAtel logs: what is written is read, real logs give what they hold, faults are told."""

import struct
from dataclasses import replace
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref import Epoch, NativeFile
from floatref_adapters.novatel.adapter import NovAtel
from floatref_adapters.testing.fixes import Fixes
from floatref_adapters.testing.novatel import (
    ascii_log,
    binary_log,
    long_log,
    short_log,
    text_log,
)
from floatref_adapters.testing.reading import stream_of, table_of
from floatref_adapters.text_lines import BLOCK

DATA = Path(__file__).parent / "data"
EDIE, SWRI = DATA / "novatel-edie", DATA / "novatel-swri"
WEEK_MS = 604_800_000
NOW_MS = 2300 * WEEK_MS
ONE = Fixes([NOW_MS], [-33.5], [151.25], [20.0], [22.5], [4], [20.0], [359.5], [-0.25])


def opened(folder: Path, content: bytes) -> NativeFile:
    """Return what the adapter finds in a file that holds ``content``."""
    path = folder / "run.gps"
    path.write_bytes(content)
    return NovAtel().streams(path, {})


@st.composite
def fixes(draw: st.DrawFn) -> Fixes:
    """Draw fixes anywhere on earth, many of them across the end of a GPS week."""
    rows = draw(st.integers(1, 10))
    step = draw(st.sampled_from([5, 50, 1000]))
    start = draw(st.sampled_from([1024, 2048, 2300])) * WEEK_MS + draw(st.integers(-3000, 3000))

    def column(low: float, high: float) -> list[float]:
        return draw(st.lists(st.floats(low, high), min_size=rows, max_size=rows))

    return Fixes(
        [start + step * k for k in range(rows)],
        column(-90, 90),
        column(-180, 180),
        column(-400, 9000),
        [round(x, 4) for x in column(-107, 86)],
        draw(st.lists(st.sampled_from([0, 1, 2, 4, 5]), min_size=rows, max_size=rows)),
        column(0, 90),
        column(0, 359.9),
        column(-5, 5),
    )


@settings(deadline=None, max_examples=60)
@given(
    drawn=fixes(),
    form=st.sampled_from([b"\n", b"\r", b"\r\n", b""]),
    junk=st.sampled_from([b"", b"\r\n<OK\r\n[ICOM1]", b"\xaaD\x12", b"#BESTPOSA,", b"\n\n"]),
)
def test_every_fix_comes_back(
    tmp_path_factory: pytest.TempPathFactory, drawn: Fixes, form: bytes, junk: bytes
) -> None:
    log = ascii_log(drawn, form) if form else binary_log(drawn)
    file = opened(tmp_path_factory.mktemp("novatel"), junk + b"\n" + log + junk)
    position, ticks = table_of(stream_of(file, "BESTPOS"))
    velocity, _ = table_of(stream_of(file, "BESTVEL"))
    np.testing.assert_array_equal(ticks, drawn.ms)
    text = bool(form)
    single = np.spacing(np.float32(107))
    height = np.array(drawn.altitude_m) + drawn.separation_m
    for found, expected, quantum in (
        (position["latitude"], drawn.latitude_deg, text * 0.51e-11),
        (position["longitude"], drawn.longitude_deg, text * 0.51e-11 + 3e-14),
        (position["height"], drawn.altitude_m, text * 0.51e-4),
        (position["ellipsoidal_height"], height, text * 0.51e-4 + single),
        (position["quality"], drawn.quality, 0),
        (velocity["quality"], drawn.quality, 0),
        (velocity["horizontal_speed"], drawn.speed_m_s, text * 0.51e-4),
        (velocity["ground_track"], drawn.course_deg, text * 0.51e-6),
        (velocity["z"], drawn.up_m_s, text * 0.51e-4),
    ):
        np.testing.assert_allclose(found, expected, rtol=0, atol=quantum)


def test_streams_say_their_units_and_their_clock(tmp_path: Path) -> None:
    of = stream_of(opened(tmp_path, binary_log(ONE)), "BESTPOS")
    units = {column.name: column.unit for column in of.columns}
    assert (units["latitude"], units["height"], units["diff_age"]) == ("deg", "m", "s")
    assert (units["position_type"], units["ellipsoidal_height"]) == ("", "m")
    assert (of.clock.epoch, of.clock.tick_s * 1000, of.clock.origin_ns) == (Epoch.GPS, 1, 0)
    velocity = stream_of(opened(tmp_path, binary_log(ONE)), "BESTVEL")
    assert {c.name: c.unit for c in velocity.columns}["z"] == "m/s"


@pytest.mark.parametrize("ending", [b"\n", b"\r\n", b"\r"])
def test_ascii_logs_are_read_whatever_ends_their_lines(tmp_path: Path, ending: bytes) -> None:
    log = (EDIE / "BESTPOS_rows_1-3.GPS").read_bytes().replace(b"\n", ending)
    file = opened(tmp_path, log)
    assert file.told == ()
    values, ticks = table_of(stream_of(file, "BESTPOS"))
    assert ticks.tolist() == [1984 * WEEK_MS + 450_849_500] * 3
    assert values["latitude"].tolist() == [51.11637049360] * 3
    assert values["longitude"].tolist() == [-114.03827102462] * 3
    assert values["height"].tolist() == [1059.7447] * 3
    assert values["num_svs"].tolist() == [20] * 3


def test_ascii_and_binary_logs_with_prompts_between_are_one_stream() -> None:
    path = EDIE / "BESTUTMBIN.GPS"
    assert NovAtel().recognises(path)
    file = NovAtel().streams(path, {})
    assert {s.name: s.count for s in file.streams} == {"BESTUTM": 2, "VERSION": 1}
    answers = path.read_bytes().count(b"<OK\n[USB1]") * len(b"<OK\n[USB1]")
    assert f"{answers} bytes between logs (prompts, answers, damaged logs): not read" in file.told
    values, ticks = table_of(stream_of(file, "BESTUTM"))
    text = (EDIE / "BESTUTMBIN.GPS.ASCII").read_text().splitlines()[0]
    header, _, body = text.partition(";")
    fields = body.split(",")
    assert ticks[1] == 2237 * WEEK_MS + 270_605_000
    assert header.split(",")[5:7] == ["2237", "270605.000"]
    assert values["northing"][1] == float(fields[4])
    assert values["easting"][1] == float(fields[5])
    assert values["height"][1] == float(fields[6])
    assert values["ellipsoidal_height"][1] == float(fields[6]) + float(fields[7])
    assert values["quality"].tolist() == [2, 2]
    assert (np.abs(np.diff(values["northing"])) < 1).all()


def test_real_receivers_behind_prompts_are_read_to_the_last_byte() -> None:
    file = NovAtel().streams(SWRI / "bestpos-bestvel-psrdop2-sync.gps", {})
    counts = {s.name: s.count for s in file.streams}
    assert counts == {"BESTPOS": 33, "BESTVEL": 33, "PSRDOP2": 33}
    assert "7 bytes between logs (prompts, answers, damaged logs): not read" in file.told
    content = (SWRI / "bestpos-bestvel-psrdop2-sync.gps").read_bytes()
    at = content.index(b"\xaaD\x12\x1c\x2a\x00")
    values, ticks = table_of(stream_of(file, "BESTPOS"))
    week, ms = struct.unpack_from("<HI", content, at + 14)
    assert ticks[0] == week * WEEK_MS + ms
    assert values["latitude"][0] == struct.unpack_from("<d", content, at + 28 + 8)[0]
    assert values["height"][0] == struct.unpack_from("<d", content, at + 28 + 24)[0]
    assert np.diff(ticks).tolist() == [100] * 32


def test_an_inertial_receiver_gives_heights_and_turns() -> None:
    file = NovAtel().streams(SWRI / "corrimudata.gps", {})
    counts = {s.name: s.count for s in file.streams}
    expected = {"BESTPOS": 28, "CORRIMUDATA": 29, "INSCOV": 2, "INSPVAX": 28, "TIME": 2}
    assert counts == expected
    position, _ = table_of(stream_of(file, "BESTPOS"))
    inertial, ticks = table_of(stream_of(file, "INSPVAX"))
    # The antenna and the unit of one vehicle at rest.
    assert np.abs(inertial["ellipsoidal_height"] - position["ellipsoidal_height"]).max() < 1
    assert np.abs(inertial["latitude"] - position["latitude"]).max() < 1e-5
    rates, stamps = table_of(stream_of(file, "CORRIMUDATA"))
    np.testing.assert_allclose(rates["week"] * WEEK_MS + rates["seconds"] * 1000, stamps, atol=0.5)
    assert (np.diff(ticks) == 50).all()


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
    assert file.told == ("1 answers to commands: not read",)


def test_logs_across_the_blocks_of_a_large_file_are_all_found(tmp_path: Path) -> None:
    log = binary_log(ONE) + ascii_log(ONE) + b"[ICOM1]"
    times = 3_500_000 // len(log)
    file = opened(tmp_path, log * times)
    assert {s.name: s.count for s in file.streams} == {"BESTPOS": 2 * times, "BESTVEL": 2 * times}
    assert f"{7 * times} bytes between logs (prompts, answers, damaged logs): not read" in file.told


def test_the_clock_counts_on_over_the_end_of_a_week(tmp_path: Path) -> None:
    body = binary_log(ONE)[28:100]
    log = b"".join(long_log(42, NOW_MS + ms, body) for ms in (-100, -50, 0, 50))
    _, ticks = table_of(stream_of(opened(tmp_path, log), "BESTPOS"))
    assert [b - a for a, b in pairwise(ticks.tolist())] == [50] * 3


@pytest.mark.parametrize("ahead", [1, 2, 3, 9, 15, 27, 60, 103])
@pytest.mark.parametrize("log", [binary_log(ONE), ascii_log(ONE), ascii_log(ONE, b"\n")])
def test_a_log_that_begins_in_one_block_and_ends_in_the_next_is_found(
    tmp_path: Path, log: bytes, ahead: int
) -> None:
    file = opened(tmp_path, b"." * (BLOCK - ahead) + log)
    assert {s.name: s.count for s in file.streams} == {"BESTPOS": 1, "BESTVEL": 1}
    assert f"{BLOCK - ahead} bytes between logs" in file.told[0]


def test_a_binary_log_of_any_week_and_status_is_recognised(tmp_path: Path) -> None:
    path = tmp_path / "run.gps"
    for week in range(2300, 2300 + 256):
        path.write_bytes(binary_log(replace(ONE, ms=[week * WEEK_MS])))
        assert NovAtel().recognises(path), week
    for status in (20, 60, 180, 240):
        path.write_bytes(long_log(42, NOW_MS, bytes(72), status))
        assert NovAtel().recognises(path), status
