"""NMEA 0183: what is written is read, published sentences say what they say, faults are told."""

import math
import re
from datetime import UTC, datetime
from functools import reduce
from operator import xor
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray
from tests.adapters.drawn_fixes import draw_fixes

from floatref import Epoch, InputError, NativeFile, Stream
from floatref_adapters.formats.nmea.adapter import Nmea
from floatref_adapters.testing.fixes import Fixes
from floatref_adapters.testing.nmea import (
    ANGLE_QUANTUM_DEG,
    HEIGHT_QUANTUM_M,
    SPEED_QUANTUM_KMH,
    nmea_log,
    sentence,
)
from floatref_adapters.testing.whole_reading import Table, read_or_refused, stream_of, table_of

MIDNIGHT_MS = int(datetime(2024, 2, 29, tzinfo=UTC).timestamp()) * 1000
GGA = "$GPGGA,123519,4807.038,N,01131.000,E,1,08,0.9,545.4,M,46.9,M,,*47"
RMC = "$GPRMC,123519,A,4807.038,N,01131.000,E,022.4,084.4,230394,003.1,W*6A"
VTG = "$GPVTG,054.7,T,034.4,M,005.5,N,010.2,K*48"
GST = "$GPGST,172814.0,0.006,0.023,0.020,273.6,0.023,0.020,0.031*6A"
PASHR = "$PASHR,130533.620,0.311,T,-80.467,-1.395,,0.066,0.067,0.215,2,3*0B"
AIS = "!AIVDM,1,1,,B,177KQJ5000G?tO`K>RA1wUbN0TKH,0*5C"
ENDINGS = ("\n", "\r", "\r\n")


@st.composite
def fixes(draw: st.DrawFn) -> Fixes:
    """Draw fixes at 1 to 50 Hz, many of them across a midnight."""
    start = MIDNIGHT_MS + draw(st.integers(-3000, 3000)) + draw(st.integers(0, 5000)) * 86_400_000
    return draw_fixes(draw, start, [20, 50, 100, 1000], 15)


def opened(folder: Path, content: bytes | str) -> NativeFile:
    """Return what the adapter finds in a file that holds ``content``."""
    path = folder / "run.txt"
    path.write_bytes(content.encode("latin-1") if isinstance(content, str) else content)
    return Nmea().streams(path, {})


def rows(of: Stream) -> tuple[Table, NDArray[np.int64]]:
    """Return all columns and the ns since the epoch of every row."""
    values, ticks = table_of(of)
    unit = of.clock.tick_s * 10**9
    assert unit.denominator == 1
    return values, of.clock.origin_ns + ticks * unit.numerator


@pytest.mark.slow
@settings(deadline=None, max_examples=40)
@given(
    drawn=fixes(),
    ending=st.sampled_from(ENDINGS),
    mark=st.sampled_from([b"", b"\xef\xbb\xbf"]),
    talker=st.sampled_from(["GP", "GN", "GL"]),
)
def test_every_fix_comes_back(
    tmp_path_factory: pytest.TempPathFactory,
    drawn: Fixes,
    ending: str,
    mark: bytes,
    talker: str,
) -> None:
    content = mark + nmea_log(drawn, talker, ending)
    file = opened(tmp_path_factory.mktemp("nmea"), content)
    assert file.warnings == ()
    expected_ns = np.array(drawn.ms) * 10**6
    for name in ("GGA", "RMC", "VTG", "GST"):
        assert stream_of(file, name).count == len(drawn.ms)
        np.testing.assert_array_equal(rows(stream_of(file, name))[1], expected_ns)
        assert stream_of(file, name).clock.epoch is Epoch.UTC
    gga, vtg = rows(stream_of(file, "GGA"))[0], rows(stream_of(file, "VTG"))[0]
    height = np.array(drawn.altitude_m) + drawn.separation_m
    half = 0.5001
    for found, expected, quantum in (
        (gga["latitude"], drawn.latitude_deg, half * ANGLE_QUANTUM_DEG + 1e-12),
        (gga["longitude"], drawn.longitude_deg, half * ANGLE_QUANTUM_DEG + 1e-12),
        (gga["altitude"], drawn.altitude_m, half * HEIGHT_QUANTUM_M),
        (gga["ellipsoidal_height"], height, 2 * half * HEIGHT_QUANTUM_M),
        (gga["quality"], drawn.quality, 0),
        (vtg["speed"], np.array(drawn.speed_m_s) * 3.6, half * SPEED_QUANTUM_KMH),
    ):
        np.testing.assert_allclose(found, expected, rtol=0, atol=quantum)


