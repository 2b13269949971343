"""Stationary tests: a parked vehicle whose encoder is made to tell a constant speed (4.5.1).

The body's motion is a closed form with its derivatives, so that accelerometer and range are
exact: with the floor flat, a perfect profiler measures a flat profile. Up is positive.
"""

from dataclasses import dataclass

import numpy as np

from floatref.errors import InputError
from floatref.values.arrays import FloatArray
from floatref_conformance.proving_ground.drives.drive import Drive, Segment
from floatref_conformance.proving_ground.roads.shaping import cosine_rise

ENGINE_HZ = 820 / 60
"""Frequency of an engine idling at 820 rpm: a wave of 1.46 m at a simulated 72 km/h."""
DURATION_S = 32.0
SIMULATED_SPEED = 20.0
"""72 km/h in m/s."""


@dataclass(frozen=True, eq=False)
class BodyDisplacement:
    """Motion of the parked body; all arrays have the shape of the times asked for.

    Attributes:
        height: of the body's origin above its place at rest, in m.
        velocity: of the height, in m/s.
        acceleration: of the height, in m/s².
        pitch: nose down, in rad.
        pitch_rate: in rad/s.
        pitch_acceleration: in rad/s².
        roll: left side up, in rad.
        roll_rate: in rad/s.
        roll_acceleration: in rad/s².
    """

    height: FloatArray
    velocity: FloatArray
    acceleration: FloatArray
    pitch: FloatArray
    pitch_rate: FloatArray
    pitch_acceleration: FloatArray
    roll: FloatArray
    roll_rate: FloatArray
    roll_acceleration: FloatArray


@dataclass(frozen=True)
class Bounce:
    """A body pushed up and down: envelope times (offset − amplitude·sin 2πf(t − start)).

    The defaults are the bounce of figure 4.7: −56 and +30 mm near 2 Hz during the middle two
    thirds of 6.5 s. The envelope rises and falls as 10u³ − 15u⁴ + 6u⁵ over the outer sixths,
    so that height, velocity and acceleration are continuous.

    Attributes:
        start_s: when it starts, in s.
        duration_s: from the first to the last motion, in s.
        lowest_m: height at the bottom, in m.
        highest_m: height at the top, in m.
        frequency_hz: in Hz.
        pitch_per_m: pitch that goes with the height, in rad per m.
        roll_per_m: roll that goes with the height, in rad per m.
    """

    start_s: float = 10.0
    duration_s: float = 6.5
    lowest_m: float = -0.056
    highest_m: float = 0.030
    frequency_hz: float = 2.0
    pitch_per_m: float = 0.1
    roll_per_m: float = 0.05

    def __post_init__(self) -> None:
        """Refuse a bounce without duration, frequency or extent."""
        if not (self.duration_s > 0 and self.frequency_hz > 0 and self.lowest_m < self.highest_m):
            raise InputError(f"{self}: duration, frequency and travel must be above zero")

    def heights(self, times: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Return height in m and its two derivatives at ``times`` in s."""
        e, e1, e2 = self._envelope(times)
        omega = 2 * np.pi * self.frequency_hz
        angle = omega * (times - self.start_s)
        offset = (self.highest_m + self.lowest_m) / 2
        amplitude = (self.highest_m - self.lowest_m) / 2
        w = offset - amplitude * np.sin(angle)
        w1 = -amplitude * omega * np.cos(angle)
        w2 = amplitude * omega**2 * np.sin(angle)
        return e * w, e1 * w + e * w1, e2 * w + 2 * e1 * w1 + e * w2

    def _envelope(self, times: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        ramp_s = self.duration_s / 6
        since, left = times - self.start_s, self.start_s + self.duration_s - times
        u = np.clip(np.minimum(since, left) / ramp_s, 0.0, 1.0)
        side = np.where(since <= left, 1.0, -1.0)
        value = u**3 * (10 - 15 * u + 6 * u**2)
        slope = 30 * u**2 * (1 - u) ** 2 * side / ramp_s
        bend = 60 * u * (1 - u) * (1 - 2 * u) / ramp_s**2
        return value, slope, bend


@dataclass(frozen=True)
class Stationary:
    """A parked vehicle with its engine on, with a bounce or without.

    Attributes:
        bounce: the induced motion; None for a quiescent test.
        engine_m: amplitude of the body's shake, in m. 10 µm are 0.0075 g at idle.
        engine_hz: frequency of the shake, in Hz.
    """

    bounce: Bounce | None = None
    engine_m: float = 10e-6
    engine_hz: float = ENGINE_HZ

    def body(self, times: FloatArray) -> BodyDisplacement:
        """Return the body's motion at ``times`` in s, of any shape."""
        times = np.asarray(times, dtype=np.float64)
        still = np.zeros_like(times)
        bounced = (still, still, still) if self.bounce is None else self.bounce.heights(times)
        pitch_per_m = 0.0 if self.bounce is None else self.bounce.pitch_per_m
        roll_per_m = 0.0 if self.bounce is None else self.bounce.roll_per_m
        heights = [b + s for b, s in zip(bounced, self._shake(times), strict=True)]
        return BodyDisplacement(
            *heights,
            *(pitch_per_m * b for b in bounced),
            *(roll_per_m * b for b in bounced),
        )

    def _shake(self, times: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        omega = 2 * np.pi * self.engine_hz
        sine, cosine = np.sin(omega * times), np.cos(omega * times)
        return (
            self.engine_m * sine,
            self.engine_m * omega * cosine,
            -self.engine_m * omega**2 * sine,
        )


@dataclass(frozen=True)
class Plate:
    """A plate that lies under the laser over a stretch of the simulated distance.

    Attributes:
        start_m: simulated distance of its first edge, in m.
        length_m: between the outer ends of its edges, in m.
        height_m: its thickness, in m.
        edge_m: length of each half-cosine edge, in m; 0 for a rectangular plate.
    """

    start_m: float
    length_m: float
    height_m: float = 0.005
    edge_m: float = 0.02

    def __post_init__(self) -> None:
        """Refuse a plate without length and edges longer than the plate."""
        if not (self.length_m > 0 and 0 <= 2 * self.edge_m <= self.length_m):
            raise InputError(f"{self}: the edges must fit into a length above zero")

    def elevation(self, distance: FloatArray) -> FloatArray:
        """Return the elevation under the laser in m at simulated distances in m."""
        inside = self.length_m / 2 - np.abs(distance - self.start_m - self.length_m / 2)
        if self.edge_m == 0:
            return np.where(inside >= 0, self.height_m, 0.0)
        return self.height_m * cosine_rise(np.clip(inside, 0.0, self.edge_m) / self.edge_m)


def artificial_drive(speed: float = SIMULATED_SPEED, duration_s: float = DURATION_S) -> Drive:
    """Return what the artificial encoder tells: constant ``speed`` in m/s for ``duration_s``."""
    return Drive(speed, (Segment(duration_s),))
