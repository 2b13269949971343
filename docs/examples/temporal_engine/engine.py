"""Profile computer of a survey van: one wheel path, everything in time.

A record holds 4000 samples a second, each an acceleration in g (1 at rest), a laser range in mm
and the wheel pulses since the start. The profile has a point every 80 pulses (24 mm), in mm.
"""

import sys

import numpy as np

SAMPLE = np.dtype([("accel_g", "<f8"), ("range_mm", "<f8"), ("pulses", "<i4")])
RATE_HZ = 4000
CHUNK = 200
PULSE_MM = 0.3
PULSES_PER_POINT = 80
CORNER_HZ = 0.01


class Integral:
    """Running trapezoidal integral."""

    def __init__(self):
        """Begin at zero."""
        self.total, self.last = 0.0, None

    def add(self, x):
        """Return the integral at each new sample."""
        steps = np.concatenate(([x[0] if self.last is None else self.last], x))
        areas = 0.5 / RATE_HZ * (steps[1:] + steps[:-1])
        areas[0] = self.total if self.last is None else self.total + areas[0]
        integral = np.cumsum(areas)
        self.total, self.last = integral[-1], x[-1]
        return integral


class Coupling:
    """AC coupling: an RC high-pass, sample by sample."""

    def __init__(self):
        """Begin without output."""
        self.last, self.out = None, 0.0

    def pass_on(self, x, corner_hz):
        """Return what passes at ``corner_hz``."""
        keep = 1.0 / (1.0 + 2.0 * np.pi * corner_hz / RATE_HZ)
        passed = []
        for sample in x.tolist():
            before = sample if self.last is None else self.last
            self.out = keep * (self.out + sample - before)
            self.last = sample
            passed.append(self.out)
        return np.array(passed)


class WheelPath:
    """One accelerometer, one laser, one profile."""

    def __init__(self):
        """Power up."""
        self.velocity, self.position = Integral(), Integral()
        self.on_acceleration, self.on_velocity = Coupling(), Coupling()
        self.on_range = Coupling(), Coupling()
        self.points = []

    def work(self, samples):
        """Take in one chunk of the record."""
        acceleration = 9806.65 * (samples["accel_g"] - 1.0)
        acceleration = self.on_acceleration.pass_on(acceleration, CORNER_HZ)
        velocity = self.on_velocity.pass_on(self.velocity.add(acceleration), CORNER_HZ)
        height = self.on_range[0].pass_on(samples["range_mm"], CORNER_HZ)
        height = self.on_range[1].pass_on(height, CORNER_HZ)
        elevation = self.position.add(velocity) - height
        for at in self.reached(samples["pulses"]):
            self.points.append(elevation[at])

    def reached(self, pulses):
        """Return the sample that reaches each new point, all its points in turn."""
        last = int(pulses[-1]) // PULSES_PER_POINT
        new = np.arange(len(self.points), last + 1) * PULSES_PER_POINT
        return np.searchsorted(pulses, new)

    def profile(self):
        """Return the profile in mm."""
        return np.array(self.points)


def run(record):
    """Return the profile in mm of a whole ``record``."""
    path = WheelPath()
    for first in range(0, record.size, CHUNK):
        path.work(record[first : first + CHUNK])
    return path.profile()


if __name__ == "__main__":
    np.savetxt(sys.stdout, run(np.fromfile(sys.argv[1], SAMPLE)), "%.3f")
