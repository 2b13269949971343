"""A logger in UTC and a receiver in its own time are aligned at any moment as at every other.

Law: the recording of two files of one drive over an end of the calendar is that of the same drive
on an ordinary morning, in its distance, its heights and where the fixes lie, to 2 µs.
"""

from pathlib import Path

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pytest
from tests.adapters.formats.calendar_drives import (
    GPS_EPOCH_S,
    Ns,
    S,
    fixes,
    unix_ns,
)

from floatref import InputError, Recording
from floatref.mapping import Reading, read_native
from floatref_adapters.testing.nmea import nmea_log
from floatref_adapters.testing.novatel import binary_log

ORDINARY_NS = unix_ns(2024, 5, 15, 9, 30)
MOMENTS = {
    "midnight": unix_ns(2024, 5, 15),
    "new year": unix_ns(2025, 1, 1),
    "leap day ends": unix_ns(2024, 3, 1),
    "GPS week": unix_ns(2024, 5, 11, 23, 59, 42),
    "ten bits of the GPS week": unix_ns(2019, 4, 6, 23, 59, 42),
    "2038": unix_ns(2038, 1, 19, 3, 14, 8),
}
LEAP_NS = unix_ns(2017, 1, 1)
SECONDS, RATE, FIX_RATE = 60, 500, 10
MAP = """format = "floatref-map/1"
[[files]]
name = "gps"
path = "run.{suffix}"
[[channels]]
native = "force"
channel = "vertical_specific_force"
unit = "m/s^2"
[[channels]]
native = "way"
channel = "distance"
unit = "m"
[[channels]]
native = "range"
channel = "height"
unit = "m"
[[channels]]
file = "gps"
native = "{height}"
channel = "gnss_height"
unit = "m"
"""
HEIGHTS = {"nmea": "GGA/ellipsoidal_height", "gps": "BESTPOS/height"}


def shown(passed: Ns) -> Ns:
    """Return what a clock in UTC shows; over the leap second one second comes again."""
    leaps = passed[0] < LEAP_NS <= passed[-1]
    return passed - S * leaps * (passed >= LEAP_NS + S)


def write_logger(path: Path, begin_ns: int) -> None:
    """Write a minute of a logger, in UTC by the clock of its computer."""
    t = np.arange(SECONDS * RATE) / RATE
    stamps = shown(begin_ns + np.arange(t.size) * (S // RATE))
    columns = {
        "time": pa.array(stamps, pa.timestamp("ns", tz="UTC")),
        "force": 9.8 + 0.1 * np.sin(t),
        "way": 20.0 * t,
        "range": 0.3 + 0.01 * np.sin(3 * t),
    }
    pq.write_table(pa.table(columns), path)


def write_receiver(path: Path, begin_ns: int, leaps: int, weeks: int = 0) -> None:
    """Write its fixes; ``leaps`` is GPS time less UTC when they begin, ``weeks`` are missed."""
    passed = begin_ns + S // 4 + np.arange((SECONDS - 1) * FIX_RATE) * (S // FIX_RATE)
    passed = passed - weeks * 604_800 * S
    if path.suffix == ".nmea":
        path.write_bytes(nmea_log(fixes(shown(passed))))
    else:
        path.write_bytes(binary_log(fixes(passed - GPS_EPOCH_S * S, leaps)))


def drive(folder: Path, suffix: str, moment_ns: int, leaps: int = 18, weeks: int = 0) -> Reading:
    """Return the drive whose middle is the moment."""
    begin_ns = moment_ns - SECONDS // 2 * S
    folder.mkdir()
    write_logger(folder / "run.parquet", begin_ns)
    write_receiver(folder / f"run.{suffix}", begin_ns, leaps, weeks)
    chart = MAP.format(suffix=suffix, height=HEIGHTS[suffix])
    (folder / "map.toml").write_text(chart, encoding="utf-8")
    return read_native(folder / "run.parquet", folder / "map.toml")


def assert_same(one: Recording, other: Recording) -> None:
    assert [c.id for c in one.channels] == [c.id for c in other.channels]
    for mine, yours in zip(one.channels, other.channels, strict=True):
        np.testing.assert_allclose(mine.times_s, yours.times_s, rtol=0, atol=2e-6)
        np.testing.assert_array_equal(mine.values, yours.values)


@pytest.mark.parametrize("moment", MOMENTS)
@pytest.mark.parametrize("suffix", HEIGHTS)
def test_the_recording_is_that_of_an_ordinary_morning(
    tmp_path: Path, suffix: str, moment: str
) -> None:
    ordinary = drive(tmp_path / "ordinary", suffix, ORDINARY_NS)
    found = drive(tmp_path / "found", suffix, MOMENTS[moment])
    assert_same(found.recording, ordinary.recording)
    times = found.recording.channel("gnss_height").times_s
    np.testing.assert_allclose(times[:3], [0.25, 0.35, 0.45], atol=2e-6)


@pytest.mark.parametrize("before_s", [30, 45, 75, -1])
@pytest.mark.parametrize("suffix", HEIGHTS)
def test_over_a_leap_second_they_stay_aligned(tmp_path: Path, suffix: str, before_s: int) -> None:
    """The drive begins so long before the leap second, is over before it, or begins behind it."""
    ordinary = drive(tmp_path / "ordinary", suffix, ORDINARY_NS)
    moment = LEAP_NS + (SECONDS // 2 - before_s) * S
    found = drive(tmp_path / "found", suffix, moment, 17 if before_s > 0 else 18)
    assert_same(found.recording, ordinary.recording)


def test_a_receiver_that_began_behind_the_leap_second_is_not_a_second_off(tmp_path: Path) -> None:
    """The logger began 30 s before it, the receiver 10 s behind it: 41 s later."""
    write_logger(tmp_path / "run.parquet", LEAP_NS - 30 * S)
    for suffix, gap in (("nmea", 0), ("gps", 0)):
        write_receiver(tmp_path / f"run.{suffix}", LEAP_NS + 10 * S - S // 4 + gap, 18)
        chart = MAP.format(suffix=suffix, height=HEIGHTS[suffix])
        (tmp_path / "map.toml").write_text(chart, encoding="utf-8")
        found = read_native(tmp_path / "run.parquet", tmp_path / "map.toml").recording
        assert found.channel("gnss_height").times_s[0] == pytest.approx(41.0, abs=2e-6)


@pytest.mark.parametrize("suffix", HEIGHTS)
def test_a_receiver_that_missed_a_roll_over_is_refused_with_the_reason(
    tmp_path: Path, suffix: str
) -> None:
    with pytest.raises(InputError, match="they are 1024 weeks apart, by which a receiver is off"):
        drive(tmp_path / "found", suffix, ORDINARY_NS, weeks=1024)
