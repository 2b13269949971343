"""Small pushes become pieces of half a second, so that a push costs microseconds.

Handing samples to the thread costs far more than copying 160 of them: a lock, a thread that wakes
and then shares the interpreter with the caller. Samples of a channel with a rate are written behind
one another into memory that is there; all of them are handed over when a channel has reached the
next tick. Nothing is decided between two ticks, so that no point comes later.
"""

from collections import deque
from collections.abc import Mapping
from math import ceil, floor
from typing import Any

import numpy as np

from floatref.kernels.gathered import copy_sound
from floatref.live.bounds import TICK_S
from floatref.live.declared_channels import Entrance, Piece, Samples, is_plain
from floatref.values.arrays import FloatArray, frozen
from floatref.values.channels import ChannelId
from floatref.values.clock import UniformClock

SPARE = 1024
"""Samples for which a room is made beyond those of a tick."""


class Room:
    """Samples of one channel since the last handing over.

    Attributes:
        clock: its rate; None if its samples come with their times.
        size: number of samples in the room.
    """

    def __init__(self, clock: UniformClock | None, taken: int) -> None:
        """Begin behind ``taken`` samples that were pushed before."""
        self.clock, self.size = clock, 0
        rate_hz = 0.0 if clock is None else float(clock.rate)
        self._array = np.empty(ceil(rate_hz * TICK_S) + SPARE)
        self._taken = taken
        self._pieces: list[Piece] = []
        self._due_s = -np.inf
        self._due = 0
        self._look_ahead()

    def put(self, values: FloatArray) -> bool:
        """Write ``values`` behind the others, not yet as part of them; False if one is infinite.

        They are without gaps in memory: the kernel is compiled for no others.
        """
        end = self.size + values.size
        if end > self._array.size:
            self._array = np.append(self._array[: self.size], np.empty(2 * end))
        return copy_sound(values, self._array, self.size)

    def keep(self, count: int) -> bool:
        """Make the last ``count`` samples written part of the room; return whether it is due."""
        self.size += count
        return self._taken + self.size >= self._due

    def add(self, piece: Piece) -> bool:
        """Add a checked ``piece``, and return whether the room is due."""
        if self.clock is not None:
            self.put(piece.values)
            return self.keep(piece.values.size)
        if piece.times_s is None or not piece.times_s.size:
            return False
        self._pieces.append(piece)
        self.size += piece.values.size
        return float(piece.times_s[-1]) >= self._due_s

    def empty(self) -> Piece:
        """Return all samples, in memory of their own, and begin anew."""
        piece = Piece(frozen(np.array(self._array[: self.size])))
        if self.clock is None:
            piece, self._pieces = _join(self._pieces), []
            self._due_s = (floor(_last(piece) / TICK_S) + 1) * TICK_S
        self._taken, self.size = self._taken + self.size, 0
        self._look_ahead()
        return piece

    def _look_ahead(self) -> None:
        """Find the number of samples with which the next tick is reached."""
        if self.clock is None:
            return
        rate_hz, start_s = float(self.clock.rate), self.clock.start_s
        tick = floor((start_s + (self._taken - 1) / rate_hz) / TICK_S) + 1
        # A sample at the tick itself reaches it, but for rounding.
        self._due = ceil((tick * TICK_S - start_s) * rate_hz - 1e-6) + 1


class Gathering:
    """Takes the pushes of a stream, and says when they are to be handed over."""

    def __init__(
        self, clocks: Mapping[ChannelId, UniformClock | None], taken: Mapping[ChannelId, int]
    ) -> None:
        """Take samples of the channels with these clocks, behind those ``taken`` before."""
        self._rooms = {name: Room(clock, taken[name]) for name, clock in clocks.items()}
        rated = {name: self._rooms[name] for name, clock in clocks.items() if clock is not None}
        self._rated: dict[Any, Room] = {**rated, **{str(name): r for name, r in rated.items()}}

    def take(self, samples: Mapping[Any, Samples], entrance: Entrance) -> bool:
        """Copy the samples of one push, and return whether all are to be handed over.

        Raises InputError, and then takes nothing, for samples that ``entrance`` refuses.
        """
        written: list[tuple[Room, int]] = []
        others: dict[Any, Samples] = {}
        seen = set()
        for given, values in samples.items():
            room = self._rated.get(given)
            if room is None or id(room) in seen or not is_plain(values) or not room.put(values):
                others[given] = values
            else:
                seen.add(id(room))
                written.append((room, values.size))
        checked = entrance.check(others) if others else {}
        due = False
        for room, count in written:
            due |= room.keep(count)
        for name, piece in checked.items():
            due |= self._rooms[name].add(piece)
        return due

    @property
    def size(self) -> int:
        """Number of samples to hand over."""
        return sum(room.size for room in self._rooms.values())

    def hand_over(self) -> dict[ChannelId, Piece]:
        """Return the samples of every channel that has any, and begin anew."""
        return {name: room.empty() for name, room in self._rooms.items() if room.size}

    def append_whole(self, queue: deque[Mapping[ChannelId, Piece] | None]) -> None:
        """Append to ``queue`` what `hand_over` returns; no signal of a command comes between."""
        queue.append(self.hand_over())


def _join(pieces: list[Piece]) -> Piece:
    if len(pieces) == 1:
        return pieces[0]
    times = [piece.times_s for piece in pieces if piece.times_s is not None]
    values = np.concatenate([piece.values for piece in pieces])
    return Piece(frozen(values), frozen(np.concatenate(times)))


def _last(piece: Piece) -> float:
    return -np.inf if piece.times_s is None else float(piece.times_s[-1])
