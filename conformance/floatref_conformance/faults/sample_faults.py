"""What a faulty sensor or its electronics do to samples: pure functions of samples and times.

Each takes the samples and their times in s, both of shape (n,), and a source of random numbers, and
returns the samples of the faulty sensor, shape (n,).
"""

from collections.abc import Callable
from typing import Literal

import numpy as np

from floatref.values.arrays import FloatArray
from floatref.values.channels import STANDARD_GRAVITY

Effect = Callable[[FloatArray, FloatArray, np.random.Generator], FloatArray]
"""Returns faulty samples, of samples, their times in s and a source of random numbers."""


def scale(factor: float) -> Effect:
    """Multiply samples by ``factor``: a unit or a sign."""
    return lambda values, times, source: factor * values


def scale_about(factor: float, level: float | None = None) -> Effect:
    """Multiply the distance from ``level``, else from the median, by ``factor``."""

    def apply(values: FloatArray, times: FloatArray, source: np.random.Generator) -> FloatArray:
        middle = float(np.nanmedian(values)) if level is None else level
        return middle + factor * (values - middle)

    return apply


def add(size: float) -> Effect:
    """Add ``size`` to all samples: a bracket that was knocked, an offset."""
    return lambda values, times, source: values + size


def ramp(size: float) -> Effect:
    """Add a line from 0 to ``size``: a drift."""
    return lambda values, times, source: values + np.linspace(0.0, size, values.size)


def swell(size: float) -> Effect:
    """Add half a sine of height ``size``."""
    return lambda values, times, source: (
        values + size * np.sin(np.linspace(0.0, np.pi, values.size))
    )


def be_noise(sigma: float) -> Effect:
    """White noise about the median in place of samples: a cable that is broken."""
    return lambda values, times, source: (
        np.nanmedian(values) + sigma * source.standard_normal(values.size)
    )


def add_noise(sigma: float) -> Effect:
    """Add white noise."""
    return lambda values, times, source: values + sigma * source.standard_normal(values.size)


def add_hum(amplitude: float, hertz: float) -> Effect:
    """Add a sine: mains, an alternator, a bracket that resonates."""
    return lambda values, times, source: values + amplitude * np.sin(2 * np.pi * hertz * times)


def spikes(size: float, count: int) -> Effect:
    """Add ``size``, of either sign, to ``count`` single samples, evenly spread and then moved."""

    def apply(values: FloatArray, times: FloatArray, source: np.random.Generator) -> FloatArray:
        found, apart = np.array(values), values.size / count
        at = ((np.arange(count) + source.uniform(0.2, 0.8, count)) * apart).astype(np.int64)
        found[at] += size * source.choice([-1.0, 1.0], count)
        return found

    return apply


def hold(values: FloatArray, times: FloatArray, source: np.random.Generator) -> FloatArray:
    """Repeat the first sample: stuck."""
    return np.full(values.size, values[0])


def hold_with_dither(sigma: float) -> Effect:
    """Repeat the first sample with the converter's noise on it: stuck, but never constant."""
    return lambda values, times, source: (
        values[0] + sigma * np.round(source.standard_normal(values.size))
    )


def constant(value: float) -> Effect:
    """Give ``value`` in place of every sample."""
    return lambda values, times, source: np.full(values.size, value)


def lose(values: FloatArray, times: FloatArray, source: np.random.Generator) -> FloatArray:
    """Lose all samples."""
    return np.full(values.size, np.nan)


def lose_often(length_s: float, every_s: float, value: float | None = np.nan) -> Effect:
    """Give ``value``, or the sample before if it is None, for ``length_s`` in every ``every_s``."""

    def apply(values: FloatArray, times: FloatArray, source: np.random.Generator) -> FloatArray:
        gone = np.mod(times - times[0], every_s) >= every_s - length_s
        if value is not None:
            return np.where(gone, value, values)
        last = np.maximum.accumulate(np.where(gone, 0, np.arange(values.size)))
        return values[last]

    return apply


def lose_randomly(share: float) -> Effect:
    """Lose single samples, ``share`` of all."""
    return lambda values, times, source: np.where(
        source.uniform(size=values.size) < share, np.nan, values
    )


def clip(low: float, high: float) -> Effect:
    """Limit samples to a range: an amplifier or a converter at its ends."""
    return lambda values, times, source: np.clip(values, low, high)


def clip_force(half_g: float) -> Effect:
    """Limit an accelerometer to 1 g and ``half_g`` to either side."""
    rest, half = STANDARD_GRAVITY, half_g * STANDARD_GRAVITY
    return clip(rest - half, rest + half)


def clip_about_median(half: float) -> Effect:
    """Limit samples to ``half`` on either side of their median."""
    return lambda values, times, source: np.clip(
        values, np.nanmedian(values) - half, np.nanmedian(values) + half
    )


def quantise(step: float) -> Effect:
    """Round to multiples of ``step``."""
    return lambda values, times, source: step * np.round(values / step)


def couple(cutoff_hz: float, level: float | None = None) -> Effect:
    """Pass through a high-pass of first order, and add ``level``, else the median: AC-coupled."""
    return _filter("highpass", cutoff_hz, 1, level)


def smooth(cutoff_hz: float) -> Effect:
    """Pass through a Butterworth low-pass of second order: a filter that was left in."""
    return _filter("lowpass", cutoff_hz, 2, 0.0)


def _filter(
    kind: Literal["highpass", "lowpass"], cutoff_hz: float, order: int, level: float | None
) -> Effect:
    def apply(values: FloatArray, times: FloatArray, source: np.random.Generator) -> FloatArray:
        from scipy.signal import butter, sosfilt, sosfilt_zi

        rate = float((times.size - 1) / (times[-1] - times[0]))
        sections = butter(order, cutoff_hz, kind, output="sos", fs=rate)
        middle = float(np.nanmedian(values)) if level is None else level
        passed, _ = sosfilt(sections, values, zi=sosfilt_zi(sections) * values[0])
        return np.asarray(passed + middle)

    return apply
