"""Provisional points: one forward pass, at the adaptive cut-off (5.3), as the samples come.

The floating reference height is that of `MatchedHighPass`, which no stop disturbs. A forward pass
alone shifts long waves along the road: the error of a point is as large as its waves of some 30 m
and more, so these points show that a run is good, and not how rough the road is.
"""

from collections.abc import Iterator, Mapping

import numpy as np

from floatref.errors import InputError
from floatref.live.held_samples import HeldChannel
from floatref.live.points import LivePoints, State
from floatref.retrofit import MatchedHighPass, TravelSpeed
from floatref.stages.signals import DISTANCE
from floatref.values.arrays import BoolArray, FloatArray
from floatref.values.channels import STANDARD_GRAVITY, ChannelId
from floatref.values.clock import UniformClock
from floatref.values.needs import FORCE, HEIGHT
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
        self._clock = clock
        self.begin()

    def begin(self) -> None:
        """Forget all samples, as where a distance was set back."""
        self._speed = TravelSpeed(self._clock.rate)
        self._filters = {track: MatchedHighPass(self._clock.rate) for track in self._tracks}
        self._farthest_m = -np.inf
        self._last: tuple[float, dict[str, float]] | None = None
        self._next: int | None = None
        self._slow_m = np.nan

    def advance(
        self, held: Mapping[ChannelId, HeldChannel], begin_s: float, end_s: float, offset_m: float
    ) -> LivePoints | None:
        """Return the points that the vehicle passed after ``begin_s`` and up to ``end_s``, if any.

        The axis is ``offset_m`` ahead of the encoder. A stretch with no distance or a channel
        without any sample gives no points.
        """
        force = next(iter(self._tracks.values()))[0]
        times, _ = held[force].between(begin_s, end_s)
        distance = _at(held[self._distance], times, begin_s)
        if distance is None:
            return None
        distance = np.maximum.accumulate(np.maximum(distance, self._farthest_m))
        self._farthest_m = float(distance[-1])
        try:
            speed = self._speed.of(distance)
            elevations = dict(self._elevations(held, times, begin_s, speed))
        except InputError:  # No vehicle is so fast.
            self.begin()
            return None
        if len(elevations) < len(self._tracks):
            return None
        return self._project(distance + offset_m, speed, elevations)

    def _elevations(
        self,
        held: Mapping[ChannelId, HeldChannel],
        times: FloatArray,
        begin_s: float,
        speed: FloatArray,
    ) -> Iterator[tuple[str, FloatArray]]:
        for track, (force, height) in self._tracks.items():
            a, h = (_at(held[name], times, begin_s) for name in (force, height))
            if a is not None and h is not None:
                reference = self._filters[track].reference_height(a - STANDARD_GRAVITY, h, speed)
                yield track, reference - h

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
        slow = np.where(speed < SLOW_MPS, distance, -np.inf)
        since = np.maximum.accumulate(np.append(self._slow_m, slow))[1:]
        self._slow_m = float(since[-1])
        valid: BoolArray = distance - since >= SETTLES_M
        return valid


def _at(channel: HeldChannel, times: FloatArray, begin_s: float) -> FloatArray | None:
    """Return the samples of ``channel`` at ``times``, behind ``begin_s``; None without any.

    They are linear between the known ones.
    """
    if not times.size:
        return None
    around_s = 2.0 * (times[-1] - begin_s)
    where, values = channel.between(begin_s - around_s, float(times[-1]))
    known = ~np.isnan(values)
    return np.interp(times, where[known], values[known]) if known.any() else None


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
