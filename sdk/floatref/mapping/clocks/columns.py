"""Reading the columns of one stream once, each through its conversion, onto the disk."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction

import numpy as np

from floatref.errors import InputError
from floatref.mapping.channel_map.entries import ClockEntry
from floatref.mapping.clocks.row_times import Timing
from floatref.mapping.clocks.stamps import uniform_clock, warn_of_leap
from floatref.mapping.spool import Spool
from floatref.values.arrays import BoolArray, FloatArray
from floatref.values.native import Rows, Stream
from floatref.values.scanning import chunks

UNKNOWN = "unknown"
"""Name of the clock of a stream whose file gives no time."""
TOO_COARSE = 0.5
"""Largest share of rows that repeat the time of the row before."""

Convert = Callable[[FloatArray, FloatArray], FloatArray]
"""From native samples and their times in s to samples in SI units."""
Progress = Callable[[int], None]


class Shown:
    """Progress over all streams together."""

    def __init__(self, progress: Callable[[float], None] | None, total: int) -> None:
        """Call ``progress`` with the part of ``total`` rows that was read."""
        self._progress, self._total, self._before = progress, max(total, 1), 0

    def of(self, count: int) -> Progress | None:
        """Return the callback for the next stream, of ``count`` rows."""
        before, self._before = self._before, self._before + count
        progress = self._progress
        if progress is None:
            return None
        return lambda rows: progress(min((before + rows) / self._total, 1.0))


@dataclass(frozen=True, eq=False)
class Wanted:
    """A column to take: its name in the stream and its conversion."""

    column: str
    convert: Convert


@dataclass(frozen=True, eq=False)
class Taken:
    """Columns of a stream, in the order they were wanted, and when their rows were taken.

    Row k was taken ``start_s`` plus ``times_s[k]``, or plus ``k / rate``, seconds after the zero
    of the stream's epoch.
    """

    stream: Stream
    columns: tuple[FloatArray, ...]
    start_s: Fraction
    rate: Fraction | None
    times_s: FloatArray | None
    warnings: tuple[str, ...]


def take(
    stream: Stream,
    wanted: Sequence[Wanted],
    spool: Spool,
    stated: ClockEntry | None = None,
    progress: Progress | None = None,
) -> Taken:
    """Return the ``wanted`` columns of ``stream``, stored in ``spool``.

    The rate of ``stated``, if it has one, replaces the stream's own clock from its first row on.
    Raises InputError for a stream without a clock or rows, one whose time goes back or does not
    advance, and if the disk has no room; ValueError for rows that do not fit together.
    """
    own = stated is None or stated.rate is None
    if own and stream.clock.name == UNKNOWN:
        raise InputError(
            f"stream {stream.name!r} has no time; state rate_hz for it under [[clocks]] in the map"
        )
    rate = stream.clock.rate if stated is None or own else stated.rate
    spool.check_room(stream.count * (len(wanted) + (rate is None)))
    start_s = None if stated is None else stated.start_s
    return _Taking(stream, wanted, spool, Timing(stream, rate, start_s)).all(progress)


class _Taking:
    """One pass over a stream."""

    def __init__(
        self, stream: Stream, wanted: Sequence[Wanted], spool: Spool, timing: Timing
    ) -> None:
        self._stream, self._wanted, self._spool, self._timing = stream, wanted, spool, timing
        self._columns = [spool.column() for _ in wanted]
        self._times = spool.column() if timing.rate is None else None

    def all(self, progress: Progress | None) -> Taken:
        for rows in self._stream.read(list(dict.fromkeys(w.column for w in self._wanted))):
            self._add(rows)
            if progress is not None:
                progress(self._timing.rows)
        warnings = list(self._timing.warnings())
        columns = [column.finish() for column in self._columns]
        rate, start, times = self._timing.rate, self._timing.start_s, None
        if self._times is not None:
            rate, first_s, times, columns = self._settle(self._times.finish(), columns, warnings)
            start += Fraction(first_s)
        return Taken(self._stream, tuple(columns), start, rate, times, tuple(warnings))

    def _add(self, rows: Rows) -> None:
        times, kept = self._timing(rows)
        for wanted, column in zip(self._wanted, self._columns, strict=True):
            values = np.asarray(rows.values[wanted.column])
            if values.shape != (times if kept is None else kept).shape:
                raise ValueError(f"column {wanted.column!r} and its times differ in shape")
            if kept is not None:
                values = values[kept]
            column.append(wanted.convert(values, times))
        if self._times is not None:
            self._times.append(times)

    def _settle(
        self, times: FloatArray, columns: list[FloatArray], warnings: list[str]
    ) -> tuple[Fraction | None, float, FloatArray | None, list[FloatArray]]:
        """Return rate and start of a uniform clock; else the stamps, each time once."""
        clock = uniform_clock(times, self._timing.unit_s)
        if clock is not None:
            return clock.rate, clock.start_s, None, columns
        leap = warn_of_leap(times)
        warnings += [] if leap is None else [leap]
        kept = _first_of_each(times)
        repeated = int(kept.size - kept.sum())
        if not repeated:
            return None, 0.0, times, columns
        if repeated > TOO_COARSE * kept.size:
            raise InputError(
                f"stream {self._stream.name!r}: {repeated} of {kept.size} rows repeat the time of "
                "the one before; record finer time stamps, or state rate_hz under [[clocks]]"
            )
        warnings.append(
            f"{repeated} rows repeat the time of another; only the first of each is used"
        )
        thin = [self._spool.thin(values, kept) for values in (times, *columns)]
        return None, 0.0, thin[0], thin[1:]


def _first_of_each(times: FloatArray) -> BoolArray:
    kept = np.ones(times.size, np.bool_)
    for first, part in chunks(times, overlap=1):
        kept[first + 1 : first + part.size] = np.diff(part) > 0
    return kept


def as_they_are(values: FloatArray, times_s: FloatArray) -> FloatArray:
    """Return ``values``: the conversion of a channel of pulses or of time readings."""
    return values
