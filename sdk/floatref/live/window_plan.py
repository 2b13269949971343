"""Where the windows of a stream begin and end: decided at whole ticks, by the distance alone.

Tick n is at the time n × `TICK_S`. A decision at a tick depends on nothing behind it, nor on how
the samples came in, so that the windows of a run are the same for every stream of it.
"""

from dataclasses import dataclass, field
from enum import StrEnum

import numpy as np

from floatref.live.bounds import (
    BEFORE_S,
    CORE_S,
    MOVES_M,
    OVERDUE,
    RUN_IN_S,
    RUN_OUT_S,
    STANDS_S,
    TICK_S,
    Bounds,
)
from floatref.values.arrays import FloatArray
from floatref.values.channels import STANDARD_GRAVITY

CALM = round(5.0 / TICK_S)
"""Ticks of steady travel before a joint, and behind it."""
SLOW_MPS = 4.4704
"""Slowest speed in m/s at a joint: below it points are flagged as slow travel."""
BRAKES = 1.0
"""Largest change of speed around a joint in m/s²."""
SET_BACK_M = 1.0
"""A distance this far behind the farthest, in m, is of a counter that was set back."""
COMPARED = 5
"""Distances at the end of a tick that are compared with each other."""
SPARSE_S = 10.0
"""Time in s before a tick in which they are looked for where few come."""
HARDEST = 2.0 * STANDARD_GRAVITY
"""Limit of braking and speeding up of any vehicle, in m/s²."""


def last_sound(times_s: FloatArray, distances: FloatArray) -> float:
    """Return the last of ``distances``, in m, without what one or two wrong samples say.

    It lies where those before it lead, within `SET_BACK_M` or what braking can change: so that a
    sample far off neither ends a window nor makes it shorter. A leap that stays is taken when three
    samples have it. Few or no other samples are no ground to doubt the last one.
    """
    times, places = times_s[-COMPARED:], distances[-COMPARED:]
    off_m, unsure_m = compare(times, places)
    return float(places[np.flatnonzero(off_m <= unsure_m)[-1]])


