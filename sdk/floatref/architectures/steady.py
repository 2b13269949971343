"""Time stamps of a constant rate, as that rate."""

import numpy as np

from floatref.errors import InputError
from floatref.values.arrays import FloatArray
from floatref.values.clock import UniformClock
from floatref.values.recording import Channel

JITTER = 0.01
"""Largest deviation of time stamps from a constant rate, in steps."""
ROUNDING_S = 2e-6
"""Stamps may be rounded to microseconds, however fast the samples come."""
MOST_DIGITS = 12
"""A rate is looked for with up to so many digits."""


def steady_clock(channel: Channel) -> UniformClock:
    """Return the channel's clock; time stamps of a constant rate become the roundest such rate.

    Raises InputError if there is none: an integration needs a constant step.
    """
    if isinstance(channel.clock, UniformClock):
        return channel.clock
    times = channel.clock.times_s
    span = float(times[-1] - times[0])
    if not span > 0:
        raise InputError(f"channel {channel.id}: one sample is no stretch of time")
    step = span / (times.size - 1)
    allowed = max(JITTER * step, ROUNDING_S) + 4.0 * float(np.spacing(np.abs(times).max()))
    off = _deviation(times, step)
    if off.max() > allowed:
        raise InputError(_refusal(channel, times, int(off.argmax()), step))
    return UniformClock.of(_roundest(1.0 / step, span, allowed), float(times[0]))


def _deviation(times: FloatArray, step: float) -> FloatArray:
    off: FloatArray = np.abs(times - times[0] - step * np.arange(times.size, dtype=np.float64))
    return off


def _roundest(rate: float, span: float, allowed: float) -> float:
    for digits in range(MOST_DIGITS):
        candidate = float(f"{rate:.{digits}e}")
        if candidate > 0 and abs(span - span * rate / candidate) <= allowed:
            return candidate
    return rate


def _refusal(channel: Channel, times: FloatArray, worst: int, step: float) -> str:
    steps = np.diff(times)
    longest, typical = int(steps.argmax()), float(np.median(steps))
    if steps[longest] > 1.5 * typical:
        return (
            f"channel {channel.id}: {steps[longest]:.6g} s without a sample after time stamp "
            f"{longest}; fill gaps with NaN at the constant rate of {1 / typical:.6g} Hz"
        )
    return (
        f"channel {channel.id}: time stamp {worst} is {_deviation(times, step)[worst]:.3g} s off a "
        f"constant rate of {1 / step:.6g} Hz; record it at a constant rate"
    )
