"""A drive: speed over time in stretches of constant jerk, in closed form.

Within a segment of start acceleration a and jerk j the acceleration is a + j·t, the speed
v + a·t + j·t²/2 and the distance x + v·t + a·t²/2 + j·t³/6, so that no error accumulates.
"""

from dataclasses import dataclass
from functools import cached_property
from typing import Protocol

import numpy as np

from floatref.errors import InputError
from floatref.values.arrays import FloatArray

STANDSTILL_MPS = 1e-9
"""A speed this small at the end of a segment is the rounding of a standstill, in m/s."""


@dataclass(frozen=True)
class Segment:
    """A stretch of constant jerk.

    Attributes:
        duration_s: how long it lasts, in s.
        acceleration: longitudinal acceleration at its start, in m/s².
        jerk: rate of the acceleration, in m/s³.
    """

    duration_s: float
    acceleration: float = 0.0
    jerk: float = 0.0

    def speed_gain(self, time_s: float) -> float:
        """Return the gain of speed in m/s over the first ``time_s`` seconds."""
        return time_s * (self.acceleration + time_s * self.jerk / 2)

    def distance(self, speed: float, time_s: float) -> float:
        """Return the distance in m over the first ``time_s`` seconds, entered at ``speed``."""
        return time_s * (speed + time_s * (self.acceleration / 2 + time_s * self.jerk / 6))


@dataclass(frozen=True, eq=False)
class Motion:
    """Longitudinal motion at given times; all arrays have their shape.

    Attributes:
        distance: true distance travelled since time 0, in m.
        speed: in m/s, never negative.
        acceleration: in m/s²; where it jumps, the value after the jump.
    """

    distance: FloatArray
    speed: FloatArray
    acceleration: FloatArray


class Longitudinal(Protocol):
    """Anything that tells its longitudinal motion at given times."""

    def motion(self, times: FloatArray) -> Motion:
        """Return the motion at ``times`` in s."""
        ...


@dataclass(frozen=True)
class Drive:
    """A drive of constant-jerk segments, at distance 0 m at time 0 s.

    Before time 0 it moves at its initial speed, after its end at its final speed.

    Attributes:
        initial_speed: speed at time 0, in m/s.
        segments: what follows, in order.
    """

    initial_speed: float
    segments: tuple[Segment, ...]

    def __post_init__(self) -> None:
        """Refuse values that are not finite, negative durations, and driving backwards."""
        if not (np.isfinite(self.initial_speed) and self.initial_speed >= 0):
            raise InputError(f"initial speed is {self.initial_speed} m/s; it must not be negative")
        for number, segment in enumerate(self.segments, start=1):
            values = (segment.duration_s, segment.acceleration, segment.jerk)
            if not np.isfinite(values).all() or segment.duration_s < 0:
                raise InputError(f"segment {number} of the drive: {segment} is impossible")
        slowest = float(np.min(self.knot_speeds_mps))
        if slowest < 0:
            raise InputError(
                f"the drive goes backwards at {-3.6 * slowest:.4g} km/h; brake or coast for less "
                "long"
            )

    @cached_property
    def knot_times_s(self) -> FloatArray:
        """Start time of every segment and the end of the last one, in s."""
        return np.concatenate([[0.0], np.cumsum([s.duration_s for s in self.segments])])

    @cached_property
    def knot_speeds_mps(self) -> FloatArray:
        """Speed at every knot in m/s; a standstill is exactly 0."""
        speeds = [self.initial_speed]
        for segment in self.segments:
            speed = speeds[-1] + segment.speed_gain(segment.duration_s)
            speeds.append(0.0 if abs(speed) < STANDSTILL_MPS else speed)
        return np.array(speeds)

    @cached_property
    def knot_distances_m(self) -> FloatArray:
        """Distance at every knot, in m."""
        steps = [
            segment.distance(speed, segment.duration_s)
            for segment, speed in zip(self.segments, self.knot_speeds_mps, strict=False)
        ]
        return np.concatenate([[0.0], np.cumsum(steps)])

    @property
    def duration_s(self) -> float:
        """Time from the start to the end of the last segment, in s."""
        return float(self.knot_times_s[-1])

    @property
    def length_m(self) -> float:
        """Distance at the end of the last segment, in m."""
        return float(self.knot_distances_m[-1])

    @property
    def final_speed(self) -> float:
        """Speed at the end of the last segment, in m/s."""
        return float(self.knot_speeds_mps[-1])

    def motion(self, times: FloatArray) -> Motion:
        """Return distance, speed and acceleration at ``times`` in s, of any shape and order."""
        times = np.asarray(times, dtype=np.float64)
        row = np.searchsorted(self.knot_times_s, times, side="right")
        starts, speeds, distances, accelerations, jerks = (
            column[row] for column in self._stretches
        )
        t = times - starts
        return Motion(
            distance=distances + t * (speeds + t * (accelerations / 2 + t * jerks / 6)),
            speed=np.maximum(speeds + t * (accelerations + t * jerks / 2), 0.0),
            acceleration=accelerations + t * jerks,
        )

    @cached_property
    def _stretches(self) -> tuple[FloatArray, ...]:
        """Start time, speed, distance, acceleration, jerk: before, every segment, after."""
        still = Segment(0.0)
        held = (still, *self.segments, still)
        first = np.concatenate([[0], np.arange(self.knot_times_s.size)])
        return (
            self.knot_times_s[first],
            self.knot_speeds_mps[first],
            self.knot_distances_m[first],
            np.array([segment.acceleration for segment in held]),
            np.array([segment.jerk for segment in held]),
        )
