"""Dates and times of the day as text: ISO 8601, 22.11.2026 10:00:00, 10:00:00."""

import re

import numpy as np

ISO = re.compile(
    r"(?:(?P<date>(?:19|2[01])\d\d-\d\d-\d\d)|(?P<day>\d\d?)\.(?P<month>\d\d?)\.(?P<year>\d{4}))"
    r"[T ](?P<clock>\d\d:\d\d(?::\d\d)?)"
    r"(?:[.,](?P<part>\d{1,9})\d*)?(?P<zone> ?Z|[+-]\d\d:?\d\d)?"
)
CLOCK = re.compile(r"(?P<clock>\d?\d:\d\d:\d\d)(?:[.,](?P<part>\d{1,9})\d*)?")


def read_iso_ns(text: str) -> int | None:
    """Return the ns since 1970 UTC of an ISO 8601 time, or None; without a zone it is UTC.

    A date may be written as 22.11.2026 too, which has a single meaning. A leap second, 23:59:60,
    has the number of the second behind it.
    """
    match = ISO.fullmatch(text)
    if not match:
        return None
    date = match["date"] or f"{match['year']}-{match['month']:0>2}-{match['day']:0>2}"
    clock, leap = match["clock"], match["clock"].endswith(":59:60")
    try:
        seconds = int(np.datetime64(f"{date}T{clock[:5] if leap else clock}", "s").astype(np.int64))
    except ValueError:
        return None
    zone = (match["zone"] or "Z").strip().replace(":", "")
    if zone != "Z":
        sign = -1 if zone[0] == "-" else 1
        seconds -= sign * (int(zone[1:3]) * 3600 + int(zone[3:]) * 60)
    seconds += 60 * leap
    return seconds * 10**9 + int((match["part"] or "0").ljust(9, "0"))


def read_day_ns(text: str) -> int | None:
    """Return the ns since midnight of a time such as 12:30:00.25, or None."""
    match = CLOCK.fullmatch(text)
    if not match:
        return None
    hours, minutes, seconds = (int(part) for part in match["clock"].split(":"))
    if minutes > 59 or seconds > 60:
        return None
    part = int((match["part"] or "0").ljust(9, "0"))
    return (hours * 3600 + minutes * 60 + seconds) * 10**9 + part


def has_zone(text: str) -> bool:
    """Tell whether the ISO 8601 time ``text`` states its zone."""
    match = ISO.fullmatch(text)
    return bool(match and match["zone"])
