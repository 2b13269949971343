"""A drive over an end of the calendar has its instants as driven, in every format that has dates.

Law: the rows that come out lie at the times at which they were taken, to 1 µs, over midnight, new
year, a leap day, the change of the GPS week, the end of its ten bits, and the end of 32-bit
seconds; over a leap second too, where one line tells of it.
"""

from pathlib import Path

import numpy as np
import pytest
from tests.adapters.formats.calendar_drives import (
    ABSOLUTE,
    GPS_EPOCH_S,
    OF_STAMPS,
    RELATIVE,
    STEP_NS,
    Kept,
    Ns,
    S,
    unix_ns,
    write_can,
)

from floatref.engine.recordings.readers import native_of, reader_of
from floatref.mapping.clocks.columns import Wanted, as_they_are, take
from floatref.mapping.spool import Spool
from floatref.values.native import Epoch, Stream
from floatref_adapters.testing.nmea import sentence

MOMENTS = {
    "midnight": unix_ns(2024, 5, 15),
    "new year": unix_ns(2025, 1, 1),
    "leap day begins": unix_ns(2024, 2, 29),
    "leap day ends": unix_ns(2024, 3, 1),
    "GPS week": unix_ns(2024, 5, 11, 23, 59, 42),
    "ten bits of the GPS week": unix_ns(2019, 4, 6, 23, 59, 42),
    "GPS second 1e9 of 32 bits": unix_ns(2011, 9, 14, 1, 46, 25),
    "2038": unix_ns(2038, 1, 19, 3, 14, 8),
}
OF_THEIR_OWN = ("BESTVEL: velocities of up to", "1 events that are no data frames")
"""What is said of these files at any moment: of a latency, and of the first line of ASC."""
LEAP_NS = unix_ns(2017, 1, 1)
ROWS = 200


def leaps_at(moment_ns: int) -> int:
    """Return GPS time less UTC in s, by the bulletins of the IERS."""
    days = [unix_ns(2009, 1, 1), unix_ns(2012, 7, 1), unix_ns(2015, 7, 1), LEAP_NS]
    return 14 + sum(moment_ns >= day for day in days)


