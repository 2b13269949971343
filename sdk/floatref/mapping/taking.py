"""Reading the columns of one stream once, each through its conversion, onto the disk."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction

import numpy as np

from floatref.errors import InputError
from floatref.mapping.spool import Spool
from floatref.mapping.stamps import Advancing, uniform_clock
from floatref.values.arrays import BoolArray, FloatArray
from floatref.values.native import Epoch, NativeClock, Rows, Stream, Ticks
from floatref.values.scanning import chunks

UNKNOWN = "unknown"
"""Name of the clock of a stream whose file says nothing about time."""
TOO_COARSE = 0.5
"""Part of all rows that may repeat the time of the one before."""

Convert = Callable[[FloatArray, FloatArray], FloatArray]
"""From native samples and their times in s to samples in SI units."""
Progress = Callable[[int], None]


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
    told: tuple[str, ...]


def take(
    stream: Stream,
    wanted: Sequence[Wanted],
    spool: Spool,
    rate: Fraction | None = None,
    progress: Progress | None = None,
) -> Taken:
    """Return what ``wanted`` of ``stream``, kept in ``spool``.

    ``rate`` in Hz replaces the stream's own clock from its first row on. Raises InputError for
    a stream without a clock or rows, one whose time goes back or stands still, and if the disk
    has no room.
    """
    if stream.clock.name == UNKNOWN and rate is None:
        raise InputError(
            f"stream {stream.name!r} has no time; state rate_hz for it under [[clocks]] in the map"
        )
    spool.check_room(stream.count * (len(wanted) + (stream.clock.rate is None)))
    return _Taking(stream, wanted, spool, rate).all(progress)


class _Taking:
    """One pass over a stream."""

    def __init__(
        self, stream: Stream, wanted: Sequence[Wanted], spool: Spool, rate: Fraction | None
    ) -> None:
        self._stream, self._wanted, self._spool = stream, wanted, spool
        self._clock = stream.clock
        self._rate = rate or stream.clock.rate
        self._start = stream.clock.first_tick * stream.clock.tick_s
        self._first: int | float | None = None
        self._columns = [spool.column() for _ in wanted]
        self._times = spool.column() if self._rate is None else None
        self._advancing = Advancing()
        self._rows = 0

    def all(self, progress: Progress | None) -> Taken:
        for rows in self._stream.read(list(dict.fromkeys(w.column for w in self._wanted))):
            self._add(rows)
            if progress is not None:
                progress(self._rows)
        if not self._rows:
            raise InputError(f"stream {self._stream.name!r} holds no rows; copy the complete file")
        told = [*self._shortfall(), *self._advancing.told()]
        columns = [column.finish() for column in self._columns]
        times = None if self._times is None else self._times.finish()
        rate, start = self._rate, self._start
        if times is not None:
            rate, first_s, times, columns = self._settled(times, columns, told)
            start += Fraction(first_s)
        origin = Fraction(self._clock.origin_ns, 10**9)
        return Taken(self._stream, tuple(columns), origin + start, rate, times, tuple(told))

    def _add(self, rows: Rows) -> None:
        times, kept = self._timed(rows)
        for wanted, column in zip(self._wanted, self._columns, strict=True):
            values = rows.values[wanted.column]
            if kept is not None:
                values = values[kept]
            column.append(wanted.convert(values, times))
        if self._times is not None:
            self._times.append(times)
        self._rows += times.size

    def _timed(self, rows: Rows) -> tuple[FloatArray, BoolArray | None]:
        """Return the times in s of the rows that are kept, and which those are."""
        if self._rate is not None:
            count = _length(rows)
            if self._rows == 0 and self._clock.rate is None:
                self._begin(rows.ticks)
            index = np.arange(self._rows, self._rows + count, dtype=np.float64)
            return index * self._rate.denominator / self._rate.numerator, None
        if rows.ticks is None:
            raise InputError(f"stream {self._stream.name!r} has no time; its adapter gives none")
        kept = self._advancing(rows.ticks)
        ticks = rows.ticks[kept]
        if self._first is None:
            self._begin(ticks)
        since = ticks if self._first is None else ticks - self._first
        size = self._clock.tick_s
        return np.asarray(since, np.float64) * size.numerator / size.denominator, kept

    def _begin(self, ticks: Ticks | None) -> None:
        """Count from the first tick, unless the file's own floats can stay as they are."""
        if ticks is None or not ticks.size or not np.isfinite(ticks[0]):
            return
        as_they_are = ticks.dtype.kind == "f" and self._clock.epoch is Epoch.LOCAL
        self._first = 0.0 if as_they_are and self._rate is None else ticks[0].item()
        self._start = Fraction(self._first) * self._clock.tick_s

    def _shortfall(self) -> Iterator[str]:
        taken = self._rows + self._advancing.back + self._advancing.untimed
        if taken < self._stream.count:
            yield f"says {self._stream.count} rows and holds {taken}; the file is truncated"

    def _settled(
        self, times: FloatArray, columns: list[FloatArray], told: list[str]
    ) -> tuple[Fraction | None, float, FloatArray | None, list[FloatArray]]:
        """Return rate and start of a uniform clock; else the stamps, each time once."""
        clock = uniform_clock(times, _unit_s(self._clock, self._first))
        if clock is not None:
            return clock.rate, clock.start_s, None, columns
        kept = _first_of_each(times)
        repeated = int(kept.size - kept.sum())
        if not repeated:
            return None, 0.0, times, columns
        if repeated > TOO_COARSE * kept.size:
            raise InputError(
                f"stream {self._stream.name!r}: {repeated} of {kept.size} rows repeat the time of "
                "the one before; record finer time stamps, or state rate_hz under [[clocks]]"
            )
        told.append(f"{repeated} rows repeat the time of another; the first of each is kept")
        thin = [self._spool.thinned(values, kept) for values in (times, *columns)]
        return None, 0.0, thin[0], thin[1:]


def _length(rows: Rows) -> int:
    if rows.ticks is not None:
        return int(rows.ticks.size)
    return next(iter(rows.values.values())).size if rows.values else 0


def _unit_s(clock: NativeClock, first: int | float | None) -> float:
    """Return the unit that time stamps are rounded to; floats tell none."""
    return 0.0 if isinstance(first, float) else float(clock.tick_s)


def _first_of_each(times: FloatArray) -> BoolArray:
    kept = np.ones(times.size, np.bool_)
    for first, part in chunks(times, overlap=1):
        kept[first + 1 : first + part.size] = np.diff(part) > 0
    return kept


def as_they_are(values: FloatArray, times_s: FloatArray) -> FloatArray:
    """Return ``values``: the conversion of a channel of pulses or of time readings."""
    return values