def compare(times_s: FloatArray, places: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return by how many m each of a few ``places`` is off what the others say, and may be."""
    if places.size < 3:
        return np.zeros(places.size), np.zeros(places.size)
    middle = int(np.argsort(places, kind="stable")[places.size // 2])
    speed = float(np.median(np.diff(places) / np.diff(times_s)))
    since = times_s - times_s[middle]
    off_m = np.abs(places - places[middle] - speed * since)
    return off_m, np.maximum(SET_BACK_M, 0.5 * HARDEST * since**2)


class End(StrEnum):
    """Why a window ends."""

    JOINT = "joint"
    STANDSTILL = "standstill"
    SET_BACK = "distance set back"
    FINISH = "end of the stream"


@dataclass(frozen=True)
class Cut:
    """A window: the samples after ``begin_s`` and up to ``end_s``.

    Attributes:
        begin_s, end_s: infinite at the ends of the stream.
        at_s: time at which its place on the axis is known: of the joint before it, or its begin.
        joint_s: time of the joint at its end; None if the next one does not overlap.
        end: why it ends.
        set_back_m: by how much the distance behind it is less than it should be, in m.
    """

    begin_s: float
    end_s: float
    at_s: float
    end: End
    joint_s: float | None = None
    set_back_m: float = 0.0


@dataclass
class WindowPlan:
    """Plans the windows of a stream with these ``bounds``.

    Attributes:
        places: the distance in m at every tick since the window began.
        first: the tick of the first of them.
        begin_s: where the window begins.
        core: the tick of the joint before it, or of its first distance.
        joint: the tick of the joint at its end, once that is chosen.
        joined: whether the window overlaps the one before it.
        stands_m: the distance at which the vehicle is stationary, between two windows.
    """

    bounds: Bounds
    places: list[float] = field(default_factory=list)
    first: int = 0
    begin_s: float = -np.inf
    core: int = 0
    joint: int | None = None
    joined: bool = False
    stands_m: float | None = None

    def step(self, tick: int, distance_m: float | None) -> Cut | None:
        """Return the window that is complete at ``tick``, if one is.

        ``distance_m`` is that of `last_sound` then, None before the first.
        """
        if distance_m is None:
            return None
        if self.stands_m is not None:
            if abs(distance_m - self.stands_m) < MOVES_M:
                return None
            self._begin_again(tick, self.stands_m)
        if not self.places:
            self.first = self.core = tick
        elif max(self.places[-1], distance_m) - distance_m > SET_BACK_M:
            return self._set_back(tick, distance_m)
        self.places.append(max(distance_m, self.places[-1] if self.places else distance_m))
        cut = self._stand(tick)
        return cut if self.stands_m is not None else self._join(tick)

    def needed_from(self, tick: int) -> float:
        """Return the time in s before which no sample is needed, after the step at ``tick``."""
        return self.begin_s if self.stands_m is None else tick * TICK_S - BEFORE_S

    def finish(self) -> Cut | None:
        """Return the last window of the stream, if it holds anything that no other did."""
        if self.stands_m is not None:
            return None
        return self._cut(np.inf, End.FINISH)

    def _begin_again(self, tick: int, stood_m: float) -> None:
        before = round(BEFORE_S / TICK_S)
        self.stands_m, self.joint, self.joined = None, None, False
        self.first = self.core = tick - before
        self.begin_s = self.first * TICK_S
        self.places = [stood_m] * before

    def _stand(self, tick: int) -> Cut | None:
        """Return the window that a standstill ends."""
        ticks = round(STANDS_S / TICK_S)
        if len(self.places) <= ticks or self.places[-1] - self.places[-1 - ticks] >= MOVES_M:
            return None
        moved = self.joined or self.places[-1] - self.places[0] >= MOVES_M
        cut = self._cut(tick * TICK_S, End.STANDSTILL) if moved else None
        self.stands_m = self.places[-1]
        self.places = []
        return cut

    def _set_back(self, tick: int, distance_m: float) -> Cut:
        last_m = self.places[-1]
        cut = self._cut((tick - 1) * TICK_S, End.SET_BACK, set_back_m=last_m - distance_m)
        self.joint, self.joined = None, False
        self.first = self.core = tick
        # Between the two ticks lie samples of both counts.
        self.begin_s, self.places = tick * TICK_S, [distance_m]
        return cut

    def _cut(self, end_s: float, end: End, set_back_m: float = 0.0) -> Cut:
        return Cut(self.begin_s, end_s, self._at_s, end, set_back_m=set_back_m)

    @property
    def _at_s(self) -> float:
        return self.core * TICK_S if self.joined else self.begin_s

    def _join(self, tick: int) -> Cut | None:
        """Return the window whose run-out is complete; choose its joint before."""
        if self.joint is None:
            self.joint = self._choose(tick)
        if self.joint is None:
            return None
        gone_m = self.places[-1] - self._place(self.joint)
        gone_s = (tick - self.joint) * TICK_S
        settled = gone_m >= self.bounds.fade_m + self.bounds.settle_m
        if not (settled and gone_s >= self.bounds.settle_s) and gone_s < RUN_OUT_S:
            return None
        joint_s = self.joint * TICK_S
        cut = Cut(self.begin_s, tick * TICK_S, self._at_s, End.JOINT, joint_s)
        self._begin_before(self.joint)
        return cut

    def _choose(self, tick: int) -> int | None:
        """Return the tick of the joint, if the window is long enough by now."""
        gone_m = self.places[-1] - self._place(self.core)
        gone_s = (tick - self.core) * TICK_S
        share = max(gone_m / self.bounds.core_m, gone_s / CORE_S)
        if share >= OVERDUE:
            return tick
        return tick - CALM if share >= 1.0 and self._is_calm else None

    @property
    def _is_calm(self) -> bool:
        """Whether the vehicle has gone at a steady speed lately."""
        latest = np.array(self.places[-2 * CALM - 1 :: 2])
        speed = np.diff(latest) / (2.0 * TICK_S)
        steady = speed.size > 1 and bool(np.abs(np.diff(speed)).max() <= BRAKES * 2.0 * TICK_S)
        return steady and float(speed.min()) >= SLOW_MPS

    def _begin_before(self, joint: int) -> None:
        """Begin the next window a run-in before ``joint``."""
        at_m, earliest = self._place(joint), joint - round(RUN_IN_S / TICK_S)
        begin = joint - round(self.bounds.settle_s / TICK_S)
        while begin > self.first and at_m - self._place(begin) < self.bounds.settle_m:
            begin -= 1
        begin = max(begin, earliest, self.first)
        del self.places[: begin - self.first]
        self.first, self.begin_s = begin, begin * TICK_S
        self.core, self.joint, self.joined = joint, None, True

    def _place(self, tick: int) -> float:
        return self.places[tick - self.first]
