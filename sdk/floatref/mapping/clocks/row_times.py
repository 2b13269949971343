"""The times of the rows of a stream: by its rate, by its ticks, or by a channel map."""

from collections.abc import Iterator
from fractions import Fraction

import numpy as np

from floatref.errors import InputError
from floatref.mapping.clocks.folded_times import Unfolding
from floatref.mapping.clocks.stamps import Advancing, as_ticks
from floatref.values.arrays import BoolArray, FloatArray
from floatref.values.clock import LATEST_S
from floatref.values.native import Epoch, Rows, Stream, Ticks


class Timing:
    """The times of successive rows of ``stream``.

    ``rate`` in Hz counts them, from the first tick or from ``start_s`` on; None reads their ticks.
    ``rows`` is the number of rows used, ``start_s`` the time of the first in s after the zero of
    the stream's epoch.
    """

    def __init__(self, stream: Stream, rate: Fraction | None, start_s: float | None) -> None:
        """Begin before the first row."""
        self.rate, self.rows = rate, 0
        self._stream, self._clock = stream, stream.clock
        self._unfolding, self._advancing = Unfolding(stream.clock), Advancing()
        self._first: int | float | None = None
        self._started = stream.clock.rate is not None or start_s is not None
        self._start = stream.clock.first_tick * stream.clock.tick_s
        if start_s is not None:
            self._start = Fraction(start_s)

    def __call__(self, rows: Rows) -> tuple[FloatArray, BoolArray | None]:
        """Return the times of the rows that are used, in s after the first, and these rows.

        None stands for all rows. Raises InputError for a time that no clock has, ValueError for
        ticks that are not numbers.
        """
        ticks = None if rows.ticks is None else as_ticks(np.asarray(rows.ticks))
        if self.rate is not None:
            times, kept = self._count_ticks(rows, ticks), None
        elif ticks is None:
            raise InputError(f"stream {self._stream.name!r} has no time from its adapter")
        else:
            ticks = self._unfolding(ticks)
            kept = self._advancing(ticks)
            times = self._since_first(ticks[kept])
        self.rows += times.size
        return times, kept

    @property
    def start_s(self) -> Fraction:
        """When the first row was taken, in s; InputError if no epoch explains it."""
        start = self._start + Fraction(self._clock.origin_ns, 10**9)
        self._check(start, 0)
        return start

    @property
    def unit_s(self) -> float:
        """The unit in s that time stamps are rounded to; unknown for floats."""
        return 0.0 if isinstance(self._first, float) else float(self._clock.tick_s)

    def warnings(self) -> Iterator[str]:
        """Yield warnings about the rows; InputError for no rows, or times that go back."""
        seen = self.rows + self._advancing.back + self._advancing.untimed
        if not seen:
            raise InputError(f"stream {self._stream.name!r} holds no rows; copy the complete file")
        if not self.rows:
            raise InputError(
                f"stream {self._stream.name!r}: all {seen} rows have no time; state rate_hz "
                "for it under [[clocks]] in the map"
            )
        if seen < self._stream.count:
            yield f"has {seen} of {self._stream.count} rows; the file is truncated"
        yield from self._advancing.warnings()
        yield from self._unfolding.warnings()

    def _count_ticks(self, rows: Rows, ticks: Ticks | None) -> FloatArray:
        assert self.rate is not None
        columns = [rows.ticks] if rows.ticks is not None else list(rows.values.values())
        count = len(columns[0]) if columns else 0
        if not self._started and ticks is not None and np.isfinite(ticks).any():
            at = int(np.argmax(np.isfinite(ticks)))
            self._start = Fraction(ticks[at].item()) * self._clock.tick_s
            self._start -= (self.rows + at) / self.rate
            self._started = True
        index = np.arange(self.rows, self.rows + count, dtype=np.float64)
        return index * self.rate.denominator / self.rate.numerator

    def _since_first(self, ticks: Ticks) -> FloatArray:
        """Return times since the first tick, unless the file's own floats can stay as they are."""
        if not ticks.size:
            return np.empty(0)
        if self._first is None:
            local_floats = ticks.dtype.kind == "f" and self._clock.epoch is Epoch.LOCAL
            self._first = 0.0 if local_floats else ticks[0].item()
            self._start = Fraction(self._first) * self._clock.tick_s
        size = self._clock.tick_s
        with np.errstate(over="ignore"):
            since = ticks - self._first
            if since.dtype.kind == "i":
                # They increase, so what is beyond int64 is right without a sign.
                since = since.view(np.uint64)
            times = np.asarray(since, np.float64) * size.numerator / size.denominator
        self._check(times[0], self.rows)
        self._check(times[-1], self.rows + times.size - 1)
        return np.asarray(times)

    def _check(self, time_s: float | Fraction, row: int) -> None:
        if not -LATEST_S <= time_s <= LATEST_S:
            raise InputError(
                f"stream {self._stream.name!r}: the time of row {row} is more than {LATEST_S:g} s "
                "from zero; its clock is broken, so state rate_hz under [[clocks]] in the map"
            )
