"""One window through the engine, as a recording of its own, onto the axis of the stream."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from math import isfinite
from typing import Any

import numpy as np

from floatref.engine.axis_place import (
    WRONG_M,
    Place,
    distance_at,
    nearest_samples,
    offset_at,
    point_number,
)
from floatref.engine.run import Result, run
from floatref.errors import InputError
from floatref.live.joints import WindowPoints
from floatref.live.window_plan import COMPARED, Cut, compare
from floatref.screening.damage.encoder_damage import LEAP
from floatref.values.arrays import FloatArray, IndexArray, frozen
from floatref.values.encoder.plausible_distance import FASTEST_MPS
from floatref.values.recording import Channel, Recording, StampedClock

OWN_RECORD = ("architecture", "floatref", "numpy")
"""What the record of every window has in common with that of the profile."""
EDGE = 1000
"""Samples at an end of a window of which the usual step of the distance is taken."""


@dataclass(frozen=True, eq=False)
class Processed:
    """What came of a window.

    Attributes:
        points: all that it measured.
        joint: number of the first point behind the joint at its end, None without one.
        pipeline: the name of the one that accepted it; empty if no pipeline did.
        settings: those of that pipeline.
        record: the engine's record of the window.
        lines: warnings, one line each.
        refused: why the pipeline, the last one of those tried, refused it.
    """

    points: WindowPoints
    joint: int | None
    pipeline: str = ""
    settings: Mapping[str, Any] = field(default_factory=dict)
    record: Mapping[str, Any] = field(default_factory=dict)
    lines: tuple[str, ...] = ()
    refused: InputError | None = None


@dataclass
class WindowRuns:
    """Processes the windows of a stream, in order.

    Attributes:
        pipelines: those to try, the best first.
        settings: given in place of their defaults.
        interval_m: distance between points.
        offset_m: by how much the axis is ahead of the encoder where the next window begins.
    """

    pipelines: Sequence[str]
    settings: Mapping[str, Any]
    interval_m: float
    offset_m: float = 0.0

    def process(self, cut: Cut, recording: Recording | None) -> Processed:
        """Return what comes of ``recording``, the samples of the window ``cut``.

        A window that every pipeline refuses has no points; the error is in the result.
        """
        lines: list[str] = []
        error: InputError | None = None
        for pipeline in self.pipelines if recording is not None else ():
            assert recording is not None
            try:
                place = Place(cut.at_s, self.offset_m)
                result = run(recording, pipeline, self.settings, place=place)
                return self._accept(cut, recording, result, lines)
            except InputError as refusal:
                lines.append(f"pipeline {pipeline}: not taken; {refusal}")
                error = refusal
        return self._refuse(cut, recording, lines, error)

    def _accept(
        self, cut: Cut, recording: Recording, result: Result, lines: Sequence[str]
    ) -> Processed:
        processed, profile = result.screening.recording, result.profile
        joint = None
        if cut.joint_s is not None:
            joint = point_number(distance_at(processed, cut.joint_s), self.interval_m)
        self._go_on(cut, recording, processed)
        first = round(profile.start_m / self.interval_m)
        record = {k: v for k, v in profile.provenance.items() if k not in OWN_RECORD}
        return Processed(
            WindowPoints(first, profile.tracks),
            joint,
            profile.pipeline,
            profile.settings,
            {"engine": {k: profile.provenance[k] for k in OWN_RECORD}, **record},
            (*lines, *result.warnings),
        )

    def _refuse(
        self,
        cut: Cut,
        recording: Recording | None,
        lines: Sequence[str],
        error: InputError | None,
    ) -> Processed:
        joint = None
        if cut.joint_s is not None and recording is not None:
            at_m = _sound_distance_at(recording, cut.joint_s) + self.offset_m
            joint = point_number(at_m, self.interval_m) if isfinite(at_m) else None
        self.offset_m += cut.set_back_m
        return Processed(WindowPoints(0, ()), joint, lines=tuple(lines), refused=error)

    def _go_on(self, cut: Cut, recording: Recording, processed: Recording) -> None:
        """Take over where this window leaves the axis."""
        at_s = cut.end_s if cut.joint_s is None else cut.joint_s
        self.offset_m = offset_at(recording, processed, at_s) + cut.set_back_m


def _sound_distance_at(recording: Recording, at_s: float) -> float:
    """Return the encoder's distance at a time; of a wrong sample there, that of those around it."""
    exact = distance_at(recording, at_s)
    times, values = nearest_samples(recording, at_s)
    if not values.size:
        return exact
    usual, reach_s = float(np.median(values)), float(np.ptp(times))
    return exact if abs(exact - usual) <= WRONG_M + FASTEST_MPS * reach_s else usual


def without_wrong_ends(channel: Channel) -> Channel:
    """Return a distance whose first and last samples are missing if their neighbours deny them.

    Within a recording, screening finds a wrong sample by what follows. At an end it is a leap, for
    which the engine refuses the recording; but a window's ends are ours.
    """
    size = channel.values.size
    wrong = [*_wrong_at_end(channel, range(size)), *_wrong_at_end(channel, range(size)[::-1])]
    if not wrong:
        return channel
    values = np.array(channel.values)
    values[wrong] = np.nan
    return Channel(channel.id, frozen(values), channel.clock)


def _wrong_at_end(channel: Channel, order: range) -> list[int]:
    """Return the numbers of the wrong samples with which ``order`` begins."""
    near = np.array(order[:EDGE], np.int64)
    near = near[~np.isnan(channel.values[near])]
    few = np.sort(near[:COMPARED])
    steps = np.abs(np.diff(channel.values[near[COMPARED:]]))
    moved = steps[steps > 0.0]
    usual_m = float(np.median(moved)) if moved.size else 0.0
    off_m, unsure_m = compare(_times_of(channel, few), channel.values[few])
    wrong = (off_m > unsure_m + LEAP * usual_m)[:: order.step]
    count = int(np.argmin(np.append(wrong, False)))
    return [int(number) for number in few[:: order.step][:count]]


def _times_of(channel: Channel, numbers: IndexArray) -> FloatArray:
    if not numbers.size:
        return np.zeros(0)
    first, last = int(numbers[0]), int(numbers[-1])
    return channel.clock.times(last - first + 1, first)[numbers - first]


def begin_distance(
    channel: Channel, before: tuple[FloatArray, FloatArray], begin_s: float
) -> Channel:
    """Return a distance with times of its own that begins at ``begin_s``.

    An encoder that gives a sample for each pulse has no sample while the vehicle is stationary.
    ``before`` are times in s and distances in m up to ``begin_s``; of them the last is used.
    """
    clock, (times, values) = channel.clock, before
    if not times.size or np.isnan(values[-1]) or not isinstance(clock, StampedClock):
        return channel
    around = [times[-1], clock.times_s[0]], [values[-1], channel.values[0]]
    begin_m = np.interp(begin_s, *around)
    joined = StampedClock(frozen(np.append(begin_s, clock.times_s)))
    return Channel(channel.id, frozen(np.append(begin_m, channel.values)), joined)


def end_distance(channel: Channel, end_s: float) -> Channel:
    """Return a distance with times of its own that ends at ``end_s``, in a standstill.

    Such an encoder has no pulse there, and the engine refuses a distance that ends so early.
    """
    clock, known = channel.clock, channel.values[~np.isnan(channel.values)]
    if not known.size or not isinstance(clock, StampedClock) or clock.times_s[-1] >= end_s:
        return channel
    joined = StampedClock(frozen(np.append(clock.times_s, end_s)))
    return Channel(channel.id, frozen(np.append(channel.values, known[-1])), joined)
