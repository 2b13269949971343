"""Logs of real NovAtel receivers give what they hold."""

import struct
from pathlib import Path

import numpy as np
import pytest
from tests.adapters.formats.novatel.files_of_logs import WEEK_MS, opened

from floatref_adapters.formats.novatel.adapter import NovAtel
from floatref_adapters.testing.whole_reading import stream_of, table_of

DATA = Path(__file__).parent / "data"
EDIE, SWRI = DATA / "novatel-edie", DATA / "novatel-swri"


@pytest.mark.parametrize("ending", [b"\n", b"\r\n", b"\r"])
def test_ascii_logs_are_read_whatever_ends_their_lines(tmp_path: Path, ending: bytes) -> None:
    log = (EDIE / "BESTPOS_rows_1-3.GPS").read_bytes().replace(b"\n", ending)
    file = opened(tmp_path, log)
    assert file.warnings == ()
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
    assert (
        f"{answers} bytes between logs (prompts, answers, damaged logs): not read" in file.warnings
    )
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
    assert "7 bytes between logs (prompts, answers, damaged logs): not read" in file.warnings
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
