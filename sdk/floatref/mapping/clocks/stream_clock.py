"""The clock of one stream, put onto the time base of the recording."""

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

import numpy as np

from floatref.mapping.channel_map.entries import ClockEntry
from floatref.mapping.clocks.clock_keys import Key
from floatref.mapping.clocks.columns import Taken
from floatref.mapping.clocks.stamps import uniform_clock
from floatref.mapping.spool import Spool
from floatref.measures.clocks.clock_alignment import Alignment
from floatref.measures.clocks.pulses import pulse_times_at_rate, pulse_times_by
from floatref.values.arrays import FloatArray
from floatref.values.clock import Clock, StampedClock, UniformClock
from floatref.values.scanning import CHUNK, chunks


class Aligned:
    """A stream whose first row was taken ``start_s`` after the zero of its own clock.

    ``alignment`` leads to base time, None if the clock is the base clock. ``report`` describes the
    alignment, None for the base; ``warnings`` has warnings.
    """

    def __init__(
        self,
        taken: Taken,
        start_s: Fraction,
        alignment: Alignment | None,
        spool: Spool,
        report: Mapping[str, Any] | None = None,
        warnings: tuple[str, ...] = (),
    ) -> None:
        """Keep new stamps in ``spool``."""
        self._taken, self._start, self.alignment = taken, start_s, alignment
        self._spool = spool
        self._clocks: dict[float, Clock] = {}
        self.report = report
        beyond = None if alignment is None else self._beyond(alignment)
        self.warnings = warnings if beyond is None else (*warnings, beyond)

    @property
    def rate(self) -> Fraction | None:
        """Rows per second of the own clock, None for time stamps."""
        return self._taken.rate

    @property
    def start_s(self) -> float:
        """The first row, or the zero of time stamps, in s after the zero of the own clock."""
        return float(self._start)

    def clock(self, delay_s: float) -> Clock:
        """Return the clock of samples that were taken ``delay_s`` before their time stamps."""
        if delay_s not in self._clocks:
            self._clocks[delay_s] = self._clock(delay_s)
        return self._clocks[delay_s]

    def sparse(self, values: FloatArray, clock: Clock) -> tuple[FloatArray, Clock]:
        """Return the samples of ``values``, shape (N,), without missing ones, and their clock."""
        if not any(np.isnan(part).any() for _, part in chunks(values)):
            return values, clock
        found, times = self._spool.column(), self._spool.column()
        for first, part in chunks(values):
            kept = ~np.isnan(part)
            found.append(part[kept])
            times.append(clock.times(part.size, first)[kept])
        stamps = times.finish()
        even = uniform_clock(stamps, 0.0) if stamps.size else None
        return found.finish(), StampedClock(stamps) if even is None else even

    def own_times(self, first: int = 0, count: int | None = None) -> FloatArray:
        """Return the times of rows from ``first`` on, in s after the zero of the own clock."""
        taken = self._taken
        if taken.rate is not None:
            size = taken.columns[0].size - first if count is None else count
            index = np.arange(first, first + size, dtype=np.float64)
            return float(self._start) + index * taken.rate.denominator / taken.rate.numerator
        assert taken.times_s is not None
        end = None if count is None else first + count
        return float(self._start) + taken.times_s[first:end]

    def _beyond(self, alignment: Alignment) -> str | None:
        last = self._taken.columns[0].size - 1
        begin, end = (float(self.own_times(at, 1)[0]) for at in (0, last))
        beyond = alignment.beyond(begin, end)
        return None if beyond is None else f"stream {self._taken.stream.name!r}: {beyond}"

    def _clock(self, delay_s: float) -> Clock:
        alignment, rate = self.alignment, self._taken.rate
        start = float(self._start) - delay_s
        if rate is not None and alignment is None:
            return UniformClock(rate, start)
        if rate is not None and alignment is not None and alignment.uniform:
            begin = float(alignment.to_base(np.array([start]))[0])
            return UniformClock.of(alignment.rate(float(rate)), begin)
        if alignment is None and start == 0 and self._taken.times_s is not None:
            return StampedClock(self._taken.times_s)
        times = self._spool.column()
        for first in range(0, self._taken.columns[0].size, CHUNK):
            count = min(CHUNK, self._taken.columns[0].size - first)
            own = self.own_times(first, count) - delay_s
            times.append(own if alignment is None else alignment.to_base(own))
        return StampedClock(times.finish())


def alignment_report(key: Key, entry: ClockEntry | None, alignment: Alignment) -> Mapping[str, Any]:
    """Return the report of the alignment of the stream ``key`` by ``entry``."""
    return {
        "file": key[0],
        "stream": key[1],
        "align": entry.align if entry is not None else "epoch",
        "offset_s": alignment.offset_s,
        "drift_ppm": 1e6 * alignment.drift,
        "drift_sigma_ppm": 1e6 * alignment.drift_sigma,
        "residual_s": alignment.residual_s,
        "pairs": alignment.pairs,
    }


@dataclass(frozen=True, eq=False)
class Timed:
    """Samples ``values``, shape (N,), of a stream with a known clock; read in pieces."""

    values: FloatArray
    stream: Aligned

    @property
    def step_s(self) -> float:
        """Mean time between two samples in s."""
        last = self.values.size - 1
        begin, end = (float(self.stream.own_times(at, 1)[0]) for at in (0, last))
        return (end - begin) / max(last, 1)

    def pulses(self) -> FloatArray:
        """Return the times of the pulses in s on the own clock; InputError without pulses."""
        rate, start = self.stream.rate, self.stream.start_s
        if rate is not None:
            return pulse_times_at_rate(self.values, float(rate), start)
        return pulse_times_by(self.values, self.stream.own_times)

    def readings(self) -> tuple[FloatArray, FloatArray]:
        """Return where readings of GNSS time change: own times in s, and what is read there."""
        times, readings = [], []
        before = np.nan
        for first, part in chunks(self.values):
            new = np.flatnonzero((np.diff(part, prepend=before) != 0) & ~np.isnan(part))
            if part.size and new.size:
                times.append(self.stream.own_times(first, part.size)[new])
                readings.append(part[new])
            before = part[-1]
        if not times:
            return np.empty(0), np.empty(0)
        return np.concatenate(times), np.concatenate(readings)
