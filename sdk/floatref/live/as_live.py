"""A recording processed as a stream would process it while the vehicle drove."""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np

from floatref.builtin_pipelines.signal_flows import NEEDS
from floatref.engine.automatic import run_named_or_best
from floatref.engine.choosing import AUTO
from floatref.engine.plugins import plugins
from floatref.engine.run import Progress, Result
from floatref.live.declared_channels import Piece
from floatref.live.following import Following
from floatref.live.points import LivePoints, join_points
from floatref.live.starting import settle
from floatref.screening.findings import Screening
from floatref.values.arrays import release
from floatref.values.channels import ChannelId
from floatref.values.clock import StampedClock, UniformClock
from floatref.values.recording import Channel, Recording

PIECE_S = 1.0
"""Length in s of the pieces in which a recording is pushed."""


Way = Callable[..., Result]
"""A function that takes recording, pipeline, settings and progress."""


def way_of(as_live: bool, diagnostics: bool = False) -> Way:
    """Return what processes a recording: `run_as_live`, or the whole run with ``diagnostics``."""
    return run_as_live if as_live else partial(run_named_or_best, diagnostics=diagnostics)


def run_as_live(
    recording: Recording,
    pipeline: str = AUTO,
    settings: Mapping[str, Any] | None = None,
    progress: Progress | None = None,
) -> Result:
    """Return what a stream makes of ``recording``: the profile of its final points.

    ``progress`` is called with the fraction pushed. Raises InputError as a stream does, and for a
    recording in which the vehicle does not move.
    """
    order = settle(recording.setup, clocks_of(recording), pipeline, settings)
    following, points = Following(order), list[LivePoints]()
    for done, pieces in pieces_of(recording):
        points += following.push(pieces)
        if progress is not None:
            progress(done)
    points += following.finish()
    profile = join_points(points)
    if order.reason:
        chosen = {"by": AUTO, "reason": order.reason}
        profile = replace(profile, provenance={**profile.provenance, "chosen": chosen})
    lines = tuple(dict.fromkeys(line for each in points for line in each.events))
    return Result(profile, lines, _screening(recording, profile.pipeline))


def clocks_of(recording: Recording) -> dict[ChannelId, UniformClock | None]:
    """Return the clock of every channel as a stream has it: None where samples have times."""
    clocks = ((c.id, c.clock) for c in recording.channels)
    return {name: c if isinstance(c, UniformClock) else None for name, c in clocks}


def pieces_of(
    recording: Recording, length_s: float = PIECE_S
) -> Iterator[tuple[float, dict[ChannelId, Piece]]]:
    """Yield the fraction of the recording and the samples of the next ``length_s``, in order."""
    spans = [channel.span_s for channel in recording.channels]
    begin_s, end_s = min(first for first, _ in spans), max(last for _, last in spans)
    count = int((end_s - begin_s) / length_s) + 1
    done = dict.fromkeys((c.id for c in recording.channels), 0)
    for number in range(1, count + 1):
        limit_s = begin_s + number * length_s if number < count else np.inf
        pieces = {}
        for channel in recording.channels:
            first, end = done[channel.id], _count_until(channel, limit_s)
            pieces[channel.id] = _piece(channel, first, end)
            done[channel.id] = end
        yield number / count, pieces


def _count_until(channel: Channel, limit_s: float) -> int:
    """Return how many samples come before ``limit_s``."""
    size, clock = channel.values.size, channel.clock
    if limit_s == np.inf:
        return size
    if isinstance(clock, StampedClock):
        return int(np.searchsorted(clock.times_s, limit_s))
    return min(size, max(0, int((limit_s - clock.start_s) * float(clock.rate))))


def _piece(channel: Channel, first: int, end: int) -> Piece:
    # A copy: what a stream holds is in memory, and the file's pages can go.
    values = np.array(channel.values[first:end])
    release(channel.values)
    if not isinstance(channel.clock, StampedClock):
        return Piece(values)
    return Piece(values, np.array(channel.clock.times_s[first:end]))


def _screening(recording: Recording, pipeline: str) -> Screening:
    architecture = plugins().pipeline(pipeline).architecture
    return Screening.of(recording, NEEDS[architecture](recording), None)
