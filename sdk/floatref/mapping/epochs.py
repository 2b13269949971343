"""From one epoch to another: UTC, GPS time, and the time of an unknown day."""

from fractions import Fraction

from floatref.measures.leap_seconds import (
    GPS_EPOCH_UNIX_S,
    gps_minus_utc_at_gps_s,
    gps_minus_utc_s,
    leap_seconds_told,
)
from floatref.values.native import Epoch

DAY_S = 86_400

Moment = tuple[Fraction, Epoch]
"""A time in s after the zero of an epoch, which is not `LOCAL`."""


def between_epochs(own: Moment, base: Moment) -> tuple[Fraction, tuple[str, ...]]:
    """Return how many s ``own`` is after ``base``, and what there is to say about it.

    A time of an unknown day is of the day that brings both nearest. Raises InputError for UTC
    before GPS time began, where both are needed.
    """
    if own[1] is base[1]:
        return own[0] - base[0], (
            "aligned by the absolute times of both clocks, as right as both were set",
        )
    if Epoch.DAY in (own[1], base[1]):
        apart = _unix(own) % DAY_S - _unix(base) % DAY_S
        apart -= DAY_S * round(apart / DAY_S)
        return apart, ("aligned by the time of day, taken to be of the same day",)
    utc = float(own[0] if own[1] is Epoch.UTC else base[0])
    line = f"aligned by UTC and GPS time, {gps_minus_utc_s(utc)} leap seconds apart"
    doubt = leap_seconds_told(utc)
    return _unix(own) - _unix(base), (line,) if doubt is None else (line, doubt)


def _unix(moment: Moment) -> Fraction:
    """Return ``moment`` in s since 1970-01-01 UTC, leap seconds not counted."""
    seconds, epoch = moment
    if epoch is not Epoch.GPS:
        return seconds
    return seconds + GPS_EPOCH_UNIX_S - gps_minus_utc_at_gps_s(float(seconds))
