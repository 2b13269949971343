"""Properties of a recorded drive, for mutations of some drives only."""

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
"""Time step of the speed, which is measured over the second around each instant."""
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
        distance = np.maximum.accumulate(encoder.values[seen])
        at = np.arange(times[0] + 0.5, times[-1] - 0.5, STEP_S)
        speed = np.interp(at + 0.5, times, distance) - np.interp(at - 0.5, times, distance)
        acceleration = np.gradient(speed, STEP_S) / STANDARD_GRAVITY
        return cls(np.interp(at, times, distance), speed / KMH, acceleration)

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
        """Whether the vehicle is stationary when the recording begins."""
        return float(self.speed_kmh[0]) < STANDING_KMH

    @property
    def is_steady(self) -> bool:
        """Whether the speed varies by less than 3 km/h."""
        return self.fastest_kmh - self.slowest_kmh < 3.0

    @property
    def lost_kmh(self) -> float:
        """Speed at the begin of the drive less that at its end."""
        return float(self.speed_kmh[0] - self.speed_kmh[-1])

    def slow_s(self, below_kmh: float) -> float:
        """Return the longest time in s without break in which the speed is below ``below_kmh``.

        With an encoder that is silent for a second, this time is less than a second.
        """
        return _longest(self.speed_kmh < below_kmh) * STEP_S

    def gained_kmh(self, least_g: float, most_g: float, above_kmh: float) -> float:
        """Return the largest gain of speed between two accelerations, above a speed.

        Negative accelerations are decelerations; their loss of speed is returned as positive.
        """
        inside = (self.acceleration_g >= least_g) & (self.acceleration_g <= most_g)
        inside &= self.speed_kmh > above_kmh
        return _longest(inside) * STEP_S * abs(least_g + most_g) / 2 * STANDARD_GRAVITY / KMH


When = Callable[[Drive], bool]


def apply_when(when: When, after: After) -> After:
    """Return ``after`` for the drives for which ``when`` is true; others remain unchanged."""

    def mutate(profile: Profile, recording: Recording) -> Profile:
        return after(profile, recording) if when(Drive.of(recording)) else profile

    return mutate


def middle_m(drive: Drive) -> float:
    """Return the distance of the middle of ``drive``, in m."""
    return float(drive.distance_m[0] + drive.distance_m[-1]) / 2


def _longest(marked: BoolArray) -> int:
    """Return the length of the longest run of marked values."""
    edges = np.flatnonzero(np.diff(np.concatenate(([0], marked.astype(np.int8), [0]))))
    return int(np.max(edges[1::2] - edges[::2], initial=0))
