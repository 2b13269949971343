"""From one epoch to another: UTC, GPS time, and the time of an unknown day."""

from bisect import bisect_right
from fractions import Fraction

from floatref.measures.clocks.gnss_time import (
    GPS_EPOCH_UNIX_S,
    LEAPS_UNIX_S,
    gps_minus_utc_at_gps_s,
    gps_minus_utc_s,
    warn_of_leap_seconds,
)
from floatref.values.arrays import FloatArray
from floatref.values.native import Epoch

DAY_S = 86_400

Moment = tuple[Fraction, Epoch]
"""A time in s after the zero of an epoch, which is not `LOCAL`."""


def between_epochs(own: Moment, base: Moment) -> tuple[Fraction, tuple[str, ...]]:
    """Return by how many s ``own`` is after ``base``, and warnings.

    A time of an unknown day is put on the day nearest to the other. Raises InputError for UTC
    before GPS time began, where both are needed.
    """
    if own[1] is base[1]:
        return passed(base[0], own[0], own[1]), (
            "aligned by the absolute times of both clocks, as exactly as both were set",
        )
    if Epoch.DAY in (own[1], base[1]):
        apart = _unix(own) % DAY_S - _unix(base) % DAY_S
        apart -= DAY_S * round(apart / DAY_S)
        return apart, ("aligned by the time of day, taken to be of the same day",)
    utc = float(own[0] if own[1] is Epoch.UTC else base[0])
    line = f"aligned by UTC and GPS time, {gps_minus_utc_s(utc)} leap seconds apart"
    doubt = warn_of_leap_seconds(utc)
    return _gps(own) - _gps(base), (line,) if doubt is None else (line, doubt)


def passed(since: Fraction, until: Fraction, epoch: Epoch) -> Fraction:
    """Return how many s pass from ``since`` to ``until``, both in s after the zero of ``epoch``.

    A day of UTC with a leap second is one second longer.
    """
    leaps = 0
    if epoch is Epoch.UTC:
        begin, end = (bisect_right(LEAPS_UNIX_S, float(at)) for at in (since, until))
        leaps = end - begin
    return until - since + leaps


def _unix(moment: Moment) -> Fraction:
    """Return ``moment`` in s since 1970-01-01 UTC, leap seconds not counted."""
    seconds, epoch = moment
    if epoch is not Epoch.GPS:
        return seconds
    return seconds + GPS_EPOCH_UNIX_S - gps_minus_utc_at_gps_s(float(seconds))


def _gps(moment: Moment) -> Fraction:
    """Return ``moment`` in s of GPS time, whose seconds are all of one length."""
    seconds, epoch = moment
    if epoch is Epoch.GPS:
        return seconds
    return seconds - GPS_EPOCH_UNIX_S + gps_minus_utc_s(float(seconds))


WEEK_S = 604_800
RECENT_UNIX_S = 1.7e9
"""Of an unknown day the leap seconds are those since 2017."""


def since_zero(
    readings: FloatArray, zero_s: float, epoch: Epoch
) -> tuple[FloatArray, tuple[str, ...]]:
    """Return ``readings`` in s after ``zero_s`` of ``epoch``, and how they are interpreted.

    They may count from the epoch, the week or the day. Where the receiver's own time is UTC,
    readings beyond a day can only be GPS time, which is leap seconds ahead of it.
    """
    if epoch is Epoch.LOCAL or not readings.size:
        return readings, ()
    first = float(readings[0])
    if abs(first - zero_s) <= DAY_S / 2:
        return readings - zero_s, ()
    if epoch is Epoch.GPS:
        return readings + _turns(zero_s - first, WEEK_S) - zero_s, ()
    if first <= DAY_S:
        line = "base_time is read as s of the day in UTC, like the receiver's own time"
        return readings + _turns(zero_s - first, DAY_S) - zero_s, (line,)
    leaps = gps_minus_utc_s(zero_s if epoch is Epoch.UTC else RECENT_UNIX_S)
    in_utc = readings + GPS_EPOCH_UNIX_S - leaps
    line = f"base_time is read as GPS time, {leaps} s ahead of the receiver's own, which is UTC"
    period = DAY_S if epoch is Epoch.DAY else WEEK_S
    return in_utc + _turns(zero_s - float(in_utc[0]), period) - zero_s, (line,)


def _turns(apart_s: float, period_s: int) -> float:
    return round(apart_s / period_s) * float(period_s)
