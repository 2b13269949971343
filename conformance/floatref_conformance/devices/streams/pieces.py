"""A recording cut into pieces, in the order in which a vehicle would record its samples."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from math import floor

import numpy as np

from floatref.values.clock import StampedClock
from floatref.values.recording import Channel, Recording
from floatref_conformance.devices.streams.questions import Part, Samples

PIECE_S = 0.5
"""Length of a piece in s where nothing else is asked for."""
SHORTEST_S, LONGEST_S = 0.01, 3.0
"""Of pieces that are drawn, in s; longer ones would be later than a channel may be."""


@dataclass(frozen=True)
class Piece:
    """Samples of some channels, and the recorded time in s up to which all are pushed with it."""

    until_s: float
    samples: Samples


def even_cuts(recording: Recording, length_s: float = PIECE_S) -> tuple[float, ...]:
    """Return the ends in s of pieces of ``length_s``, the last at the end of ``recording``."""
    begin_s, end_s = span(recording)
    return (*np.arange(begin_s + length_s, end_s, length_s).tolist(), end_s)


def drawn_cuts(recording: Recording, seed: int) -> tuple[float, ...]:
    """Return ends in s of pieces of `SHORTEST_S` to `LONGEST_S`, drawn by ``seed``."""
    rng = np.random.default_rng(seed)
    at_s, end_s = span(recording)
    cuts = []
    while at_s < end_s:
        at_s += float(np.exp(rng.uniform(np.log(SHORTEST_S), np.log(LONGEST_S))))
        cuts.append(min(at_s, end_s))
    return tuple(cuts)


def span(recording: Recording) -> tuple[float, float]:
    """Return the times in s of the first sample of all and of the last."""
    spans = [channel.span_s for channel in recording.channels]
    return min(begin for begin, _ in spans), max(end for _, end in spans)


def cut(recording: Recording, cuts_s: Sequence[float], by_turns: bool = False) -> Iterator[Piece]:
    """Yield the samples up to each of ``cuts_s``; those behind the last are left out.

    With ``by_turns`` each channel comes as a piece of its own, in the opposite order.
    """
    done = dict.fromkeys((str(channel.id) for channel in recording.channels), 0)
    before_s = span(recording)[0]
    for limit_s in cuts_s:
        samples = {}
        for channel in recording.channels:
            name, end = str(channel.id), _count_until(channel, limit_s)
            if end > done[name]:
                samples[name] = _part(channel, done[name], end)
                done[name] = end
        yield from _turns(samples, before_s, limit_s) if by_turns else (Piece(limit_s, samples),)
        before_s = limit_s


def _turns(samples: Samples, before_s: float, limit_s: float) -> Iterator[Piece]:
    names = list(samples)[::-1]
    for name in names:
        yield Piece(limit_s if name == names[-1] else before_s, {name: samples[name]})


def _part(channel: Channel, first: int, end: int) -> Part:
    stamped = isinstance(channel.clock, StampedClock)
    times_s = channel.times_s[first:end] if stamped else None
    return Part(first, channel.values[first:end], times_s)


def _count_until(channel: Channel, limit_s: float) -> int:
    """Return how many samples come up to ``limit_s``, that moment included."""
    clock, size = channel.clock, channel.values.size
    if isinstance(clock, StampedClock):
        return int(np.searchsorted(clock.times_s, limit_s, side="right"))
    # A millionth of a sample: ends of pieces are rounded.
    return min(size, max(0, floor((limit_s - clock.start_s) * float(clock.rate) + 1e-6) + 1))
