"""Whether a distance can be that of a profiler: range, direction, length, speed and counts."""

from collections.abc import Iterable, Iterator

import numpy as np

from floatref.errors import InputError
from floatref.values.arrays import FloatArray
from floatref.values.encoder.direction import MOST, check_direction, forward_chunks
from floatref.values.profile import FARTHEST_M
from floatref.values.recording import Channel
from floatref.values.scan import Summary
from floatref.values.scanning import chunks, every, first_where

DISTANCES = ("distance", "wheel_distance", "optical_distance")
FASTEST_MPS = 90.0
"""No profiler is faster, in m/s."""
SLOWEST_MPS = 0.1
"""A distance that is never faster is suspected to be in km, in m/s.

The fastest profiler, its distance in km, reaches `FASTEST_MPS` / 1000 = 0.09 m/s; people who walk
with a profiler are faster.
"""
STEP_S, SUSTAINED, AMONG = 1.0, 3, 10
"""A speed counts that is reached in three among ten successive steps of a second or more.

A damaged encoder leaps in one of them, and a vehicle that moves does so for seconds. A recording
that is shorter than ten seconds is not suspected.
"""
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
    yield from _check_unit(channel, summary)
    count = _held_count(channel.values)
    if count > interval_m:
        yield (
            f"channel {channel.id}: held between counts of {count:.4g} m, more than the profile "
            f"interval of {interval_m:g} m; deliver only the counts, with a time_file, "
            "so that it is linear between them"
        )


def check_origins(channels: Iterable[Channel]) -> None:
    """Raise InputError for a distance among ``channels`` that is beyond `FARTHEST_M`.

    It comes before whatever squares a distance: numbers of damaged files would overflow there.
    """
    for channel in channels:
        if channel.id.name in DISTANCES:
            _check_origin(channel)


def _check_origin(channel: Channel) -> None:
    if channel.scan.largest > FARTHEST_M:
        at = first_where(lambda values: np.abs(values) > FARTHEST_M, channel.values) or 0
        raise InputError(
            f"channel {channel.id}: sample {at} is {channel.values[at]:.10g} m, beyond "
            f"{FARTHEST_M:g} m; subtract an origin, such as the first sample"
        )


def _check_range(channel: Channel, summary: Summary, interval_m: float) -> None:
    """Refuse a distance so far from its origin that float64 does not hold the interval."""
    farthest = max(summary.greatest, -summary.least)
    if farthest > FARTHEST_M:
        _check_origin(channel)
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
    stride, times, distance = _thin(channel)
    advance, elapsed, since_s = _speeds(times, distance)
    if (advance > FASTEST_MPS * np.maximum(elapsed, AVERAGED_S)).any():
        pieces = [x[-first % stride :: stride] for first, x in forward_chunks(channel)]
        advance, elapsed, since_s = _speeds(times, np.concatenate(pieces))
    speed = advance / np.maximum(elapsed, AVERAGED_S)
    if (speed > FASTEST_MPS).any():
        at = int(np.argmax(speed))
        raise InputError(
            f"channel {channel.id}: {advance[at]:.4g} m in {elapsed[at]:.3g} s from "
            f"{since_s[at]:.6g} s is {speed[at]:.4g} m/s, faster than any profiler; "
            "if the distance is in mm, multiply by 0.001, else cut the jump out"
        )


def _check_unit(channel: Channel, summary: Summary) -> Iterator[str]:
    """Yield a warning if no speed is that of a profiler, however long it is stationary."""
    begin, end = channel.span_s
    length = summary.greatest - summary.least
    if end - begin <= AMONG * STEP_S:
        return
    _, times, distance = _thin(channel)
    fastest = _sustained_speed(times, distance)
    if fastest < SLOWEST_MPS:
        yield (
            f"channel {channel.id}: {length:.4g} m in {end - begin:.4g} s, at most "
            f"{fastest:.4g} m/s; if the distance is in km, multiply by 1000"
        )


def _sustained_speed(times: FloatArray, distance: FloatArray) -> float:
    """Return the fastest speed in m/s that `SUSTAINED` `AMONG` successive steps reach."""
    times, distance = times[~np.isnan(distance)], distance[~np.isnan(distance)]
    kept = np.diff(np.floor((times - times[0]) / STEP_S), prepend=-1.0) > 0
    speed = np.diff(distance[kept]) / np.maximum(np.diff(times[kept]), AVERAGED_S)
    if not speed.size:
        return 0.0
    among = np.lib.stride_tricks.sliding_window_view(speed, min(AMONG, speed.size))
    reached = min(SUSTAINED, among.shape[1])
    return float(np.partition(among, -reached, axis=1)[:, -reached].max())


def _thin(channel: Channel) -> tuple[int, FloatArray, FloatArray]:
    """Return the stride of samples about `AVERAGED_S` apart, their times in s, and distance."""
    stride = round(min(max(1, AVERAGED_S * channel.mean_rate_hz), channel.values.size))
    distance = every(stride, channel.values)
    return stride, channel.clock.times(distance.size, step=stride), distance


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