def test_published_sentences_say_what_their_descriptions_say(tmp_path: Path) -> None:
    file = opened(tmp_path, "\n".join([GGA, RMC, VTG, GST, PASHR, AIS]))
    values, ns = rows(stream_of(file, "GGA"))
    assert values["latitude"][0] == pytest.approx(48 + 7.038 / 60, abs=1e-12)
    assert values["longitude"][0] == pytest.approx(11 + 31 / 60, abs=1e-12)
    assert values["altitude"][0] == 545.4
    assert values["ellipsoidal_height"][0] == pytest.approx(592.3)
    assert (values["quality"][0], values["satellites"][0], values["hdop"][0]) == (1, 8, 0.9)
    assert math.isnan(values["correction_age"][0])
    assert ns[0] == datetime(1994, 3, 23, 12, 35, 19, tzinfo=UTC).timestamp() * 1e9
    values, _ = rows(stream_of(file, "RMC"))
    assert (values["speed"][0], values["course"][0]) == (22.4, 84.4)
    assert (values["magnetic_variation"][0], values["valid"][0]) == (-3.1, 1)
    values, ns = rows(stream_of(file, "VTG"))
    assert (values["speed"][0], values["speed_kn"][0], values["course"][0]) == (10.2, 5.5, 54.7)
    assert ns[0] == datetime(1994, 3, 23, 12, 35, 19, tzinfo=UTC).timestamp() * 1e9
    values, _ = rows(stream_of(file, "GST"))
    assert (values["latitude_sigma"][0], values["altitude_sigma"][0]) == (0.023, 0.031)
    values, _ = rows(stream_of(file, "PASHR"))
    assert (values["heading"][0], values["roll"][0], values["pitch"][0]) == (0.311, -80.467, -1.395)
    assert math.isnan(values["heave"][0])
    assert (stream_of(file, "VDM").count, stream_of(file, "VDM").columns) == (1, ())


@pytest.mark.parametrize(("modes", "quality"), [("RA", 4), ("AF", 5), ("DN", 2), ("AA", 1)])
def test_the_best_mode_of_gns_is_its_quality(tmp_path: Path, modes: str, quality: int) -> None:
    body = f"GNGNS,014035.00,4332.69262,S,17235.48549,E,{modes},13,0.9,25.63,11.24,1.5,0042"
    values, _ = rows(stream_of(opened(tmp_path, sentence(body)), "GNS"))
    assert values["quality"].tolist() == [quality]
    assert values["ellipsoidal_height"].tolist() == [25.63 + 11.24]
    assert values["correction_age"].tolist() == [1.5]


@pytest.mark.parametrize("side", ["N", "S"])
def test_the_hemisphere_is_the_sign(tmp_path: Path, side: str) -> None:
    text = sentence(f"GNGGA,000000,3351.65,{side},15112.40,W,4,9,1,10.0,M,20.0,M,,")
    values, _ = rows(stream_of(opened(tmp_path, text), "GGA"))
    sign = {"N": 1, "S": -1}[side]
    assert values["latitude"][0] == pytest.approx(sign * (33 + 51.65 / 60))
    assert values["longitude"][0] == pytest.approx(-(151 + 12.4 / 60))


