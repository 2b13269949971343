"""Time stamps that come again, made to go on: times of a day at midnight, UTC at a leap second.

UTC stamps count no leap seconds: 23:59:60 and the second 00:00:00 behind it have the same number,
and a stream of them goes back by a second there, or repeats one. Behind it they are a second short
of the time that has passed.
"""

from collections.abc import Iterator

import numpy as np

from floatref.measures.clocks.gnss_time import FIRST_DAYS, LEAPS_UNIX_S
from floatref.values.arrays import FloatArray
from floatref.values.native import Epoch, NativeClock, Ticks

LATE = 23 / 24
"""Part of a turn by which a stamp goes ahead that came late, from before the turn."""
NEAR_S = 1.5
"""Longest time in s between a leap second and the stamp that comes again, if rows are closer."""
SHORT_S = 0.5
"""Time in s by which that stamp goes ahead less than usual, at least."""


class Unfolding:
    """The ticks of a stream, made to go on in order of its rows."""

    def __init__(self, clock: NativeClock) -> None:
        """Begin before the first row of a stream on ``clock``."""
        self._second = float(1 / clock.tick_s)
        self._turn = None if clock.turn_s is None else clock.turn_s / clock.tick_s
        self._leaps: dict[int, float] = {}
        if clock.epoch is Epoch.UTC and clock.turn_s is None:
            origin_s = clock.origin_ns / 10**9
            self._leaps = {n: (s - origin_s) * self._second for n, s in enumerate(LEAPS_UNIX_S)}
        self._found: set[int] = set()
        self._first = self._last = np.nan
        self._usual, self._added = 0.0, np.zeros(1)

    def __call__(self, ticks: Ticks) -> Ticks:
        """Return ``ticks``, shape (n,), with what the stream has turned back by until there."""
        known = np.isfinite(ticks)
        there = ticks if known.all() else ticks[known]
        if not there.size or (self._turn is None and not self._leaps):
            return ticks
        # No step leads to the first tick of all.
        steps = np.diff(np.asarray(there, np.float64), prepend=self._last)
        if np.isnan(self._last):
            self._first = float(there[0])
        self._add_turns(steps) if self._turn is not None else self._add_leaps(there, steps)
        self._last = float(there[-1])
        if not self._added.any():
            return ticks
        found = ticks.copy()
        found[known] += self._added.astype(ticks.dtype)
        return found

    def warnings(self) -> Iterator[str]:
        """Yield a line for each leap second within the stream."""
        for number, at in self._leaps.items():
            if not self._first < at <= self._last:
                continue
            where = f"the leap second before {FIRST_DAYS[number]}"
            if number in self._found:
                yield f"{where} is counted: time stamps come again there"
            else:
                yield (
                    f"{where} is within it, and no time stamp comes again there; taken to have "
                    "gone on, so that later ones may be 1 s off beside GPS time"
                )

    def _add_turns(self, steps: FloatArray) -> None:
        """Add a turn where ticks fall by half of one, and take it back for a late one."""
        turn = float(self._turn or 0)
        turns = np.where(steps <= -turn / 2, 1, np.where(steps >= LATE * turn, -1, 0))
        self._added = self._added[-1] + np.rint(turn * np.cumsum(turns))

    def _add_leaps(self, there: Ticks, steps: FloatArray) -> None:
        """Add a second from the tick on that comes again at a leap second."""
        forth = steps[steps > 0]
        self._usual = float(np.median(forth)) if forth.size else self._usual
        self._added = np.full(there.size, self._added[-1])
        before = NEAR_S * self._second
        behind = max(before, self._usual)
        low, high = there.min() - behind, there.max() + before
        for number, at in self._leaps.items():
            if not low <= at <= high:
                continue
            near = (there >= at - before) & (there <= at + behind)
            again = near & (self._usual - steps >= SHORT_S * self._second)
            if again.any() and number not in self._found:
                self._found.add(number)
                self._added[int(np.argmax(again)) :] += self._second
