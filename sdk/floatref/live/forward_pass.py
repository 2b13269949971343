"""Provisional points: one forward pass, at the adaptive cut-off (5.3), as the samples come.

The floating reference height is that of `MatchedHighPass`, which no stop disturbs. A forward pass
alone shifts long waves along the road: the error of a point is as large as its waves of some 30 m
and more, so these points show that a run is good, and not how rough the road is.
"""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from floatref.errors import InputError
from floatref.live.held_samples import HeldChannel
from floatref.live.points import LivePoints, State
from floatref.stages.filters.matched_high_pass import MatchedHighPass
from floatref.stages.filters.schedule import ScheduleCutOff
from floatref.stages.protocol import Stage
from floatref.stages.signals import (
    ACCELERATION,
    DISTANCE,
    HEIGHT,
    REFERENCE_HEIGHT,
    TRAVEL_SPEED,
)
from floatref.stages.speed import TravelSpeed
from floatref.values.arrays import BoolArray, FloatArray, frozen
from floatref.values.block import Axis, Block, Header
from floatref.values.channels import STANDARD_GRAVITY, ChannelId
from floatref.values.clock import UniformClock
from floatref.values.needs import FORCE
from floatref.values.profile import ProfileTrack
from floatref.values.recording import Recording

NAME = "forward pass of temporal-matched-hpf"
SLOW_MPS = 4.4704
"""Slowest speed in m/s at which a provisional point is valid."""
SETTLES_M = 105.91
"""Travel at that speed in m before a point is valid: a wavelength."""
MOST_POINTS = 1_000_000
"""Most points of one tick; more are of a distance that leaps."""


