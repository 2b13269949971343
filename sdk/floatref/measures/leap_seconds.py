"""GPS time less UTC: whole seconds, from the announcements of leap seconds.

Source: IERS Bulletin C and the list that goes with it, https://hpiers.obspm.fr/iers/bul/bulc/.
GPS time began with UTC on 1980-01-06; a leap second is inserted before midnight UTC.
"""

from bisect import bisect_right
from datetime import UTC, datetime

import numpy as np

from floatref.errors import InputError

GPS_EPOCH_UNIX_S = 315_964_800
"""1980-01-06 00:00:00 UTC, in s since 1970-01-01 UTC."""
FIRST_DAYS = (
    *("1981-07-01", "1982-07-01", "1983-07-01", "1985-07-01", "1988-01-01", "1990-01-01"),
    *("1991-01-01", "1992-07-01", "1993-07-01", "1994-07-01", "1996-01-01", "1997-07-01"),
    *("1999-01-01", "2006-01-01", "2009-01-01", "2012-07-01", "2015-07-01", "2017-01-01"),
)
"""The first day after each leap second, UTC."""
KNOWN_UNTIL = "2026-06-28"
"""The list says so far that there are no others."""


def _unix_s(day: str) -> int:
    return int(datetime.fromisoformat(day).replace(tzinfo=UTC).timestamp())


_UNIX_S = tuple(_unix_s(day) for day in FIRST_DAYS)
_GPS_S = tuple(s - GPS_EPOCH_UNIX_S + n for n, s in enumerate(_UNIX_S, start=1))


def gps_minus_utc_s(utc_unix_s: float) -> int:
    """Return GPS time less UTC in s at ``utc_unix_s``, in s since 1970-01-01 UTC.

    18 since 2017-01-01. Raises InputError for a time before 1980-01-06, when GPS time began.
    """
    if not utc_unix_s >= GPS_EPOCH_UNIX_S:
        raise InputError(f"{utc_unix_s:.10g} s since 1970 is before GPS time began, 1980-01-06")
    return bisect_right(_UNIX_S, utc_unix_s)


def gps_minus_utc_at_gps_s(gps_s: float) -> int:
    """Return GPS time less UTC in s at ``gps_s``, in s of GPS time since 1980-01-06.

    A leap second itself counts as the first second of the next day. Raises InputError for a time
    below 0.
    """
    if not gps_s >= 0:
        raise InputError(f"GPS time {gps_s:.10g} s is before 1980-01-06; it counts from there")
    return bisect_right(_GPS_S, gps_s)


def gps_from_utc_s(utc_unix_s: float) -> float:
    """Return GPS time in s since 1980-01-06 at ``utc_unix_s``, in s since 1970-01-01 UTC."""
    return utc_unix_s - GPS_EPOCH_UNIX_S + gps_minus_utc_s(utc_unix_s)


def utc_from_gps_s(gps_s: float) -> float:
    """Return UTC in s since 1970-01-01 at ``gps_s``, in s since 1980-01-06."""
    return gps_s - gps_minus_utc_at_gps_s(gps_s) + GPS_EPOCH_UNIX_S


def leap_seconds_told(utc_unix_s: float) -> str | None:
    """Return a line if ``utc_unix_s`` is later than the list of leap seconds reaches."""
    if not utc_unix_s > _unix_s(KNOWN_UNTIL):
        return None
    day = f"{np.datetime64(int(utc_unix_s), 's')}"[:10]
    return (
        f"leap seconds are known until {KNOWN_UNTIL}, the recording is of {day}; GPS less UTC was "
        f"taken as {gps_minus_utc_s(utc_unix_s)} s, so check IERS Bulletin C"
    )
