"""The clock of an NMEA log: a time of the day in most sentences, a date in few."""

import re
from collections import Counter
from datetime import date

DAY_NS = 86_400 * 10**9
HALF_DAY_NS = DAY_NS // 2
HOUR_NS = 3600 * 10**9
SECOND_NS = 10**9
UNIX_DAY = date(1970, 1, 1).toordinal()
TIME = re.compile(r"([01]\d|2[0-3])([0-5]\d)([0-5]\d|60)(?:\.(\d{0,9}))?$", re.ASCII)
YEARS = range(1980, 2200)
"""Of GNSS; ns since 1970 fit in 64 bits for longer."""


def read_time_of_day_ns(text: str) -> int | None:
    """Return the ns since midnight of a time `hhmmss.ss`; None if ``text`` is not one."""
    found = TIME.match(text)
    if found is None:
        return None
    hours, minutes, seconds, decimals = found.groups(default="")
    whole = int(hours) * 3600 + int(minutes) * 60 + int(seconds)
    return whole * 10**9 + int(decimals.ljust(9, "0"))


def read_day(day: str, month: str, year: str) -> int | None:
    """Return the days since 1970-01-01; None if the three are no date. 80 is 1980, 79 is 2079."""
    if not all(text.isascii() and text.isdigit() for text in (day, month, year)):
        return None
    number = int(year[:9])
    if len(year) <= 2:
        number += 1900 if number >= 80 else 2000
    if number not in YEARS:
        return None
    try:
        return date(number, int(month[:9]), int(day[:9])).toordinal() - UNIX_DAY
    except ValueError:
        return None


class DayCount:
    """Times of the day made into ns since midnight of the log's first day.

    A time that drops by half a day or more is past midnight; one that leaps by nearly a day is a
    sentence of before midnight that comes late; any other drop is time going back, and stays. A
    date corrects the day from its own sentence on. ``first_day``, in days since 1970, is known
    once a date was seen. ``faults`` counts drops by kind of sentence, and dates that leap.
    """

    def __init__(self, faults: Counter[str], first_day: int | None = None) -> None:
        self.first_day = first_day
        self.now_ns: int | None = None
        self._faults = faults
        self._day = 0
        self._last_of: dict[str, int] = {}
        self._after_leap: int | None = None

    def moment(self, kind: str, time_ns: int, day: int | None) -> int:
        """Return when a sentence of ``kind`` with its time of day, and maybe date, was taken."""
        if self.now_ns is not None:
            before = self.now_ns - self._day * DAY_NS
            if before - time_ns >= HALF_DAY_NS:
                self._day += 1
            elif time_ns - before >= DAY_NS - HOUR_NS:
                self._day -= 1
        if day is not None:
            self._take(day)
        self.now_ns = self._day * DAY_NS + time_ns
        if time_ns >= DAY_NS:
            self._after_leap = self._day + 1
        # 23:59:60 has the number of the second behind it.
        again_ns = SECOND_NS if self._day == self._after_leap else 0
        if self.now_ns < self._last_of.get(kind, self.now_ns) - again_ns:
            self._faults[f"back {kind}"] += 1
        self._last_of[kind] = self.now_ns
        return self.now_ns

    def _take(self, day: int) -> None:
        if self.first_day is None:
            self.first_day = day - self._day
        if day != self.first_day + self._day:
            self._faults["leap"] += 1
            self._day = day - self.first_day
