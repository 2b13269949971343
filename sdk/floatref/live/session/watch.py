"""Who looks on while a run is served: a display, a page of an operator."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from floatref.live.points import LivePoints
from floatref.live.session.messages import Piece
from floatref.live.stream import LiveStream
from floatref.values.clock import UniformClock

OVER_S = 1.0
"""Time in s over which the speed is taken."""


@dataclass(frozen=True)
class Taken:
    """What a message of samples has brought.

    Attributes:
        samples: number of samples of each channel in it.
        time_s: time of the last known distance in s; None before there is one.
        distance_m: that distance in m.
        speed_mps: speed over the last second in m/s; None while it is not known.
    """

    samples: Mapping[str, int]
    time_s: float | None = None
    distance_m: float | None = None
    speed_mps: float | None = None


class Watch:
    """Is called for all that happens, by the thread that serves; it should return quickly.

    This one does nothing. A class of an observer overrides what it wants to see.
    """

    def declared(self, clocks: Mapping[str, UniformClock | None]) -> None:
        """See the clock of each channel by its name, None where its samples have times."""

    def started(self, stream: LiveStream) -> None:
        """See the ``stream``, once its channels are known or it goes on."""

    def read(self, pieces: Mapping[str, Piece]) -> None:
        """See the samples of a message, by channel; `took` follows."""

    def missed(self, name: str, count: int) -> None:
        """See that ``count`` samples of the channel ``name`` were never sent."""

    def took(self, taken: Taken) -> None:
        """See what a message of samples has brought."""

    def waited(self, begins: bool) -> None:
        """See that the run waits for its points to be calculated, or that it goes on.

        No message is read meanwhile.
        """

    def gave(self, points: LivePoints) -> None:
        """See ``points``, provisional or final, with their events; final ones are stored."""

    def event(self, text: str) -> None:
        """See one line about the connection or the samples."""

    def completed(self) -> None:
        """See that all points of the run were given."""

    def ended(self, text: str) -> None:
        """See why the run, or the connection, has ended."""


class Odometer:
    """Time, distance and speed of the vehicle, from the distances that are sent."""

    def __init__(self, clock: UniformClock | None) -> None:
        """Begin with the ``clock`` of the distance; None if its samples have times."""
        self._clock = clock
        self._known: list[tuple[float, float]] = []

    def add(self, piece: Piece, number: int) -> None:
        """Read the distances of ``piece``, whose first sample has the ``number``."""
        known = np.flatnonzero(~np.isnan(piece.values))
        ends = known[[0, -1]] if known.size > 1 else known
        for k in map(int, ends):
            self._known.append((self._time(piece, k, number), float(piece.values[k])))

    def see(self, counts: Mapping[str, int]) -> Taken:
        """Return what a message with these ``counts`` of samples has brought."""
        if not self._known:
            return Taken(counts)
        time_s, distance_m = self._known[-1]
        while len(self._known) > 2 and self._known[1][0] <= time_s - OVER_S:
            del self._known[0]
        before_s, before_m = self._known[0]
        speed = (distance_m - before_m) / (time_s - before_s) if time_s > before_s else None
        return Taken(counts, time_s, distance_m, speed)

    def _time(self, piece: Piece, k: int, number: int) -> float:
        if piece.times_s is not None:
            return float(piece.times_s[k])
        assert self._clock is not None
        return self._clock.start_s + (number + k) / float(self._clock.rate)
