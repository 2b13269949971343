"""Readings of GNSS time on another clock, as s after the zero of the receiver's own."""

from floatref.measures.leap_seconds import GPS_EPOCH_UNIX_S, gps_minus_utc_s
from floatref.values.arrays import FloatArray
from floatref.values.native import Epoch

DAY_S, WEEK_S = 86_400, 604_800
RECENT_UNIX_S = 1.7e9
"""Of an unknown day the leap seconds are those since 2017."""


def since_zero(
    readings: FloatArray, zero_s: float, epoch: Epoch
) -> tuple[FloatArray, tuple[str, ...]]:
    """Return ``readings`` in s after ``zero_s`` of ``epoch``, and what they are taken for.

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
        said = "base_time is taken for s of the day in UTC, as the receiver's own time is"
        return readings + _turns(zero_s - first, DAY_S) - zero_s, (said,)
    leaps = gps_minus_utc_s(zero_s if epoch is Epoch.UTC else RECENT_UNIX_S)
    in_utc = readings + GPS_EPOCH_UNIX_S - leaps
    said = f"base_time is taken for GPS time, {leaps} s ahead of the receiver's own, which is UTC"
    period = DAY_S if epoch is Epoch.DAY else WEEK_S
    return in_utc + _turns(zero_s - float(in_utc[0]), period) - zero_s, (said,)


def _turns(apart_s: float, period_s: int) -> float:
    return round(apart_s / period_s) * float(period_s)
