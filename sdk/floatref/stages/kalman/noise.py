"""What the Kalman filter takes for the errors of sensors and references."""

from dataclasses import dataclass
from math import radians

import numpy as np

from floatref.values.arrays import FloatArray
from floatref.values.channels import STANDARD_GRAVITY

TABLE_RATE_HZ = 16000.0
"""Steps per second behind the process noise of Table 6.1."""
PER_STEP = TABLE_RATE_HZ**-0.5
"""From a standard deviation per step to a density, for white noise; the inverse for a walk."""


@dataclass(frozen=True)
class Noise:
    """Process noise as continuous-time densities, and the errors of a single reading.

    White noise of density S per √Hz has the standard deviation S·√f when sampled at f, a walk of
    density K per √s moves by K·√t in the time t. So no result depends on a sampling rate. The
    defaults are those of Table 6.1, read as standard deviations of a step of 1/16000 s, but for
    the walk of the acceleration and what has no place in that table.

    Attributes:
        acceleration: vertical acceleration, in m/s²/√Hz.
        acceleration_walk: its bias, in m/s²/√s.
        roll_rate, pitch_rate, yaw_rate: in rad/s/√Hz.
        roll_rate_walk, pitch_rate_walk: of their biases, in rad/s/√s.
        lean_rad: 1-σ of how far forward the axis of the vertical accelerometer leans.
        gnss_height_m, gnss_velocity_mps, gnss_pitch_rad, gnss_roll_rad: 1-σ of a reading at 20 Hz
            or less; of readings that come faster, each counts for less.
        gnss_height_walk: slow error of the GNSS height that a stop hides, in m/√s.
        constant_height, constant_velocity, constant_pitch, constant_roll: 1-σ of what stays the
            same for want of a reading, as densities in m/√Hz, m/s/√Hz and rad/√Hz.
        reflection: the height sensor as a measure of the reference point's motion at a standstill,
            in m/√Hz.
        reflection_offset_m: 1-σ of the error of the filter's own height where a stop begins.
        height_m: 1-σ of a reading of the height sensor, for the 1-σ of the result alone.
    """

    acceleration: float = 6e-4 * STANDARD_GRAVITY * PER_STEP
    acceleration_walk: float = 3e-4
    roll_rate: float = radians(7.7e-3) * PER_STEP
    pitch_rate: float = radians(7.7e-3) * PER_STEP
    yaw_rate: float = radians(7.7e-3) * PER_STEP
    roll_rate_walk: float = radians(4.2e-6) / PER_STEP
    pitch_rate_walk: float = radians(2.2e-4) / PER_STEP
    lean_rad: float = 0.01
    gnss_height_m: float = 0.012
    gnss_velocity_mps: float = 0.03
    gnss_pitch_rad: float = radians(0.12)
    gnss_roll_rad: float = radians(0.2)
    gnss_height_walk: float = 1.5e-3
    constant_height: float = 5.0 * PER_STEP
    constant_velocity: float = 10.0 * PER_STEP
    constant_pitch: float = radians(5.0) / 20**0.5
    constant_roll: float = radians(2.0) / 20**0.5
    reflection: float = 0.0015 / 3240**0.5
    reflection_offset_m: float = 0.1
    height_m: float = 4e-5

    def process(self) -> FloatArray:
        """Return the squares of the process densities, shape (7,)."""
        walks = self.acceleration_walk, self.roll_rate_walk, self.pitch_rate_walk
        rates = self.roll_rate, self.pitch_rate, self.yaw_rate
        return np.square([self.acceleration, *rates, *walks])

    def readings(self) -> FloatArray:
        """Return the variances of a GNSS reading: height, velocity, pitch, roll."""
        height = self.gnss_height_m, self.gnss_velocity_mps
        return np.square([*height, self.gnss_pitch_rad, self.gnss_roll_rad])

    def constants(self, interval_s: float) -> FloatArray:
        """Return the variances of the constants when they are observed every ``interval_s``."""
        height = self.constant_height, self.constant_velocity
        return np.square([*height, self.constant_pitch, self.constant_roll]) / interval_s
