"""From time stamps at a constant rate to a uniform clock; samples may be missing in between."""

import numpy as np

from floatref.errors import InputError
from floatref.values.arrays import FloatArray, IndexArray
from floatref.values.clock import UniformClock
from floatref.values.recording import Channel
from floatref.values.scanning import chunks, longest_step, median_step

JITTER = 0.01
"""Largest deviation of time stamps from a constant rate, in steps."""
ROUNDING_S = 2e-6
"""Stamps may be rounded to microseconds, at any rate."""
HOLE = 1.5
"""Distance of time stamps, in usual steps, from which samples are missing in between."""
MOST_DIGITS = 12
"""Largest number of digits of a rate."""


def steady_clock(channel: Channel) -> UniformClock:
    """Return the channel's clock; for time stamps, the roundest rate that fits them.

    Holes may take up to half of the time; between them the rate must be constant. Raises InputError
    if it is not: an integration needs a constant step.
    """
    if isinstance(channel.clock, UniformClock):
        return channel.clock
    times = channel.clock.times_s
    span = float(times[-1] - times[0])
    if not span > 0:
        raise InputError(f"channel {channel.id}: a single sample has no duration")
    bounds = _bounds(times)
    held = float(np.sum(times[bounds[1:] - 1] - times[bounds[:-1]]))
    steps = times.size + 1 - bounds.size
    step = held / steps if held >= span / 2 else span / (times.size - 1)
    bounds = bounds if held >= span / 2 else np.array([0, times.size])
    farthest = max(abs(float(times[0])), abs(float(times[-1])))
    allowed = max(JITTER * step, ROUNDING_S) + 4.0 * float(np.spacing(farthest))
    worst, off = _farthest_off(times, step, bounds)
    if off > allowed:
        raise InputError(_refusal(channel, times, worst, off, step))
    longest = float(np.max(times[bounds[1:] - 1] - times[bounds[:-1]]))
    return UniformClock.of(_roundest(1.0 / step, longest, allowed), float(times[0]))


def report_holes(channel: Channel) -> tuple[str, ...]:
    """Return one line on the holes in an accelerometer's time stamps; empty if it has no holes."""
    if isinstance(channel.clock, UniformClock):
        return ()
    times = channel.clock.times_s
    behind = _bounds(times)[1:-1]
    if not behind.size:
        return ()
    lengths = times[behind] - times[behind - 1]
    begin = float(times[behind[lengths.argmax()] - 1])
    return (
        f"channel {channel.id}: no samples for {lengths.sum():.4g} s in {behind.size} places, at "
        f"most {lengths.max():.4g} s from {begin:.6g} s; flagged",
    )


def _bounds(times: FloatArray) -> IndexArray:
    """Return the first index of every stretch without a hole, and the number of stamps."""
    wide, found = HOLE * median_step(times), [np.zeros(1, np.int64)]
    for first, chunk in chunks(times, overlap=1):
        found.append(first + 1 + np.flatnonzero(np.diff(chunk) > wide))
    return np.concatenate([*found, np.array([times.size])])


def _farthest_off(times: FloatArray, step: float, bounds: IndexArray) -> tuple[int, float]:
    """Return the stamp with the largest deviation from a constant ``step``, and the deviation in s.

    Steps are counted from the last hole; ``bounds`` limit the stretches without a hole.
    """
    worst, farthest = 0, 0.0
    for first, chunk in chunks(times):
        index = np.arange(first, first + chunk.size)
        start = bounds[np.searchsorted(bounds, index, "right") - 1]
        off = np.abs(chunk - times[start] - step * (index - start))
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
