"""Time stamps of a constant rate, as that rate."""

import numpy as np

from floatref.errors import InputError
from floatref.values.arrays import FloatArray
from floatref.values.clock import UniformClock
from floatref.values.recording import Channel
from floatref.values.scanning import chunks, longest_step, median_step

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
    farthest = max(abs(float(times[0])), abs(float(times[-1])))
    allowed = max(JITTER * step, ROUNDING_S) + 4.0 * float(np.spacing(farthest))
    worst, off = _farthest_off(times, step)
    if off > allowed:
        raise InputError(_refusal(channel, times, worst, off, step))
    return UniformClock.of(_roundest(1.0 / step, span, allowed), float(times[0]))


def _farthest_off(times: FloatArray, step: float) -> tuple[int, float]:
    """Return which stamp is farthest off a constant ``step``, and how far, in s."""
    worst, farthest = 0, 0.0
    for first, chunk in chunks(times):
        index = np.arange(first, first + chunk.size, dtype=np.float64)
        off = np.abs(chunk - times[0] - step * index)
        if off.max() > farthest:
            worst, farthest = first + int(off.argmax()), float(off.max())
    return worst, farthest


def _roundest(rate: float, span: float, allowed: float) -> float:
    for digits in range(MOST_DIGITS):
        candidate = float(f"{rate:.{digits}e}")
        if candidate > 0 and abs(span - span * rate / candidate) <= allowed:
            return candidate
    return rate


def _refusal(channel: Channel, times: FloatArray, worst: int, off: float, step: float) -> str:
    longest, duration = longest_step(times)
    typical = median_step(times)
    if duration > 1.5 * typical:
        return (
            f"channel {channel.id}: {duration:.6g} s without a sample after time stamp "
            f"{longest}; fill gaps with NaN at the constant rate of {1 / typical:.6g} Hz"
        )
    return (
        f"channel {channel.id}: time stamp {worst} is {off:.3g} s off a "
        f"constant rate of {1 / step:.6g} Hz; record it at a constant rate"
    )