def driven(moment_ns: int) -> Ns:
    """Return when rows are taken, every 50 ms and half of them before the moment."""
    return moment_ns + STEP_NS * (np.arange(ROWS) - ROWS // 2)


def read(path: Path, kept: Kept) -> tuple[Stream, np.ndarray, tuple[str, ...]]:
    """Return the stream of a file, ns of its epoch at its rows, and the warnings."""
    with native_of(reader_of(path, None), path, kept.options) as native, Spool() as spool:
        named = {stream.name: stream for stream in native.streams}
        stream = named[kept.stream] if kept.stream else native.streams[0]
        column = [c.name for c in stream.columns if c.numeric][:1]
        taken = take(stream, [Wanted(name, as_they_are) for name in column], spool)
        if taken.rate is not None:
            since = np.array([round(k * S / taken.rate) for k in range(stream.count)])
        else:
            assert taken.times_s is not None
            since = np.rint(taken.times_s * S).astype(np.int64)
        lines = [x for x in native.warnings if not x.startswith(OF_THEIR_OWN)]
        return stream, round(taken.start_s * S) + since, (*lines, *taken.warnings)


def zero_ns(stream: Stream, leaps: int) -> int:
    """Return what a stream counts from, in ns since 1970 UTC."""
    if stream.clock.epoch is Epoch.GPS:
        return (GPS_EPOCH_S - leaps) * S
    assert stream.clock.epoch is Epoch.UTC
    return 0


@pytest.mark.parametrize("moment", MOMENTS)
@pytest.mark.parametrize("form", ABSOLUTE)
def test_the_rows_are_at_the_times_they_were_taken(tmp_path: Path, form: str, moment: str) -> None:
    kept, stamps = ABSOLUTE[form], driven(MOMENTS[moment])
    leaps = leaps_at(MOMENTS[moment])
    kept.write(tmp_path / f"run{kept.suffix}", stamps, leaps)
    stream, found, warnings = read(tmp_path / f"run{kept.suffix}", kept)
    np.testing.assert_allclose(found + zero_ns(stream, leaps) - stamps, 0, atol=1000)
    assert warnings == ()


@pytest.mark.parametrize("moment", [*MOMENTS, "leap second"])
@pytest.mark.parametrize("form", RELATIVE)
def test_a_log_that_counts_from_its_start_goes_on(tmp_path: Path, form: str, moment: str) -> None:
    """Its writer counts the seconds of the clock that it is given."""
    kept, stamps = RELATIVE[form], driven({**MOMENTS, "leap second": LEAP_NS}[moment])
    write_can(tmp_path / f"run{kept.suffix}", stamps, 0)
    stream, found, warnings = read(tmp_path / f"run{kept.suffix}", kept)
    assert stream.clock.epoch is Epoch.LOCAL
    np.testing.assert_allclose(np.diff(found), STEP_NS, atol=2_000_000 if form == "TRC" else 1000)
    assert warnings == ()


def shown(passed: Ns, again: str) -> Ns:
    """Return the UTC stamps of rows over the leap second, of which one second comes again."""
    return passed - S * (passed >= LEAP_NS + S * (again == "60"))


@pytest.mark.parametrize("again", ["60", "59"])
@pytest.mark.parametrize("form", OF_STAMPS)
def test_a_leap_second_that_stamps_show_is_counted(tmp_path: Path, form: str, again: str) -> None:
    kept, passed = ABSOLUTE[form], driven(LEAP_NS)
    kept.write(tmp_path / f"run{kept.suffix}", shown(passed, again), 17)
    _, found, warnings = read(tmp_path / f"run{kept.suffix}", kept)
    np.testing.assert_allclose(found - passed, 0, atol=1000)
    assert "the leap second before 2017-01-01 is counted: time stamps come again there" in warnings


@pytest.mark.parametrize("form", ["MDF4", "TDMS waveform", "NovAtel ASCII", "NovAtel binary"])
def test_a_clock_that_counts_seconds_goes_on_over_a_leap_second(tmp_path: Path, form: str) -> None:
    kept, passed = ABSOLUTE[form], driven(LEAP_NS)
    kept.write(tmp_path / f"run{kept.suffix}", passed, 17)
    stream, found, _ = read(tmp_path / f"run{kept.suffix}", kept)
    np.testing.assert_allclose(found + zero_ns(stream, 17) - passed, 0, atol=1000)


@pytest.mark.parametrize("form", OF_STAMPS)
def test_stamps_that_do_not_show_a_leap_second_are_told(tmp_path: Path, form: str) -> None:
    kept, passed = ABSOLUTE[form], driven(LEAP_NS)
    kept.write(tmp_path / f"run{kept.suffix}", passed, 17)
    warnings = read(tmp_path / f"run{kept.suffix}", kept)[2]
    assert any("later ones may be 1 s off beside GPS time" in line for line in warnings)


def test_23_59_60_is_a_time_in_sentences_and_in_text(tmp_path: Path) -> None:
    """Written as the second that it is, at 10 Hz; nothing is said to go back."""
    tenths = np.arange(-20, 30)
    clocks = [
        ("235958", k + 20) if k < -10 else ("235959", k + 10) if k < 0
        else ("235960", k) if k < 10 else (f"{(k - 10) // 10:06d}", k % 10)
        for k in tenths.tolist()
    ]  # fmt: skip
    days = ["2016-12-31" if k < 10 else "2017-01-01" for k in tenths.tolist()]
    fix, both = "A,4807.038,N,01131.000,E,022.4,084.4", zip(clocks, days, strict=True)
    rmc = [
        sentence(f"GNRMC,{clock}.{part},{fix},{day[8:]}{day[5:7]}{day[2:4]},,,A")
        for (clock, part), day in both
    ]
    rows = [
        f"{day}T{c[:2]}:{c[2:4]}:{c[4:]}.{part}Z,1.5"
        for (c, part), day in zip(clocks, days, strict=True)
    ]
    (tmp_path / "run.nmea").write_text("\n".join([*rmc, ""]), encoding="ascii")
    (tmp_path / "run.csv").write_text("\n".join(["time,x", *rows, ""]), encoding="ascii")
    for name, stream in (("run.nmea", "RMC"), ("run.csv", "")):
        _, found, warnings = read(tmp_path / name, Kept("", write_can, stream))
        np.testing.assert_allclose(found - LEAP_NS - tenths * S // 10, 0, atol=1000)
        assert len(warnings) == 1
        assert "is counted" in warnings[0]


@pytest.mark.parametrize("moment", ["midnight", "ten bits of the GPS week"])
@pytest.mark.parametrize("form", ["NovAtel ASCII", "NovAtel binary"])
def test_a_receiver_of_ten_bits_goes_on_and_is_told(tmp_path: Path, form: str, moment: str) -> None:
    """Its week is 1024 or 2048 too small; where the ten bits end it begins again at 0."""
    kept, zero, turn = ABSOLUTE[form], (GPS_EPOCH_S - 18) * S, 1024 * 604_800 * S
    stamps = driven(MOMENTS[moment])
    kept.write(tmp_path / f"run{kept.suffix}", zero + (stamps - zero) % turn, 18)
    _, found, warnings = read(tmp_path / f"run{kept.suffix}", kept)
    np.testing.assert_array_equal((found + zero - stamps) % turn, 0)
    np.testing.assert_array_equal(np.diff(found), STEP_NS)
    assert any("a receiver that missed a week roll-over is years off" in x for x in warnings)
