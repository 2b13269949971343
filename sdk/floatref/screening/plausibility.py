"""Whether a recording is plausible: units, signs, gaps and spans of its channels."""

from collections.abc import Callable, Iterator

import numpy as np

from floatref.errors import InputError
from floatref.screening.second_sources import SECOND_DISTANCES, check_second_sources
from floatref.values.arrays import FloatArray
from floatref.values.channels import STANDARD_GRAVITY, ChannelId
from floatref.values.encoder.plausible_distance import check_distance
from floatref.values.needs import DISTANCE, HEIGHT, VERTICAL_FORCES, Needs, nominal_needs
from floatref.values.recording import Channel, Recording
from floatref.values.scan import Summary
from floatref.values.scanning import every, first_where, longest_gap

LIMITS = {
    "deflection": (1.0, "if it is in mm, multiply by 0.001"),
    "displacement": (1.0, "if it is in mm, multiply by 0.001"),
    "velocity": (10.0, "if it is in mm/s, multiply by 0.001"),
    "angle": (1.0, "if it is in degrees, multiply by 0.0174533"),
    "rate": (10.0, "if it is in deg/s, multiply by 0.0174533"),
    "acceleration": (500.0, "if it is in deg/s^2, multiply by 0.0174533"),
}
"""By the end of a channel's name: the limit of a vehicle on a road, and the likely cause."""


def check_motion(channel: Channel, summary: Summary) -> None:
    """Refuse a channel of the response that never changes, or exceeds the limit of a vehicle.

    Raises InputError with one line naming the channel, the value and what to do.
    """
    if summary.least == summary.greatest:
        raise InputError(
            f"channel {channel.id}: every sample is {summary.least:.6g}, so it measures nothing; "
            "connect the sensor, leave the channel out, and mark missing samples as NaN"
        )
    limit, cause = LIMITS[channel.id.name.rpartition("_")[2]]
    if max(-summary.least, summary.greatest) <= limit:
        return
    typical = float(np.nanmedian(np.abs(every(max(1, channel.values.size >> 16), channel.values))))
    if typical > limit:
        raise InputError(
            f"channel {channel.id}: half of its samples are beyond {typical:.4g} {channel.unit}; "
            f"{cause}, and give it against rest"
        )
    at = first_where(lambda values: np.abs(values) > limit, channel.values) or 0
    raise InputError(
        f"channel {channel.id}: sample {at} is {channel.values[at]:.4g} {channel.unit}, beyond "
        f"{limit:g} {channel.unit}; {cause}, else mark lost samples as NaN"
    )


GRAVITY_TOLERANCE = 2.0
"""How far the mean of a vertical accelerometer may be from g, in m/s²: bias and tilt."""
HIGHEST_FORCE = 1e4
"""Limit of an accelerometer's samples in a vehicle, in m/s²."""
LONGEST_RANGE_M = 10.0
"""Longest range of a profiler's height sensor, in m."""
LARGEST_HEIGHT_M = 100.0
"""Limit of the samples of a working height sensor, in m."""
TRUNCATION_S = 0.5
"""How much earlier than the others a channel may end, in s."""
LOWEST_ACCELEROMETER_HZ = 20.0

MISREADINGS = (
    (1.0, 0.2, "looks like g, multiply by 9.80665 (map: unit = 'g')"),
    (0.0, 0.5, "1 g has been removed, add 9.80665 m/s^2 (map: offset = 9.80665, or 1 in g)"),
    (-1.0, 0.2, "looks like g with the sign inverted, multiply by -9.80665 (map: unit, sign)"),
    (-STANDARD_GRAVITY, GRAVITY_TOLERANCE, "the sign is inverted, multiply by -1 (map: sign = -1)"),
    (32.174, 3.0, "looks like ft/s^2, multiply by 0.3048 (map: unit = 'ft/s^2')"),
    (980.665, 100.0, "looks like cm/s^2 or mg, multiply by 0.01 or 0.00980665 (map: unit)"),
    (9806.65, 1000.0, "looks like mm/s^2, multiply by 0.001 (map: unit = 'mm/s^2')"),
)
"""Mean of a vertical accelerometer, its tolerance, the meaning, and the key of a channel map."""

Examine = Callable[[Channel, float], tuple[str, ...]]
"""A function that examines a channel at a profile interval in m, as `examine_channel` does."""


def examine_channel(channel: Channel, interval_m: float) -> tuple[str, ...]:
    """Return warnings about ``channel``; ``interval_m`` is that of the profile.

    Raises InputError as `examine`.
    """
    with np.errstate(over="ignore", invalid="ignore"):
        return tuple(_examine(channel, interval_m))