class ForwardPass:
    """Makes provisional points of the wheel paths ``tracks``, every ``interval_m``."""

    def __init__(
        self,
        tracks: Mapping[str, tuple[ChannelId, ChannelId]],
        distance: ChannelId,
        clock: UniformClock,
        interval_m: float,
    ) -> None:
        """Begin; ``tracks`` names accelerometer and height sensor of each wheel path.

        ``clock`` is that of the first accelerometer.
        """
        self._tracks, self._distance, self._interval_m = tracks, distance, interval_m
        self._force = next(iter(tracks.values()))[0]
        self._clock = clock
        self.begin()

    def begin(self) -> None:
        """Forget all samples, as where a distance was set back."""
        self._farthest_m = -np.inf
        self._next: int | None = None
        self._run_in()

    def _run_in(self) -> None:
        """Begin the filters anew, whose past is not that of the next samples."""
        axis = Header(
            Axis.TIME,
            float(1 / self._clock.rate),
            0.0,
            self._clock.rate,
            frozenset({ChannelId(DISTANCE)}),
            tuple(self._tracks),
        )
        names = (ChannelId(n, track) for track in self._tracks for n in (ACCELERATION, HEIGHT))
        header = axis.adding(*names)
        self._stages: tuple[Stage, ...] = TravelSpeed(), ScheduleCutOff(), MatchedHighPass()
        for stage in self._stages:
            header = stage.start(header)
        self._count = 0
        self._last: tuple[float, dict[str, float]] | None = None
        self._slow_m = np.nan

    def advance(
        self, held: Mapping[ChannelId, HeldChannel], begin_s: float, end_s: float, offset_m: float
    ) -> LivePoints | None:
        """Return the points that the vehicle passed after ``begin_s`` and up to ``end_s``, if any.

        The axis is ``offset_m`` ahead of the encoder. Where a channel has no sample in the stretch,
        nor in twice its length before, there are no points, and the filters begin anew.
        """
        signals = self._read(held, begin_s, end_s)
        if signals is None:
            self._run_in()
            return None
        distance = signals[ChannelId(DISTANCE)]
        distance = np.maximum.accumulate(np.maximum(distance, self._farthest_m))
        self._farthest_m = float(distance[-1])
        block = Block(self._count, {**signals, ChannelId(DISTANCE): frozen(distance)})
        self._count += len(block)
        try:
            for stage in self._stages:
                block = stage.push(block)
        except InputError:  # No vehicle is so fast.
            self.begin()
            return None
        elevations = {
            track: block[ChannelId(REFERENCE_HEIGHT, track)] - block[ChannelId(HEIGHT, track)]
            for track in self._tracks
        }
        return self._project(distance + offset_m, block[ChannelId(TRAVEL_SPEED)], elevations)

    def _read(
        self, held: Mapping[ChannelId, HeldChannel], begin_s: float, end_s: float
    ) -> dict[ChannelId, FloatArray] | None:
        """Return all signals at the accelerometer's samples; None if one has no sample."""
        steps = Steps(self._clock, *held[self._force].numbers(begin_s, end_s), begin_s)
        found = {ChannelId(DISTANCE): steps.read(held[self._distance])}
        for track, (force, height) in self._tracks.items():
            forces = steps.read(held[force])
            known = None if forces is None else frozen(forces - STANDARD_GRAVITY)
            found[ChannelId(ACCELERATION, track)] = known
            found[ChannelId(HEIGHT, track)] = steps.read(held[height])
        known_signals = {name: signal for name, signal in found.items() if signal is not None}
        return known_signals if len(known_signals) == len(found) else None

    def _project(
        self, distance: FloatArray, speed: FloatArray, elevations: Mapping[str, FloatArray]
    ) -> LivePoints | None:
        """Return the points reached: each is linear in distance between the samples around it."""
        before = self._last
        self._last = float(distance[-1]), {t: float(z[-1]) for t, z in elevations.items()}
        if before is None:
            self._slow_m = float(distance[0])
            return None
        valid = self._valid(distance, speed)
        first = int(np.floor(before[0] / self._interval_m)) + 1
        first = first if self._next is None else max(first, self._next)
        end = int(np.floor(distance[-1] / self._interval_m)) + 1
        if not 0 < end - first <= MOST_POINTS:
            return None
        self._next = end
        points = np.arange(first, end) * self._interval_m
        way = np.append(before[0], distance)
        sample = np.minimum(np.searchsorted(distance, points), distance.size - 1)
        tracks = (
            ProfileTrack.of(t, np.interp(points, way, np.append(before[1][t], z)), valid[sample])
            for t, z in elevations.items()
        )
        return LivePoints(first, self._interval_m, tuple(tracks), State.PROVISIONAL, NAME)

    def _valid(self, distance: FloatArray, speed: FloatArray) -> BoolArray:
        """Return at which samples the vehicle has been fast for long enough."""
        is_slow = speed < SLOW_MPS
        if not is_slow.any() and self._slow_m == self._slow_m:
            return np.asarray(distance - self._slow_m >= SETTLES_M)
        slow = np.where(is_slow, distance, -np.inf)
        since = np.maximum.accumulate(np.append(self._slow_m, slow))[1:]
        self._slow_m = float(since[-1])
        valid: BoolArray = distance - since >= SETTLES_M
        return valid


@dataclass(frozen=True)
class Steps:
    """The samples ``low`` to ``high`` - 1 of a ``clock``, which come after ``begin_s``."""

    clock: UniformClock
    low: int
    high: int
    begin_s: float

    def read(self, channel: HeldChannel) -> FloatArray | None:
        """Return ``channel`` at these times, linear between its known samples; None without any."""
        if self.high <= self.low:
            return None
        if channel.clock == self.clock:
            own = channel.values.take(self.low, self.high)
            # A sum is NaN if and only if a sample is.
            if own.size == self.high - self.low and not np.isnan(own.sum()):
                return own
        times = self.clock.times(self.high - self.low, self.low)
        around_s = 2.0 * (times[-1] - self.begin_s)
        where, values = channel.between(self.begin_s - around_s, float(times[-1]))
        known = ~np.isnan(values)
        return frozen(np.interp(times, where[known], values[known])) if known.any() else None


def forward_pass_of(
    recording: Recording, tracks: tuple[str, ...], clock: UniformClock | None, interval_m: float
) -> ForwardPass | None:
    """Return the forward pass over the channels of ``recording``; None if it lacks any of them."""
    found = {}
    for track in tracks:
        force, height = recording.find(FORCE, track), recording.find(HEIGHT, track)
        if force is None or height is None:
            return None
        found[track] = force.id, height.id
    if clock is None:
        return None
    distance = recording.channel(DISTANCE, recording.tracks[0])
    return ForwardPass(found, distance.id, clock, interval_m)
