"""From one epoch to another: UTC, GPS time, and the time of an unknown day."""

from fractions import Fraction

from floatref.values.native import Epoch

GPS_ZERO_S = 315_964_800
"""1980-01-06 in s since 1970-01-01, the zero of GPS time."""
DAY_S = 86_400

Moment = tuple[Fraction, Epoch]
"""A time in s after the zero of an epoch, which is not `LOCAL`."""


def between_epochs(own: Moment, base: Moment) -> tuple[Fraction, tuple[str, ...]]:
    """Return how many s ``own`` is after ``base``, and what there is to say about it.

    A time of an unknown day is of the day that brings both nearest.
    """
    if own[1] is base[1]:
        return own[0] - base[0], ("aligned by the absolute times of both clocks",)
    if Epoch.DAY in (own[1], base[1]):
        apart = _of_day(own) - _of_day(base)
        apart -= DAY_S * round(apart / DAY_S)
        return apart, ("aligned by the time of day, taken to be of the same day",)
    leaps = _leap_seconds(own if own[1] is Epoch.UTC else base)
    told = f"aligned by UTC and GPS time, {leaps} leap seconds apart"
    return _unix(own) - _unix(base), (told,)


def _unix(moment: Moment) -> Fraction:
    """Return ``moment`` in s since 1970-01-01 UTC, leap seconds not counted."""
    seconds, epoch = moment
    if epoch is not Epoch.GPS:
        return seconds
    from floatref.measures.leap_seconds import utc_minus_gps_s

    return seconds + GPS_ZERO_S + utc_minus_gps_s(float(seconds))


def _of_day(moment: Moment) -> Fraction:
    return _unix(moment) % DAY_S


def _leap_seconds(moment: Moment) -> int:
    from floatref.measures.leap_seconds import gps_minus_utc_s

    return gps_minus_utc_s(float(moment[0]))
