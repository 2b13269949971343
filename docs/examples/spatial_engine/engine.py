"""Profile card of a survey trailer: the encoder interrupts it every 24 mm of travel.

A record is CSV, one line per interrupt: the timer in µs, an acceleration in counts of 0.1 mm/s²
(gravity removed by the sensor) and a laser range in counts of 1 µm. The profile is in mm.
"""

import sys

import numpy as np

SPACING_M = 0.024
LONGEST_M = 100.0


class Coupling:
    """AC coupling along the road: a recursive high-pass."""

    keep = 1.0 / (1.0 + 2.0 * np.pi * SPACING_M / LONGEST_M)

    def __init__(self):
        """Begin without output."""
        self.last, self.out = None, 0.0

    def pass_on(self, sample):
        """Return what passes."""
        before = sample if self.last is None else self.last
        self.out = self.keep * (self.out + sample - before)
        self.last = sample
        return self.out


class Integral:
    """Running trapezoidal integral."""

    def __init__(self):
        """Begin at zero."""
        self.total = self.last = 0.0

    def add(self, x, step):
        """Return the integral ``step`` seconds later."""
        self.total += 0.5 * step * (x + self.last)
        self.last = x
        return self.total


class Card:
    """One accelerometer, one laser, one profile."""

    def __init__(self):
        """Power up."""
        self.timer = None
        self.velocity, self.position = Integral(), Integral()
        self.on_acceleration, self.on_velocity = Coupling(), Coupling()
        self.on_range = Coupling(), Coupling()
        self.points = []

    def interrupt(self, timer, acceleration, laser):
        """Take in one sample of all sensors."""
        step = 0.0 if self.timer is None else 1e-6 * (timer - self.timer)
        self.timer = timer
        acceleration = self.on_acceleration.pass_on(0.1 * acceleration)
        velocity = self.on_velocity.pass_on(self.velocity.add(acceleration, step))
        height = self.on_range[1].pass_on(self.on_range[0].pass_on(0.001 * laser))
        self.points.append(self.position.add(velocity, step) - height)

    def profile(self):
        """Return the profile in mm."""
        return np.array(self.points)


def run(lines):
    """Return the profile in mm of a whole record."""
    card = Card()
    for line in lines:
        timer, acceleration, laser = line.split(",")
        card.interrupt(int(timer), float(acceleration), float(laser))
    return card.profile()


if __name__ == "__main__":
    np.savetxt(sys.stdout, run(sys.stdin), "%.3f")
