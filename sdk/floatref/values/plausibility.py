"""Whether a recording can be what it says: units, signs, gaps and spans of its channels."""

from collections.abc import Iterator

import numpy as np

from floatref.errors import InputError
from floatref.values.arrays import FloatArray
from floatref.values.channels import STANDARD_GRAVITY, ChannelId
from floatref.values.clock import UniformClock
from floatref.values.recording import Channel, Recording
from floatref.values.scanning import Summary, chunks, longest_gap

GRAVITY_TOLERANCE = 2.0
"""How far the mean of a vertical accelerometer may be from g, in m/s²: bias and tilt."""
LONGEST_RANGE_M = 10.0
"""No height sensor of a profiler looks farther than this, in m."""
FASTEST_MPS = 90.0
"""No profiler is faster, in m/s."""
SLOWEST_MPS = 0.1
"""A mean speed below this over more than ten seconds is worth a warning, in m/s."""
TRUNCATION_S = 0.5
"""How much earlier than the others a channel may end, in s."""
LOWEST_ACCELEROMETER_HZ = 20.0
MOST_POINTS = 1e9

MISREADINGS = (
    (1.0, 0.2, "looks like g, multiply by 9.80665"),
    (0.0, 0.5, "1 g has been removed, add 9.80665 m/s^2"),
    (-1.0, 0.2, "looks like g with the sign inverted, multiply by -9.80665"),
    (-STANDARD_GRAVITY, GRAVITY_TOLERANCE, "the sign is inverted, multiply by -1"),
    (32.174, 3.0, "looks like ft/s^2, multiply by 0.3048"),
    (980.665, 100.0, "looks like cm/s^2 or mg, multiply by 0.01 or 0.00980665"),
    (9806.65, 1000.0, "looks like mm/s^2, multiply by 0.001"),
)
"""Mean of a vertical accelerometer, how near it has to be, and what that means."""


def examine(recording: Recording) -> tuple[str, ...]:
    """Return warnings about ``recording``, one line each, for what can be processed all the same.

    Every wheel path that has a height needs an accelerometer and the distance. Raises
    InputError with one line naming the channel, the value and what to do for missing channels,
    channels without samples or with more than half of them missing, implausible units and
    signs, a distance that goes backwards, jumps or stands still, and truncated channels.
    """
    with np.errstate(over="ignore", invalid="ignore"):
        warnings = [
            warning
            for channel in _needed(recording)
            for warning in _examined(channel, recording.setup.profile_interval_m)
        ]
    _check_spans(recording)
    return (*warnings, *_unused_setup(recording))


def profiled_tracks(recording: Recording) -> tuple[str, ...]:
    """Return the wheel paths that have a height, in order; InputError if there is none."""
    tracks = tuple(t for t in recording.tracks if recording.find("height", t) is not None)
    if not tracks:
        recording.channel("height")
    return tracks


def _needed(recording: Recording) -> tuple[Channel, ...]:
    names = ("vertical_specific_force", "height", "distance")
    found = [recording.channel(name, t) for t in profiled_tracks(recording) for name in names]
    return tuple({channel.id: channel for channel in found}.values())


def _examined(channel: Channel, interval_m: float) -> Iterator[str]:
    summary = Summary.of(channel.values)
    yield from _missing(channel, summary)
    if channel.id.name == "vertical_specific_force":
        _check_accelerometer(channel, summary)
    elif channel.id.name == "height":
        _check_height(channel, summary)
    else:
        yield from _check_distance(channel, summary, interval_m)


def _missing(channel: Channel, summary: Summary) -> Iterator[str]:
    if not summary.missing:
        return
    share = 100 * summary.missing / summary.count
    if summary.missing > summary.count / 2:
        raise InputError(
            f"channel {channel.id}: {summary.missing} of {summary.count} samples are missing "
            f"({share:.3g} %); record it again, or leave the track out"
        )
    first, length = longest_gap(channel.values)
    begin, end = (float(channel.clock.times(1, i)[0]) for i in (first, first + length - 1))
    yield (
        f"channel {channel.id}: {summary.missing} of {summary.count} samples missing "
        f"({share:.3g} %), most in a row {length} from {begin:.6g} s to {end:.6g} s; "
        "bridged and flagged"
    )


def _check_accelerometer(channel: Channel, summary: Summary) -> None:
    rate = _mean_rate(channel)
    if rate < LOWEST_ACCELEROMETER_HZ:
        raise InputError(
            f"channel {channel.id}: {rate:.6g} samples per second are too few for an "
            "accelerometer; give rate_hz in Hz, not kHz"
        )
    if abs(summary.mean - STANDARD_GRAVITY) <= GRAVITY_TOLERANCE:
        return
    for mean, tolerance, meaning in MISREADINGS:
        if abs(summary.mean - mean) <= tolerance:
            raise _implausible_force(channel, summary, meaning)
    raise _implausible_force(channel, summary, "check unit, axis and offset")


