"""IMU channels that a pipeline needs: missing channels, silences and impossible samples."""

from collections.abc import Iterable, Iterator, Mapping
from typing import NamedTuple

import numpy as np

from floatref.errors import InputError
from floatref.screening.gnss_readings import Readings
from floatref.screening.plausibility import HIGHEST_FORCE
from floatref.screening.roll_and_pitch import AXES, TILT_SMOOTH_S, Axis, read_attitudes
from floatref.screening.slow_series import RATES, SWING_S, Motion, smooth
from floatref.values.arrays import FloatArray
from floatref.values.channels import ChannelId
from floatref.values.clock import UniformClock
from floatref.values.recording import Channel, Recording
from floatref.values.scanning import chunks, first_where, median_step

IMU = ("longitudinal_specific_force", "lateral_specific_force", *RATES)
HEIGHT_CHANNELS = ("gnss_height", "gnss_vertical_velocity")
ATTITUDE_CHANNELS = ("gnss_pitch", "gnss_roll")
HIGHEST_RATE = 20.0
"""No vehicle on a road turns faster than this, in rad/s, about any axis."""
LARGEST_READINGS = {
    "gnss_height": 1e4,
    "gnss_vertical_velocity": 100.0,
    **dict.fromkeys(("gnss_pitch", "gnss_roll", "gnss_latitude", "gnss_longitude"), 360.0),
}
"""Limits of an antenna's readings on a road, in m, m/s, and of angles, even in degrees."""
SILENT_S = 0.1
"""Longest silence of the IMU in s that is bridged without a warning."""
STEPS = 2.5
"""Longest step between two samples, in usual steps, that is not a silence."""


def check_present(recording: Recording, track: str, uses_gnss: bool, uses_attitude: bool) -> None:
    """Raise InputError naming all channels that the pipeline needs and that are missing."""
    needed = [*IMU]
    needed += HEIGHT_CHANNELS if uses_gnss else ()
    needed += ATTITUDE_CHANNELS if uses_attitude else ()
    missing = [name for name in needed if recording.find(name, track) is None]
    if not missing:
        return
    own = any(channel.id.track == track for channel in recording.channels)
    names = [str(ChannelId(name, track if own and "force" in name else None)) for name in missing]
    which = "channel" if len(names) == 1 else "channels"
    raise InputError(
        f"{which} {', '.join(names)}: missing, this pipeline needs them; record them, or choose a "
        "pipeline that does without"
    )


def imu_silences(channels: Iterable[Channel]) -> Iterator[str]:
    """Yield one line for each of the IMU's ``channels`` that is silent for more than `SILENT_S`.

    Raises InputError for a channel with more than half of its samples missing, or with samples
    that no sensor in a vehicle gives.
    """
    for channel in channels:
        _check_range(channel, HIGHEST_RATE if channel.id.name in RATES else HIGHEST_FORCE)
        silences = find_silences(channel)
        if silences.size:
            lengths = silences[:, 1] - silences[:, 0]
            yield (
                f"channel {channel.id}: no samples for {describe_spans(silences)}; bridged "
                "and flagged"
            )
            _check_share(channel, float(lengths.sum()))


def check_readings(recording: Recording) -> None:
    """Raise InputError for a GNSS reading that no antenna on a road gives."""
    for name, limit in LARGEST_READINGS.items():
        channel = recording.find(name)
        if channel is not None:
            _check_range(channel, limit)


def describe_spans(spans: FloatArray) -> str:
    """Return total length, number and longest of ``spans``, shape (k, 2), k > 0, in s, as text."""
    lengths = spans[:, 1] - spans[:, 0]
    longest = int(np.argmax(lengths))
    places = "1 place" if len(spans) == 1 else f"{len(spans)} places"
    return (
        f"{lengths.sum():.4g} s in {places}, at most {lengths[longest]:.4g} s from "
        f"{spans[longest, 0]:.6g} s"
    )


def find_silences(channel: Channel, longest_s: float = SILENT_S) -> FloatArray:
    """Return where ``channel`` has no sample for more than ``longest_s``, shape (k, 2), in s.

    A silence starts a usual step after the last sample; one at an end of the channel counts.
    """
    step = _usual_step(channel)
    longest = max(longest_s, (STEPS - 1) * step)
    begin, end = channel.span_s
    last, found = begin - step, [np.empty((0, 2))]
    for first, chunk in chunks(channel.values):
        times = np.append(last, _known_times(channel, chunk, first))
        found.append(_between(times, step, longest))
        last = times[-1]
    found.append(_between(np.array([last, end + step]), step, longest))
    return np.concatenate(found)


