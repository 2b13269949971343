"""Columns of times of the rows of a table, found by their names and units."""

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction

from floatref import Column, Epoch, InputError, NativeClock

_NAMES = (
    "time t timestamp timestamps zeit zeitstempel uhrzeit temps tiempo tempo tid tijd seconds sec "
    "elapsed elapsedtime timeelapsed datetime datumzeit utc utctime timeutc"
)
NAMES = frozenset(_NAMES.split())
"""What columns of time are called, in small letters, without signs."""
SECONDS: Mapping[str, Fraction] = {
    **dict.fromkeys(("s", "sec", "secs", "second", "seconds", "sek", "sekunden"), Fraction(1)),
    **dict.fromkeys(("ms", "msec", "millisecond", "milliseconds"), Fraction(1, 10**3)),
    **dict.fromkeys(("us", "µs", "μs", "usec", "microsecond", "microseconds"), Fraction(1, 10**6)),
    **dict.fromkeys(("ns", "nsec", "nanosecond", "nanoseconds"), Fraction(1, 10**9)),
    **dict.fromkeys(("min", "minute", "minutes"), Fraction(60)),
    **dict.fromkeys(("h", "hour", "hours"), Fraction(3600)),
    **dict.fromkeys(("d", "day", "days"), Fraction(86_400)),
}
"""Seconds in a unit of time."""
DAY_S = 86_400
NONE = "none"
"""The option `time` of a table in which no column is to be taken for one of time."""
UNKNOWN = "no time column; state rate_hz in the map"


@dataclass(frozen=True)
class TimeColumn:
    """Which column it is, what its unit is in s, and which others could have been meant."""

    index: int
    unit_s: Fraction
    others: tuple[str, ...] = ()

    def list_others(self, columns: Sequence[Column]) -> tuple[str, ...]:
        """Return a line about the columns that were passed over."""
        if not self.others:
            return ()
        name = columns[self.index].name
        return (f"{', '.join(self.others)}: also named like time; {name} is taken for it",)


def time_column(columns: Sequence[Column], option: str | None) -> TimeColumn | None:
    """Return the column of time among ``columns``, or None if it is missing.

    ``option`` is its name; without it the first one that is named like time is taken, with
    "none" no column is. InputError if there is no such column, or its unit is not one of time.
    """
    if option == NONE:
        return None
    if option is not None:
        return _find_named(columns, option)
    found = [(i, unit) for i, c in enumerate(columns) if (unit := find_unit(c)) is not None]
    if not found:
        return None
    others = tuple(columns[i].name for i, _ in found[1:])
    return TimeColumn(*found[0], others)


def _find_named(columns: Sequence[Column], option: str) -> TimeColumn:
    for index, column in enumerate(columns):
        if column.name != option:
            continue
        unit = find_unit(column) or SECONDS.get(column.unit.strip().lower() or "s")
        if unit is None:
            raise InputError(
                f"column {option}: unit {column.unit!r} is not a unit of time; use s or ms"
            )
        return TimeColumn(index, unit)
    here = ", ".join(column.name for column in columns[:20])
    raise InputError(f"time = {option!r}: no such column; there are {here}")


def find_unit(column: Column) -> Fraction | None:
    """Return the unit in s of a column that is named like time, else None."""
    words = [word for word in re.split(r"[^\w%µμ]+|_", column.name.lower()) if word]
    unit = column.unit.strip().lower()
    if len(words) > 1 and words[-1] in SECONDS:
        unit = unit or words[-1]
        words = words[:-1]
    if "".join(words) not in NAMES:
        return None
    # CF: "seconds since 2024-05-01".
    return SECONDS.get(unit.partition(" since ")[0].strip() or "s")


def of_epoch(clock: NativeClock, options: Mapping[str, str]) -> NativeClock:
    """Return ``clock`` with the epoch that the option `epoch` states; InputError if unknown."""
    stated = options.get("epoch")
    if stated is None:
        return clock
    if stated not in {epoch.value for epoch in Epoch}:
        raise InputError(f"epoch = {stated!r}; give {', '.join(epoch.value for epoch in Epoch)}")
    turn_s = Fraction(DAY_S) if stated == Epoch.DAY.value else clock.turn_s
    return replace(clock, epoch=Epoch(stated), turn_s=turn_s)
