"""Whether a distance can be that of a profiler: range, direction, length, speed and counts."""

from collections.abc import Iterator

import numpy as np

from floatref.errors import InputError
from floatref.values.arrays import FloatArray
from floatref.values.encoder_direction import MOST, check_direction, forward_chunks
from floatref.values.profile import FARTHEST_M
from floatref.values.recording import Channel
from floatref.values.scanning import Summary, chunks, every, first_where

FASTEST_MPS = 90.0
"""No profiler is faster, in m/s."""
SLOWEST_MPS = 0.1
"""A mean speed below this over more than ten seconds is worth a warning, in m/s."""
AVERAGED_S = 0.5
"""Speed is averaged over this time, in s: counts come in bursts."""
MOST_POINTS = 1e9
FINEST_STEP = 1e-3
"""Largest rounding error of float64, as a part of the profile interval."""


def check_distance(channel: Channel, summary: Summary, interval_m: float) -> Iterator[str]:
    """Yield warnings about the distance ``channel``, one line each.

    Raises InputError with one line naming the channel, the value and what to do for a distance
    beyond what float64 holds at ``interval_m``, that `check_direction` refuses, that is too short
    or too long for ``interval_m``, or that is faster than any profiler.
    """
    _check_range(channel, summary, interval_m)
    # What nothing repairs must not go back at all.
    check_direction(channel, MOST if channel.id.name == "distance" else 0.0)
    _check_length(channel, summary, interval_m)
    _check_speed(channel)
    length = summary.greatest - summary.least
    begin, end = channel.span_s
    if end - begin > 10 and length < SLOWEST_MPS * (end - begin):
        yield (
            f"channel {channel.id}: {length:.4g} m in {end - begin:.4g} s; "
            "if the distance is in km, multiply by 1000"
        )
    count = _held_count(channel.values)
    if count > interval_m:
        yield (
            f"channel {channel.id}: held between counts of {count:.4g} m, more than the profile "
            f"interval of {interval_m:g} m; deliver only the counts, with a time_file, "
            "so that it is linear between them"
        )


def _check_range(channel: Channel, summary: Summary, interval_m: float) -> None:
    """Refuse a distance so far from its origin that float64 does not hold the interval."""
    farthest = max(summary.greatest, -summary.least)
    if farthest > FARTHEST_M:
        at = first_where(lambda values: np.abs(values) > FARTHEST_M, channel.values) or 0
        raise InputError(
            f"channel {channel.id}: sample {at} is {channel.values[at]:.10g} m, beyond "
            f"{FARTHEST_M:g} m; subtract an origin, such as the first sample"
        )
    step = float(np.spacing(farthest))
    if step > FINEST_STEP * interval_m:
        raise InputError(
            f"channel {channel.id}: {farthest:.10g} m is rounded to {step:.2g} m in float64, too "
            f"coarse for an interval of {interval_m:g} m; subtract an origin, "
            "such as the first sample"
        )


def _check_length(channel: Channel, summary: Summary, interval_m: float) -> None:
    """Refuse a distance that gives no point of the profile, or more points than fit in memory."""
    length = summary.greatest - summary.least
    if length < interval_m:
        moved = f"never leaves {summary.least:.6g} m" if length == 0 else f"moves {length:.3g} m"
        raise InputError(
            f"channel {channel.id}: {moved}, less than the profile interval of {interval_m:g} m; "
            "check the encoder, and whether the distance is in m"
        )
    if length > MOST_POINTS * interval_m:
        raise InputError(
            f"channel {channel.id}: {length:.4g} m at an interval of {interval_m:g} m are too many "
            "points; choose a longer setup.profile_interval_m"
        )


def _check_speed(channel: Channel) -> None:
    """Refuse a distance that is faster than any profiler, averaged over half a second."""
    stride = round(min(max(1, AVERAGED_S * channel.mean_rate_hz), channel.values.size))
    distance = every(stride, channel.values)
    times = channel.clock.times(distance.size, step=stride)
    advance, elapsed, since_s = _speeds(times, distance)
    if (advance > FASTEST_MPS * np.maximum(elapsed, AVERAGED_S)).any():
        pieces = [x[-first % stride :: stride] for first, x in forward_chunks(channel.values)]
        advance, elapsed, since_s = _speeds(times, np.concatenate(pieces))
    speed = advance / np.maximum(elapsed, AVERAGED_S)
    if (speed > FASTEST_MPS).any():
        at = int(np.argmax(speed))
        raise InputError(
            f"channel {channel.id}: {advance[at]:.4g} m in {elapsed[at]:.3g} s from "
            f"{since_s[at]:.6g} s is {speed[at]:.4g} m/s, faster than any profiler; "
            "if the distance is in mm, multiply by 0.001, else cut the jump out"
        )


def _speeds(times: FloatArray, distance: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return distance, duration and start time of every step between known samples, in m and s."""
    known = ~np.isnan(distance)
    return np.diff(distance[known]), np.diff(times[known]), times[known][:-1]


def _held_count(values: FloatArray) -> float:
    """Return the mean step in m of a distance that is constant between its steps, else 0.

    It counts as such if most steps follow a pair of equal samples.
    """
    moved, held, length = 0, 0, 0.0
    for _, chunk in chunks(values, overlap=2):
        steps = np.diff(chunk)
        moving = steps[1:] > 0
        length += float(np.sum(steps[1:], where=moving))
        moved += int(np.count_nonzero(moving))
        held += int(np.count_nonzero(moving & (steps[:-1] == 0)))
    return length / moved if 2 * held > moved else 0.0