def examine(
    recording: Recording, needs: Needs | None = None, look: Examine = examine_channel
) -> tuple[str, ...]:
    """Return warnings about ``recording``, one line each; it can be processed despite them.

    Without ``needs``, every wheel path that has a height needs an accelerometer and the distance.
    ``look`` examines each channel. Raises InputError with one line naming the channel, the value
    and what to do for missing channels, channels without samples or with more than half of them
    missing, implausible units and signs, impossible samples, an accelerometer that is constant, a
    distance that mostly goes backwards, jumps or is constant, and truncated channels.
    """
    needed = (nominal_needs(recording) if needs is None else needs).channels(recording)
    interval_m = recording.setup.profile_interval_m
    warnings = [warning for channel in needed for warning in look(channel, interval_m)]
    _check_spans(recording)
    seconds = check_second_sources(recording, needed)
    return (*warnings, *seconds, *_unused_setup(recording))


def _examine(channel: Channel, interval_m: float) -> Iterator[str]:
    summary = channel.scan.summary
    yield from _check_missing(channel, summary)
    name = channel.id.name
    if name in VERTICAL_FORCES:
        _check_accelerometer(channel, summary)
    elif name == HEIGHT:
        _check_height(channel, summary)
    elif name in (DISTANCE, *SECOND_DISTANCES):
        yield from check_distance(channel, summary, interval_m)
    else:
        check_motion(channel, summary)


def _check_missing(channel: Channel, summary: Summary) -> Iterator[str]:
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
    rate = channel.mean_rate_hz
    if rate < LOWEST_ACCELEROMETER_HZ:
        raise InputError(
            f"channel {channel.id}: {rate:.6g} samples per second are too few for an "
            "accelerometer; give rate_hz in Hz, not kHz"
        )
    which, level = "mean", summary.mean
    if _is_wild(summary, HIGHEST_FORCE):
        # A few wild samples move the mean, not the median.
        which, level = "median", _median(channel.values)
    meaning = _meaning(level)
    if meaning is not None:
        raise InputError(
            f"channel {channel.id}: {which} is {level:.4g}, expected about 9.8 m/s^2; {meaning}"
        )
    if summary.least == summary.greatest:
        raise InputError(
            f"channel {channel.id}: every sample is {summary.least:.6g}, so it measures nothing; "
            "connect the accelerometer, and mark missing samples as NaN"
        )
    _check_samples(channel, summary, HIGHEST_FORCE)


def _meaning(level: float) -> str | None:
    """Return the meaning of an accelerometer's mean or median ``level``, None if it is right.

    A level beyond all sensors is reported by the check of samples.
    """
    if abs(level - STANDARD_GRAVITY) <= GRAVITY_TOLERANCE:
        return None
    for mean, tolerance, meaning in MISREADINGS:
        if abs(level - mean) <= tolerance:
            return meaning
    return "check unit, axis and offset" if abs(level) <= HIGHEST_FORCE else None


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
    _check_samples(channel, summary, LARGEST_HEIGHT_M)


def _is_wild(summary: Summary, limit: float) -> bool:
    return summary.least < -limit or summary.greatest > limit


def _check_samples(channel: Channel, summary: Summary, limit: float) -> None:
    """Refuse the first sample beyond ``limit``, in the channel's unit."""
    if not _is_wild(summary, limit):
        return
    at = first_where(lambda values: np.abs(values) > limit, channel.values) or 0
    raise InputError(
        f"channel {channel.id}: sample {at} is {channel.values[at]:.4g} {channel.unit}, beyond "
        f"{limit:g} {channel.unit}; mark lost samples as NaN, and check unit, axis and offset"
    )


def _check_spans(recording: Recording) -> None:
    """Refuse channels of the vehicle that start late or end early; GNSS has outages."""
    vehicle = [c for c in recording.channels if not c.id.name.startswith("gnss_")]
    spans = {c.id: c.span_s for c in vehicle}
    latest = max(spans, key=lambda channel: spans[channel][1])
    earliest = min(spans, key=lambda channel: spans[channel][0])
    for channel, (begin, end) in spans.items():
        if end < spans[latest][1] - TRUNCATION_S:
            raise _truncation_error(
                channel, f"ends at {end:.6g} s", latest, f"{spans[latest][1]:.6g} s"
            )
        if begin > spans[earliest][0] + TRUNCATION_S:
            first = f"{spans[earliest][0]:.6g} s"
            raise _truncation_error(channel, f"starts at {begin:.6g} s", earliest, first)


def _truncation_error(channel: ChannelId, what: str, other: ChannelId, when: str) -> InputError:
    return InputError(
        f"channel {channel}: {what}, but {other} at {when}; the file is truncated or its rate_hz "
        "or start_s is wrong, so copy it again or correct them"
    )


def _unused_setup(recording: Recording) -> Iterator[str]:
    for name in recording.setup.tracks:
        if name not in recording.tracks:
            here = ", ".join(recording.tracks)
            yield f"setup.tracks.{name}: only {here} have channels; its offsets are not used"


def _median(values: FloatArray) -> float:
    """Return the median of at most 65536 valid samples, evenly spread where possible."""
    few = every(max(1, values.size >> 16), values)
    if np.isnan(few).all():
        few = values
    return float(np.nanmedian(few))
