"""Readings of GNSS time in a recording: when each was new, with weeks and days unrolled."""

from bisect import bisect_right
from datetime import UTC, datetime
from typing import NamedTuple

import numpy as np

from floatref.errors import InputError
from floatref.values.arrays import FloatArray
from floatref.values.scanning import chunks

DAY_S, WEEK_S = 86400.0, 604800.0
ASTRAY_S = 1.0
"""Distance in s from the majority, beyond drift, from which on a reading is wrong."""
DRIFT = 1e-3


class ReadingEdges(NamedTuple):
    """New readings of GNSS time.

    Args:
        base_s: base time of the first sample of each, shape (n,), in s.
        gnss_s: the readings, shape (n,), in s, continuous over midnight and the end of a week.
        update_s: the usual time between two readings plus that between two samples, in s.
        dropped: number of readings that do not advance as time does.
    """

    base_s: FloatArray
    gnss_s: FloatArray
    update_s: float
    dropped: int


def reading_edges(base_s: FloatArray, gnss_s: FloatArray) -> ReadingEdges:
    """Return when the readings ``gnss_s``, shape (n,), at ``base_s`` were new, a piece at a time.

    Raises InputError for different shapes or fewer than two readings.
    """
    if base_s.shape != gnss_s.shape or base_s.ndim != 1:
        raise InputError(
            f"{gnss_s.size} readings of GNSS time at {base_s.size} times; give one each"
        )
    at, read, sample_s = _changes(base_s, gnss_s)
    if at.size < 2:
        raise InputError(
            f"GNSS time takes {at.size} new value(s) in {base_s.size} samples; two or more are "
            "needed, so check the channel"
        )
    read = _unroll(at, read)
    shift = read - at
    usual = float(np.median(shift))
    sound = np.abs(shift - usual) <= ASTRAY_S + DRIFT * float(np.ptp(at))
    sound[sound] = np.diff(read[sound], prepend=-np.inf) > 0
    update = float(np.median(np.diff(read[sound]))) if sound.sum() > 1 else 0.0
    return ReadingEdges(at[sound], read[sound], update + sample_s, int((~sound).sum()))


def _changes(base_s: FloatArray, gnss_s: FloatArray) -> tuple[FloatArray, FloatArray, float]:
    """Return base time and value of every new reading, and the usual step between samples.

    The first reading is left out: when it was new is not known.
    """
    times, values, steps, last = [], [], [], np.nan
    for first, chunk in chunks(gnss_s):
        at = np.asarray(base_s[first : first + chunk.size])
        known = np.flatnonzero(np.isfinite(chunk) & np.isfinite(at))
        if not known.size:
            continue
        shown = chunk[known]
        new = np.diff(shown, prepend=last) != 0
        times.append(at[known[new]])
        values.append(shown[new].copy())
        last = float(shown[-1])
        steps.append(float(np.median(np.diff(at))) if at.size > 1 else 0.0)
    if not times:
        return np.empty(0), np.empty(0), 0.0
    return np.concatenate(times)[1:], np.concatenate(values)[1:], float(np.median(steps))


def _unroll(at: FloatArray, read: FloatArray) -> FloatArray:
    """Return the readings with a day or a week added wherever they roll over."""
    steps = np.diff(read) - np.diff(at)
    near = ASTRAY_S + DRIFT * np.abs(np.diff(at))
    week, day = np.abs(steps + WEEK_S) <= near, np.abs(steps + DAY_S) <= near
    rolled = np.where(week, WEEK_S, np.where(day, DAY_S, 0.0))
    return np.asarray(read + np.concatenate([[0.0], np.cumsum(rolled)]))


GPS_EPOCH_UNIX_S = 315_964_800
"""1980-01-06 00:00:00 UTC, in s since 1970-01-01 UTC."""
FIRST_DAYS = (
    *("1981-07-01", "1982-07-01", "1983-07-01", "1985-07-01", "1988-01-01", "1990-01-01"),
    *("1991-01-01", "1992-07-01", "1993-07-01", "1994-07-01", "1996-01-01", "1997-07-01"),
    *("1999-01-01", "2006-01-01", "2009-01-01", "2012-07-01", "2015-07-01", "2017-01-01"),
)
"""The first day after each leap second, UTC."""
KNOWN_UNTIL = "2026-06-28"
"""Last day that the list of leap seconds covers."""


def _unix_s(day: str) -> int:
    return int(datetime.fromisoformat(day).replace(tzinfo=UTC).timestamp())


LEAPS_UNIX_S = tuple(_unix_s(day) for day in FIRST_DAYS)
"""Where each leap second ends, in s since 1970-01-01 UTC."""
_GPS_S = tuple(s - GPS_EPOCH_UNIX_S + n for n, s in enumerate(LEAPS_UNIX_S, start=1))


def gps_minus_utc_s(utc_unix_s: float) -> int:
    """Return GPS time less UTC in s at ``utc_unix_s``, in s since 1970-01-01 UTC.

    18 since 2017-01-01. Raises InputError for a time before 1980-01-06, when GPS time began.
    """
    if not utc_unix_s >= GPS_EPOCH_UNIX_S:
        raise InputError(f"{utc_unix_s:.10g} s since 1970 is before GPS time began, 1980-01-06")
    return bisect_right(LEAPS_UNIX_S, utc_unix_s)


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


def warn_of_leap_seconds(utc_unix_s: float) -> str | None:
    """Return a warning if ``utc_unix_s`` is later than the end of the list of leap seconds."""
    if not utc_unix_s > _unix_s(KNOWN_UNTIL):
        return None
    day = f"{np.datetime64(int(utc_unix_s), 's')}"[:10]
    return (
        f"leap seconds are known until {KNOWN_UNTIL}, the recording is of {day}; GPS less UTC was "
        f"taken as {gps_minus_utc_s(utc_unix_s)} s, so check IERS Bulletin C"
    )
