"""What a recording tells of its drive, for mistakes that are made in some drives only."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from floatref.values.arrays import BoolArray, FloatArray
from floatref.values.channels import STANDARD_GRAVITY
from floatref.values.profile import Profile
from floatref.values.recording import Recording
from floatref_conformance.mutants.mutation import After

KMH = 1 / 3.6
STEP_S = 0.1
"""Speed is known in such steps, of the distance from half a second before to half a one after."""
STANDING_KMH = 0.5


@dataclass(frozen=True, eq=False)
class Drive:
    """Speed in km/h and acceleration in g in steps of `STEP_S`; distance in m; all shape (n,)."""

    distance_m: FloatArray
    speed_kmh: FloatArray
    acceleration_g: FloatArray

    @classmethod
    def of(cls, recording: Recording) -> "Drive":
        """Return the drive of ``recording``, by its encoder."""
        encoder = recording.channel("distance")
        seen = np.isfinite(encoder.values)
        times = encoder.times_s[seen]
        told = np.maximum.accumulate(encoder.values[seen])
        at = np.arange(times[0] + 0.5, times[-1] - 0.5, STEP_S)
        speed = np.interp(at + 0.5, times, told) - np.interp(at - 0.5, times, told)
        acceleration = np.gradient(speed, STEP_S) / STANDARD_GRAVITY
        return cls(np.interp(at, times, told), speed / KMH, acceleration)

    @property
    def slowest_kmh(self) -> float:
        """The lowest speed."""
        return float(self.speed_kmh.min())

    @property
    def fastest_kmh(self) -> float:
        """The highest speed."""
        return float(self.speed_kmh.max())

    @property
    def slowest_m(self) -> float:
        """Where the vehicle is slowest, in m."""
        return float(self.distance_m[int(np.argmin(self.speed_kmh))])

    @property
    def begins_standing(self) -> bool:
        """Whether the vehicle stands when the recording begins."""
        return float(self.speed_kmh[0]) < STANDING_KMH

    @property
    def is_steady(self) -> bool:
        """Whether the speed stays within 3 km/h."""
        return self.fastest_kmh - self.slowest_kmh < 3.0

    @property
    def lost_kmh(self) -> float:
        """How much slower the drive ends than it begins."""
        return float(self.speed_kmh[0] - self.speed_kmh[-1])

    def slow_s(self, below_kmh: float) -> float:
        """Return for how long in one go the vehicle is slower than ``below_kmh``.

        An encoder that is silent for a second seems to stand for less than a second.
        """
        return _longest(self.speed_kmh < below_kmh) * STEP_S

    def gained_kmh(self, least_g: float, most_g: float, above_kmh: float) -> float:
        """Return the most speed won in one go between two accelerations and above a speed.

        Negative accelerations are decelerations, and what they lose counts alike.
        """
        inside = (self.acceleration_g >= least_g) & (self.acceleration_g <= most_g)
        inside &= self.speed_kmh > above_kmh
        return _longest(inside) * STEP_S * abs(least_g + most_g) / 2 * STANDARD_GRAVITY / KMH


When = Callable[[Drive], bool]


def apply_when(when: When, after: After) -> After:
    """Return ``after`` for drives of which ``when`` holds, nothing wrong for others."""

    def spoil(profile: Profile, recording: Recording) -> Profile:
        return after(profile, recording) if when(Drive.of(recording)) else profile

    return spoil


def middle_m(drive: Drive) -> float:
    """Return where half of ``drive`` is done, in m."""
    return float(drive.distance_m[0] + drive.distance_m[-1]) / 2


def _longest(marked: BoolArray) -> int:
    """Return how many marked values lie in one piece."""
    edges = np.flatnonzero(np.diff(np.concatenate(([0], marked.astype(np.int8), [0]))))
    return int(np.max(edges[1::2] - edges[::2], initial=0))
