"""Channels of several devices, each started and stopped for itself, cut to the time they share.

Within one clock nothing is cut: there the samples behind an early end were lost.
"""

from collections.abc import Hashable, Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from floatref.errors import InputError
from floatref.screening.plausibility import TRUNCATION_S
from floatref.values.clock import StampedClock, UniformClock
from floatref.values.recording import Channel

DAY_S = 86_400.0
TURN_S = 1024 * 7 * DAY_S
"""Time in s after which the 10 bits of the GPS week begin again."""


class Span(NamedTuple):
    """Times in s between which something was sampled."""

    begin: float
    end: float


def cut_to_shared(
    channels: Sequence[Channel], clocks: Sequence[Hashable], base: int
) -> tuple[tuple[Channel, ...], tuple[str, ...]]:
    """Return ``channels``, those of the vehicle cut to the time its clocks share, and warnings.

    ``clocks`` has the clock of every channel, ``base`` is the channel of the time base. Times that
    differ by less than the missing time that a recording allows are not cut. Raises InputError for
    a channel that shares no time with the base.
    """
    spans = [Span(*channel.span_s) for channel in channels]
    for channel, span in zip(channels, spans, strict=True):
        _check(channel, span, channels[base], spans[base])
    vehicle = [k for k, c in enumerate(channels) if not c.id.name.startswith("gnss_")]
    of = {clocks[k] for k in vehicle}
    if len(of) < 2:
        return tuple(channels), ()
    whole = [_unite([spans[k] for k in vehicle if clocks[k] == clock]) for clock in of]
    shared = Span(max(s.begin for s in whole), min(s.end for s in whole))
    if shared.begin > shared.end:
        raise InputError(
            "the channels of its clocks share no time; look at each with fewer of them mapped, "
            "and correct under [[clocks]] how they are aligned"
        )
    widest = _unite(whole)
    if _near(shared, widest):
        return tuple(channels), ()
    cut = [_cut(c, shared) if k in vehicle else c for k, c in enumerate(channels)]
    line = (
        f"channels of several clocks, from {widest.begin:.6g} to {widest.end:.6g} s: cut to what "
        f"all of them share, from {shared.begin:.6g} to {shared.end:.6g} s"
    )
    return tuple(cut), (line,)


def _check(channel: Channel, span: Span, base: Channel, time: Span) -> None:
    if span.end >= time.begin and span.begin <= time.end:
        return
    raise InputError(
        f"channel {channel.id}: its samples, from {span.begin:.10g} to {span.end:.10g} s, share no "
        f"time with {base.id}, from {time.begin:.10g} to {time.end:.10g} s; {_remedy(span, time)}"
    )


def _remedy(span: Span, time: Span) -> str:
    """Return what to do where ``span`` and ``time`` share nothing."""
    turns = (span.begin - time.begin) / TURN_S
    if round(turns) and abs(turns - round(turns)) * TURN_S < DAY_S:
        return (
            f"they are {1024 * abs(round(turns))} weeks apart, by which a receiver is off that "
            "missed a roll-over of the GPS week: update it, and align this run by base_time, "
            "base_pps or an offset under [[clocks]]"
        )
    return "correct under [[clocks]] how its clock is aligned"


def _unite(spans: Sequence[Span]) -> Span:
    return Span(min(s.begin for s in spans), max(s.end for s in spans))


def _near(one: Span, other: Span) -> bool:
    apart = abs(one.begin - other.begin), abs(one.end - other.end)
    return max(apart) <= TRUNCATION_S


def _cut(channel: Channel, span: Span) -> Channel:
    """Return ``channel`` from its last sample before ``span`` to the first behind it."""
    clock, size = channel.clock, channel.values.size
    if isinstance(clock, UniformClock):
        rate = float(clock.rate)
        first = int(np.floor((span.begin - clock.start_s) * rate))
        end = int(np.ceil((span.end - clock.start_s) * rate)) + 1
    else:
        first = int(np.searchsorted(clock.times_s, span.begin, "right")) - 1
        end = int(np.searchsorted(clock.times_s, span.end)) + 1
    first, end = max(first, 0), min(end, size)
    if isinstance(clock, UniformClock):
        kept = replace(clock, start_s=float(clock.times(1, first)[0]))
        return replace(channel, values=channel.values[first:end], clock=kept)
    stamps = StampedClock(clock.times_s[first:end])
    return replace(channel, values=channel.values[first:end], clock=stamps)
