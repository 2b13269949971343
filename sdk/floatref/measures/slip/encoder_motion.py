"""Speed and acceleration by the encoder at even times, smoothed without delay."""

from typing import NamedTuple

import numpy as np

from floatref.values.arrays import FloatArray
from floatref.values.channels import STANDARD_GRAVITY
from floatref.values.clock import UniformClock
from floatref.values.recording import Channel
from floatref.values.scanning import every

STEP_S = 0.05
"""Interval of the series, in s."""
SMOOTHED_S = 0.15
"""Standard deviation of the Gaussian behind speed and acceleration, in s."""
REACH = 4.0
LEAST_SAMPLES, MOST_SAMPLES = 40, 1 << 24


class Motion(NamedTuple):
    """How the vehicle moves by its encoder, every `STEP_S`; empty for less than 2 s, or 10 days.

    Attributes:
        times_s: shape (n,).
        distance_m: shape (n,).
        speed: in m/s, shape (n,).
        acceleration: in m/s², shape (n,).
    """

    times_s: FloatArray
    distance_m: FloatArray
    speed: FloatArray
    acceleration: FloatArray

    @classmethod
    def of(cls, distance: Channel) -> "Motion":
        """Return the motion by a channel of distance; missing samples are bridged."""
        stride = max(1, int(STEP_S * distance.mean_rate_hz / 4))
        values = np.asarray(every(stride, distance.values))
        times = _times(distance, stride, values.size)
        known = ~np.isnan(values)
        if known.sum() < 2 or np.ptp(times[known]) > MOST_SAMPLES * STEP_S:
            return cls(*np.empty((4, 0)))
        even = np.arange(times[known][0], times[known][-1], STEP_S)
        if even.size < LEAST_SAMPLES:
            return cls(*np.empty((4, 0)))
        places = np.interp(even, times[known], values[known])
        slope, bend = derivatives(places)
        return cls(even, places, slope, bend)

    def less(self, too_much: FloatArray) -> "Motion":
        """Return the motion at distances that are less by ``too_much``, shape (n,), in m."""
        if not self.times_s.size:
            return self
        places = self.distance_m - too_much
        return Motion(self.times_s, places, *derivatives(places))

    def gain_m(self) -> FloatArray:
        """Return what a wheel that slips by 1 per g has counted too much, (v² - v₀²)/2g, in m."""
        if not self.speed.size:
            return self.speed
        gained = self.speed**2 - self.speed[0] ** 2
        return np.asarray(gained / (2.0 * STANDARD_GRAVITY))


def _times(channel: Channel, stride: int, count: int) -> FloatArray:
    """Return the times of every ``stride``-th sample: those of an hour would be half a GB."""
    if isinstance(channel.clock, UniformClock):
        return channel.clock.times(count, step=stride)
    return np.asarray(every(stride, channel.times_s))


def derivatives(values: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return first and second derivative of ``values``, a line beyond both ends, per s and s²."""
    half = round(REACH * SMOOTHED_S / STEP_S)
    place = np.arange(-half, half + 1) * STEP_S
    bell = np.exp(-0.5 * (place / SMOOTHED_S) ** 2)
    first = bell * place / (bell @ place**2)
    second = bell * (place**2 - (bell @ place**2) / bell.sum())
    second *= 2.0 / (second @ place**2)
    ends = np.arange(1, half + 1)
    before = values[0] - ends[::-1] * (values[half] - values[0]) / half
    after = values[-1] + ends * (values[-1] - values[-1 - half]) / half
    wide = np.concatenate((before, values, after))
    slope, bend = (np.convolve(wide, weights[::-1], "valid") for weights in (first, second))
    return np.asarray(slope), np.asarray(bend)