def test_faults_are_told_with_their_counts(tmp_path: Path) -> None:
    back = sentence("GPGGA,123400,4807.038,N,01131.000,E,1,08,0.9,545.4,M,46.9,M,,")
    text = sentence("GPGGA,123520,4807.038,N,01131.000,E,1,08,0.9,high,M,46.9,M,,")
    untimed = sentence("GPGGA,,,,,,0,00,,,M,,M,,")
    log = [VTG, "booting", f"2024-01-01 10:00:00.5 {GGA}", GGA.replace("545.4", "545.5")]
    log += [GGA[:40], back, text, untimed, "$", "\xaaD\x12\x00"]
    file = opened(tmp_path, "\r\n".join(log))
    assert stream_of(file, "GGA").count == 3
    assert set(file.warnings) == {
        "1 sentences with a wrong checksum: dropped",
        "1 sentences without a checksum, which others have: dropped",
        "1 lines or sentences that are cut off or not valid: dropped",
        "2 lines without a sentence",
        "VTG: 1 sentences without a time: dropped",
        "GGA: 1 sentences without a time: dropped",
        "GGA: 2 values that are no number: missing",
        "GGA: time goes back 1 times",
    }
    values, _ = rows(stream_of(file, "GGA"))
    assert np.isnan(values["altitude"]).tolist() == [False, False, True]


def test_a_log_without_any_checksum_is_taken_and_told(tmp_path: Path) -> None:
    bare = GGA.partition("*")[0]
    file = opened(tmp_path, f"{bare}\n{bare.replace('3519', '3520')}\n{bare[:50]}")
    assert stream_of(file, "GGA").count == 2
    assert "2 sentences without a checksum: taken as they are" in file.warnings


@pytest.mark.parametrize("content", [b"", b"\xff\xfe\0\0" * 100, b"$", b"$GPGGA", b"$GPGGA*00\n"])
def test_a_file_without_a_sentence_is_refused_in_one_line(tmp_path: Path, content: bytes) -> None:
    with pytest.raises(InputError, match=r"run\.txt: no NMEA 0183 sentence that is sound"):
        opened(tmp_path, content)


def test_what_cannot_be_read_is_refused(tmp_path: Path) -> None:
    for path in (tmp_path, tmp_path / "none.nmea"):
        assert not Nmea().recognises(path)
        with pytest.raises(InputError):
            Nmea().streams(path, {})


@pytest.mark.parametrize("ending", ENDINGS)
def test_it_is_recognised_by_its_sentences(tmp_path: Path, ending: str) -> None:
    path = tmp_path / "log.dat"
    path.write_text(f"GNSS logger 1.0{ending}{GGA}{ending}", newline="")
    assert Nmea().recognises(path)
    path.write_bytes(f"{GGA}\r\n".encode() + b"\xaaD\x12\x1c" + bytes(40))
    assert not Nmea().recognises(path)


def summed(found: re.Match[bytes]) -> bytes:
    """Return the sentence with the checksum that it should have."""
    return b"$%s*%02X" % (found[1], reduce(xor, found[1], 0))


@pytest.mark.slow
@settings(deadline=None, max_examples=120)
@given(data=st.data())
def test_mutated_logs_are_read_or_refused(
    tmp_path_factory: pytest.TempPathFactory, data: st.DataObject
) -> None:
    zda = sentence("GNZDA,123520.00,23,03,1994,00,00")
    log = bytearray("\r\n".join([GGA, RMC, zda, VTG, GST, PASHR, AIS] * 2).encode())
    junk = st.binary(max_size=8) | st.integers(0, 10**20).map(lambda number: b"%d" % number)
    for _ in range(data.draw(st.integers(1, 6))):
        at = data.draw(st.integers(0, len(log)))
        gone = data.draw(st.integers(0, 40))
        log[at : at + gone] = data.draw(junk)
    if data.draw(st.booleans()):
        log = bytearray(re.sub(rb"\$([^*$\r\n]*)\*..", summed, bytes(log)))
    path = tmp_path_factory.mktemp("mutated") / "run.txt"
    path.write_bytes(log)
    read_or_refused(Nmea(), path, {})
