"""GPS time and UTC: published moments, the list of the IERS, and the way back."""

from datetime import UTC, datetime
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref.measures.clocks import gnss_time
from floatref.measures.clocks.gnss_time import (
    gps_from_utc_s,
    gps_minus_utc_at_gps_s,
    gps_minus_utc_s,
    utc_from_gps_s,
    warn_of_leap_seconds,
)

LIST = Path("/usr/share/zoneinfo/leap-seconds.list")


def unix_s(*when: int) -> float:
    return datetime(*when, tzinfo=UTC).timestamp()


@pytest.mark.parametrize(
    ("when", "seconds"),
    [
        ((1980, 1, 6), 0),
        ((1981, 6, 30, 23, 59, 59), 0),
        ((1981, 7, 1), 1),
        ((1999, 8, 22), 13),
        ((2005, 12, 31, 23, 59, 59), 13),
        ((2006, 1, 1), 14),
        ((2016, 12, 31, 23, 59, 59), 17),
        ((2017, 1, 1), 18),
        ((2026, 1, 1), 18),
    ],
)
def test_published_differences(when: tuple[int, ...], seconds: int) -> None:
    assert gps_minus_utc_s(unix_s(*when)) == seconds


def test_published_moments_of_gps_time() -> None:
    """GPS second 10⁹, and the second end of the weeks' 10 bits, at 23:59:42 UTC."""
    assert utc_from_gps_s(1e9) == unix_s(2011, 9, 14, 1, 46, 25)
    assert utc_from_gps_s(2048 * 604800) == unix_s(2019, 4, 6, 23, 59, 42)


@pytest.mark.skipif(not LIST.exists(), reason="the system has no list of leap seconds")
@given(st.integers(315_964_800, 1_782_000_000))
def test_the_list_of_the_iers_says_the_same(utc: int) -> None:
    """It has TAI less UTC since a second of NTP time, 1900; GPS time is 19 s behind TAI."""
    rows = [line.split()[:2] for line in LIST.read_text().splitlines() if line[:1] not in "#"]
    atomic = [int(tai) for ntp, tai in rows if int(ntp) - 2_208_988_800 <= utc]
    assert gps_minus_utc_s(utc) == atomic[-1] - 19


@given(st.floats(315_964_800, 4e9))
def test_there_and_back(utc: float) -> None:
    assert utc_from_gps_s(gps_from_utc_s(utc)) == pytest.approx(utc, abs=1e-6)


@given(st.floats(0, 3e9), st.floats(0, 1e8))
def test_utc_goes_on_but_for_the_leap_second_itself(gps: float, later: float) -> None:
    assert utc_from_gps_s(gps + later) >= utc_from_gps_s(gps) - 1.0
    assert gps_minus_utc_at_gps_s(gps + later) >= gps_minus_utc_at_gps_s(gps)


def test_days_go_up_and_the_list_is_told_when_it_is_old() -> None:
    assert list(gnss_time.FIRST_DAYS) == sorted(gnss_time.FIRST_DAYS)
    assert all(day.endswith(("-01-01", "-07-01")) for day in gnss_time.FIRST_DAYS)
    assert warn_of_leap_seconds(unix_s(2026, 6, 27)) is None
    line = warn_of_leap_seconds(unix_s(2031, 3, 4))
    assert line is not None
    assert "until 2026-06-28" in line
    assert "2031-03-04" in line
    assert "18 s" in line


@pytest.mark.parametrize("convert", [gps_minus_utc_s, gps_minus_utc_at_gps_s])
@pytest.mark.parametrize("time", [-1.0, float("nan")])
def test_before_gps_time_is_refused(convert, time: float) -> None:
    with pytest.raises(InputError, match="1980-01-06"):
        convert(time)


@pytest.mark.parametrize("day", gnss_time.FIRST_DAYS)
def test_around_every_leap_second_the_way_back_is_the_way_there(day: str) -> None:
    midnight = datetime.fromisoformat(day).replace(tzinfo=UTC).timestamp()
    for utc in [midnight + s for s in (-30, -1, -0.5, 0, 0.5, 1, 30)]:
        assert utc_from_gps_s(gps_from_utc_s(utc)) == utc
    last = gps_from_utc_s(midnight - 1)
    assert gps_from_utc_s(midnight) == last + 2
    # The leap second itself is told as the first one of the day.
    assert utc_from_gps_s(last + 1) == midnight
