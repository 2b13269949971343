"""Whether GNSS is on the recording's time base: its span, and the time of the body's swing."""

from collections.abc import Iterator
from dataclasses import replace
from itertools import pairwise

import numpy as np

from floatref.errors import InputError
from floatref.screening.explanations import RIGHT, Look, report_fault, weigh
from floatref.screening.gnss_readings import Readings
from floatref.screening.slow_series import STEP_S, Motion, integrate, means, smooth
from floatref.values.arrays import FloatArray
from floatref.values.clock import StampedClock, UniformClock
from floatref.values.recording import Channel, Recording

SLOW_S = 2.0
"""Span in s of the means, taken twice, that are removed; swings of the body are faster."""
FARTHEST_S = 30.0
"""Largest delay in s that is searched: leap seconds are 18 s."""
CLEAR, ALONE = 5.0, 8.0
"""Peak of the right delay in standard deviations of all others; the second if only one channel
shows it."""
FEWEST, APART_S = 200, 0.25
"""Fewest readings of a channel for that, and their largest distance in s: swings last 0.5 s."""
TOGETHER_S = 0.05
"""Largest difference in s of two channels that agree."""
MOST = 0.75
"""Largest delay that is searched, as a part of the run."""
LATE_S, WRONG_S = 0.06, 0.5
"""Delays in s from which a warning is given, and from which the recording is refused."""


def check_epoch(recording: Recording, begin_s: float, end_s: float) -> Iterator[str]:
    """Yield a warning if GNSS covers less than half of the run from ``begin_s`` to ``end_s``.

    Raises InputError if it does not overlap the run: its time stamps have another epoch.
    """
    channel = recording.channel("gnss_height")
    first, last = channel.span_s
    run = f"the run lasts from {begin_s:.9g} s to {end_s:.9g} s"
    covered = min(last, end_s) - max(first, begin_s)
    if covered < 0:
        raise InputError(
            f"channel {channel.id}: time stamps from {first:.9g} s to {last:.9g} s, but {run}; "
            "they are of another epoch or in another unit, so give them in s on the time base of "
            f"the other channels (a shift of {begin_s - first:.9g} s makes both start together)"
        )
    if covered < (end_s - begin_s) / 2:
        yield (
            f"channel {channel.id}: time stamps from {first:.9g} s to {last:.9g} s, but {run}; "
            f"only {covered:.4g} s of it are covered, so check the epoch and the file's length"
        )


def report_delay(delay_s: float) -> Iterator[str]:
    """Yield a warning if GNSS is late (or early, below 0) for the IMU by ``delay_s``.

    Raises InputError from `WRONG_S` on: the time stamps are of another time base.
    """
    if abs(delay_s) < LATE_S:
        return
    late = "late" if delay_s > 0 else "early"
    line = (
        f"channel gnss_height: GNSS sees the body swing {abs(delay_s):.2f} s too {late} for the "
        f"IMU; add {-delay_s:.2f} s to its time stamps"
    )
    if abs(delay_s) >= WRONG_S:
        raise InputError(f"{line} (UTC and GPS time differ by leap seconds)")
    yield line


def correct_delay(recording: Recording, delay_s: float) -> Recording:
    """Return the recording, with the GNSS channels ``delay_s`` earlier if that gives a warning."""
    if abs(delay_s) < LATE_S:
        return recording
    channels = (
        _shift_clock(c, delay_s) if c.id.name.startswith("gnss_") else c for c in recording.channels
    )
    return replace(recording, channels=tuple(channels))


def _shift_clock(channel: Channel, by_s: float) -> Channel:
    clock = channel.clock
    if isinstance(clock, StampedClock):
        return replace(channel, clock=StampedClock.of(clock.times_s - by_s))
    return replace(channel, clock=UniformClock(clock.rate, clock.start_s - by_s))


HEAVE = Look(span_s=2.5, floor=0.01)


def check_velocity(recording: Recording, motion: Motion) -> Iterator[str]:
    """Yield a warning if the antenna seems to fall where the body rises.

    Raises InputError where that is certain.
    """
    readings = Readings.of(recording.channel("gnss_vertical_velocity"), motion)
    rising = readings.beside(integrate(motion.lift))
    explained = {RIGHT: rising, "sign": -rising, **readings.delay(integrate(motion.lift))}
    evidence = weigh(readings.times, readings.values, explained, HEAVE)
    yield from report_fault(
        evidence,
        {
            "sign": "channel gnss_vertical_velocity: the sign is inverted against "
            "vertical_specific_force; multiply by -1 (up is positive)"
        },
    )


def delay(recording: Recording, motion: Motion) -> float:
    """Return the delay in s of the body's swing in GNSS against the IMU; 0 if not measurable.

    Two channels must agree on it, or one must be clear by itself.
    """
    own = {
        "gnss_vertical_velocity": integrate(motion.lift),
        "gnss_roll": motion.swing[0],
        "gnss_pitch": motion.swing[1],
    }
    found = []
    for name, row in own.items():
        channel = recording.find(name)
        measured = np.empty(0) if channel is None else means(channel, motion.grid)
        if _is_dense(measured):
            found.append(_peak(_correlation(row, measured)))
    clear = sorted((d, c) for d, c in found if c >= CLEAR)
    close = [(a, b) for (a, _), (b, _) in pairwise(clear) if b - a <= TOGETHER_S]
    if close:
        return min((b - a, (a + b) / 2) for a, b in close)[1]
    return clear[0][0] if len(clear) == 1 and clear[0][1] >= ALONE else 0.0


def _is_dense(measured: FloatArray) -> bool:
    """Return whether the readings are dense and many enough to measure the time of a swing."""
    known = np.flatnonzero(~np.isnan(measured))
    return known.size >= FEWEST and float(np.median(np.diff(known))) * STEP_S <= APART_S


def _peak(correlation: FloatArray) -> tuple[float, float]:
    """Return the delay of the peak in s, and its height in standard deviations of the others."""
    peak = int(np.argmax(correlation))
    beside = np.abs(np.arange(correlation.size) - peak) > SLOW_S / STEP_S
    spread = float(np.std(correlation[beside])) if beside.any() else 0.0
    if peak in (0, correlation.size - 1) or not spread > 0:
        return 0.0, 0.0
    before, at, after = correlation[peak - 1 : peak + 2].tolist()
    delay = peak - correlation.size // 2 + (before - after) / (2 * (before - 2 * at + after))
    return delay * STEP_S, at / spread


def _correlation(own: FloatArray, measured: FloatArray) -> FloatArray:
    """Return the correlation of two rows by the delay of the second, up to `FARTHEST_S`."""
    x, y = (np.nan_to_num(row - smooth(row, SLOW_S)) for row in (own, measured))
    reach = min(int(FARTHEST_S / STEP_S), int(MOST * x.size))
    size = 1 << (2 * x.size - 1).bit_length()
    product = np.fft.irfft(np.conj(np.fft.rfft(x, size)) * np.fft.rfft(y, size), size)
    return np.concatenate([product[-reach:], product[: reach + 1]])