def _known_times(channel: Channel, chunk: FloatArray, first: int) -> FloatArray:
    """Return the times in s of valid samples, or of every few if all are valid."""
    if isinstance(channel.clock, UniformClock) and not np.isnan(chunk.sum()):
        every = max(1, int(SILENT_S / 2 * float(channel.clock.rate)))
        few = channel.clock.times(-(-chunk.size // every), first, every)
        return np.append(few, channel.clock.times(1, first + chunk.size - 1))
    return channel.clock.times(chunk.size, first)[~np.isnan(chunk)]


def _between(times: FloatArray, step: float, longest: float) -> FloatArray:
    at = np.flatnonzero(np.diff(times) - step > longest)
    return np.stack([times[at] + step, times[at + 1]], axis=1)


def _usual_step(channel: Channel) -> float:
    if isinstance(channel.clock, UniformClock):
        return float(1 / channel.clock.rate)
    return median_step(channel.clock.times_s)


def _check_range(channel: Channel, limit: float) -> None:
    if channel.scan.largest > limit:
        at = first_where(lambda values: np.abs(values) > limit, channel.values) or 0
        raise InputError(
            f"channel {channel.id}: sample {at} is {channel.values[at]:.4g} {channel.unit}, beyond "
            f"{limit:g} {channel.unit}; mark lost samples as NaN, and check unit and axis"
        )


def _check_share(channel: Channel, silent_s: float) -> None:
    begin, end = channel.span_s
    if silent_s > (end - begin) / 2:
        raise InputError(
            f"channel {channel.id}: no samples for {silent_s:.4g} of {end - begin:.4g} s; "
            "record it again, or choose a pipeline that does without"
        )


SMOOTH_S = 0.5
SPEEDS_UP, TURNS, SWINGS = 0.5, 2.0, 0.004
"""Motions that a working sensor shows: acceleration, and acceleration in a curve beyond any bank of
a road, in m/s², and an angle in rad."""
CONSTANT = 1e-12
"""Means of identical samples differ by rounding alone."""


class Moved(NamedTuple):
    """A sensor's row, the motion that another one shows, the smallest motion, and its name."""

    row: FloatArray
    shown: FloatArray
    enough: float
    what: str


def check_alive(recording: Recording, track: str, motion: Motion) -> None:
    """Raise InputError for a constant channel of the IMU, if others show that it should change.

    A perfect sensor on a straight, level road is constant, too, and is accepted.
    """
    for name, moved in _find_motion(recording, motion).items():
        known = moved.row[~np.isnan(moved.row)]
        if not known.size or np.ptp(known) > CONSTANT * max(1.0, abs(known[0])):
            continue
        if np.nanmax(np.abs(moved.shown), initial=0.0) > moved.enough:
            raise InputError(
                f"channel {recording.channel(name, track).id}: every sample is "
                f"{known[0] + 0.0:.4g}, but {moved.what}; connect the sensor, and mark missing "
                "samples as NaN"
            )


def _find_motion(recording: Recording, motion: Motion) -> dict[str, Moved]:
    turning = motion.speed * motion.rates[2]
    attitude_readings = read_attitudes(recording, motion)
    found = {
        "longitudinal_specific_force": Moved(
            motion.forces[0],
            smooth(motion.acceleration, SMOOTH_S),
            SPEEDS_UP,
            "the vehicle speeds up or brakes",
        ),
        "lateral_specific_force": Moved(
            motion.forces[1], smooth(turning, SMOOTH_S), TURNS, "the vehicle turns"
        ),
        "yaw_rate": Moved(
            motion.rates[2], smooth(motion.forces[1], SMOOTH_S), TURNS, "the vehicle turns"
        ),
    }
    for axis in AXES:
        shown = _swing(motion, attitude_readings, axis)
        found[axis.rate] = Moved(motion.rates[axis.row], shown, SWINGS, "the body swings")
    return found


def _swing(motion: Motion, attitude_readings: Mapping[str, Readings], axis: Axis) -> FloatArray:
    """Return the angle in rad of GNSS, else of gravity, minus its mean over some seconds."""
    if axis.angle in attitude_readings:
        angle = attitude_readings[axis.angle].on_grid()
    else:
        angle = smooth(motion.tilts[axis.row], TILT_SMOOTH_S)
    return np.asarray(angle - smooth(angle, SWING_S))
