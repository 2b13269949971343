"""The stream itself: samples in, final points out, in one thread and without any clock.

Whatever the stream decides, it decides at ticks, from the samples up to that tick. The ticks that
have passed are those that every channel has reached, or from which another channel is more than
`Bounds.late_s` away: what has not come by then counts as missing.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from math import floor
from typing import Any

import numpy as np

from floatref.errors import InputError
from floatref.live.bounds import TICK_S, Bounds, Latency
from floatref.live.declared_channels import Piece
from floatref.live.forward_pass import ForwardPass, forward_pass_of
from floatref.live.held_samples import HeldChannel
from floatref.live.joints import Joints
from floatref.live.points import LivePoints
from floatref.live.window_plan import COMPARED, SPARSE_S, Cut, End, WindowPlan, last_sound
from floatref.live.window_run import (
    Processed,
    WindowRuns,
    begin_distance,
    end_distance,
    without_wrong_ends,
)
from floatref.stages.signals import DISTANCE
from floatref.values.arrays import FloatArray
from floatref.values.channels import ChannelId
from floatref.values.clock import UniformClock
from floatref.values.needs import FORCE
from floatref.values.recording import Channel, Recording


@dataclass(frozen=True)
class Order:
    """What a stream is to do.

    Attributes:
        example: setup and channels, without samples of use.
        clocks: the clock of every channel; None where samples have their times.
        pipelines: names of those to try for each window, the best first.
        reason: why the first of them was chosen; empty if it was named.
        settings: given in place of the pipelines' defaults.
        interval_m: distance between points.
        bounds: lengths of the windows.
        tracks: names of the wheel paths of the profile.
    """

    example: Recording
    clocks: Mapping[ChannelId, UniformClock | None]
    pipelines: tuple[str, ...]
    reason: str
    settings: Mapping[str, Any]
    interval_m: float
    bounds: Bounds
    tracks: tuple[str, ...]


class Following:
    """Follows the channels of a stream.

    Attributes:
        held: the samples that are still needed, by channel.
        plan: the windows.
        runs: what processes them.
        joints: what joins them.
        tick: the last tick that has passed; None before the first.
        distance_m: the last sound distance.
        late: by channel, how many samples came too late, since the last window.
        late_in_all: the same since the stream was started or resumed.
        refused: the first refusal of a window, until any window is accepted.
    """

    def __init__(self, order: Order, provisional: bool = False) -> None:
        """Begin without samples; with ``provisional`` points if the channels allow them."""
        self.order = order
        self.forward = _forward_pass(order) if provisional else None
        self.held = {name: HeldChannel(name, clock) for name, clock in order.clocks.items()}
        self.plan = WindowPlan(order.bounds)
        self.runs = WindowRuns(order.pipelines, order.settings, order.interval_m)
        fade = round(order.bounds.fade_m / order.interval_m)
        self.joints = Joints(order.tracks, order.interval_m, fade)
        self.tick: int | None = None
        self.distance_m: float | None = None
        self._needed_s = -np.inf
        self.late: dict[ChannelId, int] = {}
        self.late_in_all: dict[ChannelId, int] = {}
        self.refused: InputError | None = None
        self.accepted = False
        distance = order.example.channel(DISTANCE, order.example.tracks[0])
        self._distance = self.held[distance.id]

    def push(self, pieces: Mapping[ChannelId, Piece]) -> Iterator[LivePoints]:
        """Take the samples of ``pieces``, and yield the points that are final by them."""
        for name, piece in pieces.items():
            late = self.held[name].add(piece)
            if late:
                for counts in (self.late, self.late_in_all):
                    counts[name] = counts.get(name, 0) + late
        last = self._reached()
        if last is None:
            return
        tick = self._before_first() if self.tick is None else self.tick
        for each in range(tick + 1, last + 1):
            yield from self._pass(each)

    def finish(self) -> Iterator[LivePoints]:
        """Yield the points of the last window; InputError if no window was accepted."""
        cut = self.plan.finish()
        if cut is not None:
            yield from self._process(cut)
        if self.refused is not None and not self.accepted:
            raise self.refused

    @property
    def latency(self) -> Latency:
        """When points are final, and provisional ones there."""
        bounds = self.order.bounds
        first_s = None if self.forward is None else TICK_S + bounds.late_s
        return replace(bounds.latency, provisional_s=first_s)

    def _reached(self) -> int | None:
        """Return the last tick that may pass."""
        latest = [each.latest_s for each in self.held.values()]
        begun = [each.latest_s for each in self.held.values() if each.values.end > 0]
        if not begun:
            return None
        return floor(max(min(latest), max(begun) - self.order.bounds.late_s) / TICK_S)

    def _before_first(self) -> int:
        """Return the tick before the first sample of all."""
        return floor(min(each.begin_s for each in self.held.values()) / TICK_S) - 1

    def _pass(self, tick: int) -> Iterator[LivePoints]:
        before_s, time_s = (tick - 1) * TICK_S, tick * TICK_S
        for each in self.held.values():
            each.pass_time(time_s)
        self.tick = tick
        self._read_distance(before_s, time_s)
        cut = self.plan.step(tick, self.distance_m)
        if cut is not None:
            yield from self._process(cut)
        yield from self._look_ahead(before_s, time_s, cut)
        needed_s = self.plan.needed_from(tick)
        if needed_s != self._needed_s:
            self._needed_s = needed_s
            for each in self.held.values():
                each.drop(needed_s)

    def _read_distance(self, before_s: float, time_s: float) -> None:
        """Take the distance at a tick; without a sample since the last one it stays."""
        times, distances = _known(*self._distance.between(before_s, time_s))
        if not distances.size:
            return
        if distances.size < COMPARED:
            times, distances = _known(*self._distance.between(time_s - SPARSE_S, time_s))
        self.distance_m = last_sound(times, distances)

    def _look_ahead(self, begin_s: float, end_s: float, cut: Cut | None) -> Iterator[LivePoints]:
        if self.forward is None:
            return
        if cut is not None and cut.end is End.SET_BACK:
            self.forward.begin()
        points = self.forward.advance(self.held, begin_s, end_s, self.runs.offset_m)
        if points is not None:
            yield points

    def _process(self, cut: Cut) -> Iterator[LivePoints]:
        done = self.runs.process(cut, self._recording(cut))
        if done.refused is None:
            self.accepted = True
        else:
            self.refused = self.refused or done.refused
        events = (*self._say_late(), *done.lines)
        if done.refused is not None:
            events = (*events, f"{_name(cut)}: no elevation; {done.refused}")
        points = self.joints.add(
            done.points,
            done.joint,
            pipeline=done.pipeline,
            events=events,
            record=self._record(cut, done),
        )
        if points is not None:
            yield points
        elif events:
            yield self.joints.no_points(events)

    def _recording(self, cut: Cut) -> Recording | None:
        """Return the samples of the window; None without any."""
        channels = list(self._channels(cut))
        if not channels:
            return None
        whole = self.order.example
        return Recording(tuple(channels), whole.setup, whole.vendor, whole.model)

    def _channels(self, cut: Cut) -> Iterator[Channel]:
        for each in self.held.values():
            channel = each.cut(cut.begin_s, cut.end_s)
            if channel is None:
                continue
            if each.name.name == DISTANCE:
                channel = self._distance_of(cut, each, channel)
            yield channel

    def _distance_of(self, cut: Cut, held: HeldChannel, channel: Channel) -> Channel:
        if held.clock is None:
            before = held.between(-np.inf, cut.begin_s)
            channel = begin_distance(channel, before, cut.begin_s)
        channel = without_wrong_ends(channel)
        return end_distance(channel, cut.end_s) if cut.end is End.STANDSTILL else channel

    def _say_late(self) -> Sequence[str]:
        late, self.late = self.late, {}
        limit_s = self.order.bounds.late_s
        return [
            f"channel {name}: {count} samples came more than {limit_s:g} s later than another "
            "channel; counted as missing"
            for name, count in late.items()
        ]

    def _record(self, cut: Cut, done: Processed) -> dict[str, Any]:
        record: dict[str, Any] = {"end": str(cut.end), "settings": done.settings, **done.record}
        for name, time_s in (("begin_s", cut.begin_s), ("end_s", cut.end_s)):
            record[name] = time_s if np.isfinite(time_s) else None
        if self.order.reason:
            record["chosen"] = {"by": "auto", "reason": self.order.reason}
        return record


def _known(times_s: FloatArray, values: FloatArray) -> tuple[FloatArray, FloatArray]:
    known = ~np.isnan(values)
    return times_s[known], values[known]


def _forward_pass(order: Order) -> ForwardPass | None:
    force = order.example.find(FORCE, order.tracks[0])
    clock = None if force is None else order.clocks[force.id]
    return forward_pass_of(order.example, order.tracks, clock, order.interval_m)


def _name(cut: Cut) -> str:
    parts = [f"after {cut.begin_s:g} s"] if np.isfinite(cut.begin_s) else []
    parts += [f"up to {cut.end_s:g} s"] if np.isfinite(cut.end_s) else []
    return " ".join(["window", *parts])
