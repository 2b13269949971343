"""Samples of one channel that a stream still needs: appended at the end, dropped at the front."""

from bisect import bisect_right
from math import floor

import numpy as np

from floatref.live.declared_channels import Piece
from floatref.values.arrays import FloatArray, frozen
from floatref.values.channels import ChannelId
from floatref.values.clock import StampedClock, UniformClock
from floatref.values.recording import Channel

TIE = 1e-6
"""Share of a step by which a sample may lie behind a limit and still be before it."""
MOST_S = 60.0
"""Samples missing for longer than this, in s, are not stored one by one: no window needs them."""
EMPTY = frozen(())


class Pieces:
    """An array in pieces; sample k is the one that was appended as number k, from 0 on."""

    def __init__(self, first: int = 0) -> None:
        """Begin without samples; the next one has number ``first``."""
        self._pieces: list[FloatArray] = []
        self._starts: list[int] = []
        self.first = self.end = first

    def append(self, values: FloatArray) -> None:
        """Add ``values``, shape (N,), at the end."""
        if values.size:
            self._pieces.append(values)
            self._starts.append(self.end)
            self.end += values.size

    def skip_to(self, number: int) -> None:
        """Drop all samples; the next one has this ``number``."""
        self._pieces, self._starts = [], []
        self.first = self.end = number

    def take(self, low: int, high: int) -> FloatArray:
        """Return samples ``low`` to ``high`` - 1, as far as they are held."""
        low, high = max(low, self.first), min(high, self.end)
        if high <= low:
            return EMPTY
        begin, stop = self._piece_of(low), self._piece_of(high - 1) + 1
        parts = self._pieces[begin:stop]
        offset = self._starts[begin]
        joined = parts[0] if len(parts) == 1 else np.concatenate(parts)
        return frozen(joined[low - offset : high - offset])

    def drop(self, first: int) -> None:
        """Drop the samples before ``first``; whole pieces alone give their memory back."""
        self.first = min(max(first, self.first), self.end)
        done = self._piece_of(self.first) if self.first < self.end else len(self._pieces)
        del self._pieces[:done], self._starts[:done]

    def merge(self, since: int) -> None:
        """Make one piece of those from sample ``since`` on."""
        begin = bisect_right(self._starts, since - 1)
        if len(self._starts) - begin > 1:
            joined = np.concatenate(self._pieces[begin:])
            del self._pieces[begin + 1 :], self._starts[begin + 1 :]
            self._pieces[begin] = joined

    def search(self, value: float) -> int:
        """Return the number of the first sample above ``value``; samples increase."""
        low, high = 0, len(self._pieces)
        while low < high:
            middle = (low + high) // 2
            if self._pieces[middle][-1] <= value:
                low = middle + 1
            else:
                high = middle
        if low == len(self._pieces):
            return self.end
        inside = int(np.searchsorted(self._pieces[low], value, "right"))
        return max(self._starts[low] + inside, self.first)

    @property
    def count(self) -> int:
        """Number of samples in memory."""
        return self.end - self._starts[0] if self._starts else 0

    def _piece_of(self, number: int) -> int:
        return bisect_right(self._starts, number) - 1


