"""What the Kalman filter takes for the errors of sensors and references."""

from dataclasses import dataclass

import numpy as np

from floatref.values.arrays import FloatArray


@dataclass(frozen=True)
class Noise:
    """Process noise as continuous-time densities, and the errors of a single reading.

    White noise of density S per √Hz has the standard deviation S·√f when sampled at f, a walk of
    density K per √s moves by K·√t in the time t. So no result depends on a sampling rate. The
    defaults of acceleration, walks and GNSS follow Table 6.1, its process noise read as standard
    deviations of a step of 1/16000 s, that of the rates of a reading at 100 Hz; but for the walk
    of the acceleration, and for what has no place in that table.

    Attributes:
        acceleration: vertical acceleration, in m/s²/√Hz.
        acceleration_walk: its bias, in m/s²/√s.
        roll_rate, pitch_rate, yaw_rate: in rad/s/√Hz.
        roll_rate_walk, pitch_rate_walk: of their biases, in rad/s/√s.
        missing_acceleration: in place of `acceleration` where that is missing for more than 10 ms.
        lean_rad: 1-σ of how far forward the axis of the vertical accelerometer leans.
        gnss_height_m, gnss_velocity_mps, gnss_pitch_rad, gnss_roll_rad: 1-σ of a reading at 20 Hz
            or less; of readings that come faster, each counts for less.
        gnss_height_walk: slow error of the GNSS height that a stop hides, in m/√s.
        constant_height, constant_velocity, constant_pitch, constant_roll: 1-σ of what stays the
            same for want of a reading, as densities in m/√Hz, m/s/√Hz and rad/√Hz.
        reflection: the height sensor as a measure of the reference point's motion at a standstill,
            in m/√Hz.
        height_m: 1-σ of a reading of the height sensor, for the 1-σ of the result alone.
    """

    acceleration: float = 4.65e-5
    acceleration_walk: float = 1e-4
    roll_rate: float = 1.34e-5
    pitch_rate: float = 1.34e-5
    yaw_rate: float = 1.34e-5
    roll_rate_walk: float = 9.27e-6
    pitch_rate_walk: float = 4.86e-4
    missing_acceleration: float = 0.3
    lean_rad: float = 0.01
    gnss_height_m: float = 0.012
    gnss_velocity_mps: float = 0.03
    gnss_pitch_rad: float = 2.09e-3
    gnss_roll_rad: float = 3.49e-3
    gnss_height_walk: float = 1.5e-3
    constant_height: float = 0.04
    constant_velocity: float = 0.08
    constant_pitch: float = 0.0195
    constant_roll: float = 0.0078
    reflection: float = 2.64e-5
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
