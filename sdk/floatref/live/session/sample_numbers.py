"""Samples by their numbers: what came before is left out, what never came is missing."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import numpy as np

from floatref.errors import InputError
from floatref.live.session.messages import Piece, Samples
from floatref.values.clock import UniformClock

LONGEST_GAP_S = 86_400.0
"""Longest stretch of samples in s that may never come."""
AT_ONCE_S = 30.0
"""Missing samples are pushed in pieces of this length, in s, one channel beside another."""


@dataclass(frozen=True)
class Numbered:
    """A piece that begins where the channel has come to.

    Attributes:
        piece: its samples, without those that came before.
        missing: samples before them that never came.
    """

    piece: Piece
    missing: int


class SampleNumbers:
    """Knows how far each channel has come.

    Attributes:
        clocks: clock of each channel by its name, None where its samples have times.
        next: number of the next sample of each channel that the stream has not been given.
    """

    def __init__(
        self, clocks: Mapping[str, UniformClock | None], next_samples: Mapping[str, int]
    ) -> None:
        """Begin where the stream is."""
        self.clocks, self.next = dict(clocks), dict(next_samples)
        self.come = dict(next_samples)

    def begin(self, from_start: bool) -> None:
        """Expect a peer that sends what is next, or all samples ``from_start``."""
        self.come = dict.fromkeys(self.next, 0) if from_start else dict(self.next)

    def number(self, samples: Samples) -> dict[str, Numbered]:
        """Return what is new of ``samples``, by channel.

        Raises InputError naming channel and field for a channel that is not of the run, and times
        that do not fit.
        """
        return {name: self._number(name, piece) for name, piece in samples.channels.items()}

    def count(self, pieces: Mapping[str, Piece]) -> None:
        """Take note that the stream was given ``pieces``."""
        for name, piece in pieces.items():
            self.next[name] += piece.values.size

    def skip(self, numbered: Mapping[str, Numbered]) -> None:
        """Count the samples with times that never came: there is nothing to push in their place."""
        for name, each in numbered.items():
            if self.clocks[name] is None:
                self.next[name] += each.missing

    def _number(self, name: str, piece: Piece) -> Numbered:
        if name not in self.clocks:
            known = ", ".join(self.clocks)
            raise InputError(f"channels.{name}: was not declared in the hello; it has {known}")
        stamped = self.clocks[name] is None
        _check_times(name, piece, stamped)
        first = self.come[name] if piece.first is None else piece.first
        self.come[name] = first + piece.values.size
        known_before = min(max(self.next[name] - first, 0), piece.values.size)
        missing = max(first - self.next[name], 0) if piece.values.size else 0
        times = None if piece.times_s is None else piece.times_s[known_before:]
        return Numbered(Piece(piece.values[known_before:], times), missing)


def _check_times(name: str, piece: Piece, stamped: bool) -> None:
    if stamped and piece.times_s is None:
        raise InputError(f"channels.{name}.times_s: is missing; the channel has no rate")
    if not stamped and piece.times_s is not None:
        raise InputError(f"channels.{name}.times_s: the channel has a rate; leave the times out")
    if piece.times_s is not None and piece.times_s.size != piece.values.size:
        raise InputError(
            f"channels.{name}.times_s: {piece.times_s.size} times for {piece.values.size} values; "
            "give one for each"
        )


def fill(
    numbered: Mapping[str, Numbered], clocks: Mapping[str, UniformClock | None]
) -> Iterator[dict[str, Piece]]:
    """Yield NaN for all samples of channels with a rate that never came, all channels by turns.

    Raises InputError for more than a day of them.
    """
    left = {
        name: each.missing
        for name, each in numbered.items()
        if each.missing and clocks[name] is not None
    }
    for name, missing in left.items():
        length_s = missing / _rate(clocks[name])
        if length_s > LONGEST_GAP_S:
            raise InputError(
                f"channels.{name}.first: {missing} samples, {length_s:.0f} s, are missing before "
                "it; begin another run behind such a gap"
            )
    while left:
        counts = {n: min(k, round(AT_ONCE_S * _rate(clocks[n])) + 1) for n, k in left.items()}
        yield {name: Piece(np.full(count, np.nan)) for name, count in counts.items()}
        left = {n: k - counts[n] for n, k in left.items() if k > counts[n]}


def describe_missing(name: str, missing: int, numbers: SampleNumbers) -> str:
    """Return the line about ``missing`` samples of a channel that never came."""
    clock, number = numbers.clocks[name], numbers.next[name]
    where = f"number {number}"
    if clock is not None:
        where = f"{clock.start_s + number / float(clock.rate):.3f} s"
    return f"channel {name}: {missing} samples from {where} on were not sent; counted as missing"


def _rate(clock: UniformClock | None) -> float:
    assert clock is not None
    return float(clock.rate)