class HeldChannel:
    """The samples of one channel since some time.

    Attributes:
        name: the channel.
        clock: its rate; None if its samples come with their times.
        passed_s: no sample up to this time is accepted any more.
        owed: samples of a channel with a rate that counted as missing before they came.
    """

    def __init__(self, name: ChannelId, clock: UniformClock | None) -> None:
        """Begin without samples."""
        self.name, self.clock = name, clock
        self.values = Pieces()
        self.times = Pieces()
        self.passed_s = -np.inf
        self.owed = 0
        self._merged = 0
        # A push asks for the time of the last sample of every channel.
        self._rate = (0, 1) if clock is None else (clock.rate.numerator, clock.rate.denominator)

    @property
    def latest_s(self) -> float:
        """Time up to which the channel is known, in s."""
        if self.clock is not None:
            return self._time(self.values.end - 1)
        last = self.times.take(self.times.end - 1, self.times.end)
        return float(last[0]) if last.size else self.passed_s

    @property
    def begin_s(self) -> float:
        """Time of the first sample in s; infinite without any."""
        if not len(self):
            return np.inf
        return float(self.between(-np.inf, np.inf)[0][0])

    def __len__(self) -> int:
        """Return the number of samples held."""
        return self.values.end - self.values.first

    @property
    def taken(self) -> int:
        """Number of samples of a channel with a rate that have come."""
        return self.values.end - self.owed

    def restore(self, values: FloatArray, times_s: FloatArray, first: int) -> None:
        """Hold these samples alone, the first of which has the number ``first``."""
        for pieces, array in ((self.values, values), (self.times, times_s)):
            pieces.skip_to(first)
            pieces.append(frozen(array))
        self._merged = self.values.end

    def add(self, piece: Piece) -> int:
        """Append the samples of ``piece``, and return how many came too late."""
        late = min(self.owed, piece.values.size)
        if piece.times_s is not None:
            late = int(np.searchsorted(piece.times_s, self.passed_s, "right"))
            self.times.append(piece.times_s[late:])
        else:
            self.owed -= late
        self.values.append(piece.values[late:])
        return late

    def pass_time(self, time_s: float) -> None:
        """Count what has not come up to ``time_s`` as missing."""
        self.passed_s = time_s
        if self.clock is not None:
            self._miss(self._number(time_s))
        for pieces in (self.values, self.times):
            pieces.merge(self._merged)
        self._merged = self.values.end

    def _miss(self, until: int) -> None:
        missing = until - self.values.end
        if missing <= 0:
            return
        self.owed += missing
        assert self.clock is not None
        if missing > MOST_S * self.clock.rate:
            self.values.skip_to(until)
            self._merged = until
        else:
            self.values.append(np.full(missing, np.nan))

    def numbers(self, begin_s: float, end_s: float) -> tuple[int, int]:
        """Return the first sample after ``begin_s``, and the first one after ``end_s``."""
        if self.clock is None:
            return self.times.search(begin_s), self.times.search(end_s)
        low = self.values.first if begin_s == -np.inf else self._number(begin_s)
        high = self.values.end if end_s == np.inf else self._number(end_s)
        return min(max(low, self.values.first), self.values.end), min(high, self.values.end)

    def between(self, begin_s: float, end_s: float) -> tuple[FloatArray, FloatArray]:
        """Return times in s and samples after ``begin_s`` and up to ``end_s``."""
        low, high = self.numbers(begin_s, end_s)
        values = self.values.take(low, high)
        if self.clock is None:
            return self.times.take(low, high), values
        return self.clock.times(values.size, low), values

    def cut(self, begin_s: float, end_s: float) -> Channel | None:
        """Return the channel between those times; None without a sample there."""
        low, high = self.numbers(begin_s, end_s)
        values = self.values.take(low, high)
        if not values.size:
            return None
        if self.clock is None:
            return Channel(self.name, values, StampedClock(self.times.take(low, high)))
        return Channel(self.name, values, UniformClock(self.clock.rate, self._time(low)))

    def drop(self, before_s: float) -> None:
        """Drop what lies before ``before_s``, but for the last sample of a channel with times."""
        first = self.numbers(before_s, np.inf)[0] - (self.clock is None)
        self.values.drop(first)
        self.times.drop(first)

    def _number(self, time_s: float) -> int:
        """Return the number of the first sample after ``time_s``."""
        assert self.clock is not None
        return max(0, floor((time_s - self.clock.start_s) * float(self.clock.rate) + TIE) + 1)

    def _time(self, number: int) -> float:
        """Return the time of a sample in s, as `UniformClock.times` has it."""
        assert self.clock is not None
        return self.clock.start_s + number * self._rate[1] / self._rate[0]