def _implausible_force(channel: Channel, summary: Summary, meaning: str) -> InputError:
    return InputError(
        f"channel {channel.id}: mean is {summary.mean:.4g}, expected about 9.8 m/s^2; {meaning}"
    )


def _check_height(channel: Channel, summary: Summary) -> None:
    if summary.least == summary.greatest == 0:
        raise InputError(
            f"channel {channel.id}: every sample is 0; connect the height sensor, "
            "and mark missing samples as NaN"
        )
    median = _median(channel.values)
    if median > LONGEST_RANGE_M:
        raise InputError(
            f"channel {channel.id}: median is {median:.4g}, expected a range below "
            f"{LONGEST_RANGE_M:g} m; if it is in mm, multiply by 0.001"
        )
    if median < 0:
        raise InputError(
            f"channel {channel.id}: median is {median:.4g}, expected a positive range in m; "
            "multiply by -1, or add the stand-off"
        )


def _check_distance(channel: Channel, summary: Summary, interval_m: float) -> Iterator[str]:
    _check_direction(channel)
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
    _check_speed(channel)
    begin, end = channel.span_s
    if end - begin > 10 and length < SLOWEST_MPS * (end - begin):
        yield (
            f"channel {channel.id}: {length:.4g} m in {end - begin:.4g} s; "
            "if the distance is in km, multiply by 1000"
        )


def _check_direction(channel: Channel) -> None:
    """Refuse a distance that decreases from one sample to the next that is there."""
    last = -np.inf
    for first, chunk in chunks(channel.values):
        valid = np.flatnonzero(~np.isnan(chunk))
        steps = np.diff(chunk[valid], prepend=last)
        if (steps < 0).any():
            at = int(np.argmax(steps < 0))
            raise InputError(
                f"channel {channel.id}: sample {first + valid[at]} goes back by {-steps[at]:.4g} m "
                f"to {chunk[valid[at]]:.10g} m; invert the sign of a reversed encoder, "
                "or cut the run where the vehicle rolled back"
            )
        last = float(chunk[valid[-1]]) if valid.size else last


def _check_speed(channel: Channel) -> None:
    """Refuse a distance that is faster than any profiler, averaged over half a second."""
    stride = round(min(max(1, TRUNCATION_S * _mean_rate(channel)), channel.values.size))
    distance = channel.values[::stride]
    times = channel.clock.times(distance.size, step=stride)
    valid = ~np.isnan(distance)
    advance, elapsed = np.diff(distance[valid]), np.diff(times[valid])
    speed = advance / np.maximum(elapsed, TRUNCATION_S)
    if (speed > FASTEST_MPS).any():
        at = int(np.argmax(speed))
        raise InputError(
            f"channel {channel.id}: {advance[at]:.4g} m in {elapsed[at]:.3g} s from "
            f"{times[valid][at]:.6g} s is {speed[at]:.4g} m/s, faster than any profiler; "
            "if the distance is in mm, multiply by 0.001, else cut the jump out"
        )


def _check_spans(recording: Recording) -> None:
    """Refuse channels of the vehicle that start late or end early; GNSS has outages."""
    vehicle = [c for c in recording.channels if not c.id.name.startswith("gnss_")]
    spans = {c.id: c.span_s for c in vehicle}
    latest = max(spans, key=lambda channel: spans[channel][1])
    earliest = min(spans, key=lambda channel: spans[channel][0])
    for channel, (begin, end) in spans.items():
        if end < spans[latest][1] - TRUNCATION_S:
            raise _truncated(channel, f"ends at {end:.6g} s", latest, f"{spans[latest][1]:.6g} s")
        if begin > spans[earliest][0] + TRUNCATION_S:
            first = f"{spans[earliest][0]:.6g} s"
            raise _truncated(channel, f"starts at {begin:.6g} s", earliest, first)


def _truncated(channel: ChannelId, what: str, other: ChannelId, when: str) -> InputError:
    return InputError(
        f"channel {channel}: {what}, but {other} at {when}; the file is truncated or its rate_hz "
        "or start_s is wrong, so copy it again or correct them"
    )


def _unused_setup(recording: Recording) -> Iterator[str]:
    for name in recording.setup.tracks:
        if name not in recording.tracks:
            here = ", ".join(recording.tracks)
            yield f"setup.tracks.{name}: only {here} have channels; its offsets are not used"


def _mean_rate(channel: Channel) -> float:
    if isinstance(channel.clock, UniformClock):
        return float(channel.clock.rate)
    begin, end = channel.span_s
    return (channel.values.size - 1) / (end - begin) if end > begin else np.inf


def _median(values: FloatArray) -> float:
    """Return the median of at most 65536 valid samples, evenly spread where possible."""
    few = values[:: max(1, values.size >> 16)]
    if np.isnan(few).all():
        few = values
    return float(np.nanmedian(few))
