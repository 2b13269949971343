"""The clock of NMEA 0183: midnights, dates that come late or cannot be, decimals."""

from datetime import UTC, datetime
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from floatref import Epoch, Stream
from floatref_adapters.formats.nmea.adapter import Nmea
from floatref_adapters.testing.nmea import sentence
from floatref_adapters.testing.whole_reading import stream_of, table_of


def stream(folder: Path, kind: str, bodies: list[str]) -> Stream:
    """Return the stream of the sentences of one kind of a log that holds ``bodies``."""
    path = folder / "run.txt"
    path.write_text("\n".join(map(sentence, bodies)))
    return stream_of(Nmea().streams(path, {}), kind)


def ns(of: Stream) -> NDArray[np.int64]:
    """Return the ns since the epoch of every row."""
    unit = of.clock.tick_s * 10**9
    assert unit.denominator == 1
    return of.clock.origin_ns + table_of(of)[1] * unit.numerator


def gga(time: str) -> str:
    return f"GNGGA,{time},,,,,0,,,,M,,M,,"


def test_without_a_date_the_day_is_unknown_and_midnight_goes_on(tmp_path: Path) -> None:
    times = ("235959.80", "235959.90", "000000.00", "000000.10")
    of = stream(tmp_path, "GGA", [gga(time) for time in times])
    assert of.clock.epoch is Epoch.DAY
    assert np.diff(ns(of)).tolist() == [10**8] * 3
    assert ns(of)[0] == 86_399_800 * 10**6


def test_a_late_sentence_of_before_midnight_keeps_its_day(tmp_path: Path) -> None:
    late = "GNGST,235959.9,1,1,1,0,1,1,1"
    bodies = [gga("235959.9"), gga("000000.0"), late]
    gst, fixes = (stream(tmp_path, kind, bodies) for kind in ("GST", "GGA"))
    assert ns(gst)[0] == ns(fixes)[0]
    assert Nmea().streams(tmp_path / "run.txt", {}).warnings == ()


def test_a_date_that_comes_late_dates_what_was_before_it(tmp_path: Path) -> None:
    bodies = [gga("235959"), gga("000001"), "GNZDA,000001,01,03,2024,00,00"]
    first = datetime(2024, 2, 29, 23, 59, 59, tzinfo=UTC).timestamp()
    assert ns(stream(tmp_path, "GGA", bodies)).tolist() == [first * 1e9, (first + 2) * 1e9]


@pytest.mark.parametrize(
    "date", ["01,01,9999", "01,01,4294967296", f"{10**20},01,24", "31,02,2024", "-1,1,24"]
)
def test_a_date_that_cannot_be_is_none(tmp_path: Path, date: str) -> None:
    bodies = [f"GNZDA,120000,{date},00,00", "GNZDA,120001,01,03,2024,00,00"]
    noon = datetime(2024, 3, 1, 12, tzinfo=UTC).timestamp()
    assert ns(stream(tmp_path, "ZDA", bodies)).tolist() == [noon * 1e9, (noon + 1) * 1e9]


def test_decimals_beyond_ms_are_kept_whole(tmp_path: Path) -> None:
    of = stream(tmp_path, "GGA", [gga("120000.1234"), gga("120000.123456")])
    assert of.clock.tick_s.denominator == 10**6
    assert np.diff(ns(of)).tolist() == [56_000]
