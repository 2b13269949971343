"""The phases a drive is made of, each a few constant-jerk segments.

A driver builds the brake force up over a moment and lifts the foot off at once; at standstill
the deceleration ends at once too, whatever the foot does. Throttle comes and goes gently.

Who has to stop at a mark brakes lightly at first and hardest at the end, and sets off with
more than is left at speed. Figure 5.16 of Karamihas 2021 shows how much: of the stop with an
average of 0.2 g the stretch below 3.576 m/s begins 2.0 m before the stop and ends 2.5 m behind
it, which takes 0.33 g and 0.26 g. The drives here reach 0.28 g and 0.25 g: decision 0009.
"""

from collections.abc import Sequence

import numpy as np
from scipy.optimize import brentq

from floatref.errors import InputError
from floatref.values.channels import STANDARD_GRAVITY
from floatref_conformance.proving_ground.drives.drive import STANDSTILL_MPS, Drive, Segment

BRAKE_JERK = 0.5 * STANDARD_GRAVITY
"""Rate at which a driver builds the deceleration up, in m/s³, unless the brake is too short."""
THROTTLE_JERK = 0.2 * STANDARD_GRAVITY
"""Rate at which the acceleration comes and goes with the throttle, in m/s³."""
LIGHT_SHARE = 0.4
"""Deceleration at the start of a brake to standstill as a share of that at its end."""
LAUNCH_JERK = 0.5 * STANDARD_GRAVITY
"""Rate at which the acceleration comes when setting off, in m/s³."""
ONSET_SHARE = 0.25
"""Longest onset of a brake as a share of the brake's duration."""
STOP_BAND_MPS = (1.5 / 3.6, 0.5 / 3.6)
"""A stop's average deceleration is taken from this far below cruise to this speed (5.2)."""


def extent(speed: float, segments: Sequence[Segment]) -> tuple[float, float]:
    """Return the distance in m and the final speed in m/s of segments entered at ``speed``."""
    drive = Drive(speed, tuple(segments))
    return drive.length_m, drive.final_speed


def cruise(speed: float, distance_m: float, what: str) -> Segment:
    """Return a stretch of constant speed over ``distance_m``.

    InputError naming ``what`` if the distance is negative or the vehicle stands.
    """
    if distance_m < 0:
        raise InputError(f"{what} lies {-distance_m:.1f} m too early; move it farther along")
    if speed <= 0:
        raise InputError(f"{what} cannot be reached at {_kmh(speed)}; drive on faster than that")
    return Segment(distance_m / speed)


def speed_change(
    from_speed: float, to_speed: float, acceleration: float, jerk: float = THROTTLE_JERK
) -> tuple[Segment, ...]:
    """Return the segments from one speed to another, acceleration coming and going by jerk.

    Args:
        from_speed: in m/s.
        to_speed: in m/s, above or below.
        acceleration: largest magnitude in m/s²; a small change of speed does not reach it.
        jerk: magnitude in m/s³.
    """
    if not (acceleration > 0 and jerk > 0):
        raise InputError(f"acceleration {acceleration} m/s² and jerk {jerk} m/s³ must be positive")
    change = abs(to_speed - from_speed)
    sign = 1.0 if to_speed > from_speed else -1.0
    peak = min(acceleration, float(np.sqrt(change * jerk)))
    ramp_s = peak / jerk
    held = Segment(change / peak - ramp_s, sign * peak) if change > 0 else Segment(0.0)
    return (
        Segment(ramp_s, 0.0, sign * jerk),
        Segment(max(held.duration_s, 0.0), held.acceleration),
        Segment(ramp_s, sign * peak, -sign * jerk),
    )


def brake(from_speed: float, to_speed: float, mean_deceleration: float) -> tuple[Segment, ...]:
    """Return onset and hold of a brake of the given mean from application to release.

    Speeds in m/s, deceleration in m/s² and positive. The onset is by `BRAKE_JERK`, but takes
    at most `ONSET_SHARE` of the time; the release is abrupt.
    """
    _check_brake(from_speed, to_speed, mean_deceleration)
    change = from_speed - to_speed
    duration_s = change / mean_deceleration
    onset_s = ONSET_SHARE * duration_s
    if change / (duration_s - onset_s / 2) / onset_s > BRAKE_JERK:
        return _onset_and_hold(change, change / (duration_s - onset_s / 2), onset_s)
    held = BRAKE_JERK * (duration_s - np.sqrt(duration_s**2 - 2 * change / BRAKE_JERK))
    return _onset_and_hold(change, float(held), float(held) / BRAKE_JERK)


def set_off(from_speed: float, to_speed: float, acceleration: float) -> tuple[Segment, ...]:
    """Return the segments from a standstill or a crawl up to a speed.

    Speeds in m/s, acceleration in m/s². It comes by `LAUNCH_JERK` and then falls steadily to
    zero, as the engine's power lets it; a small change of speed does not reach it. InputError
    for a lower speed, or an acceleration that is not positive.
    """
    change = to_speed - from_speed
    if not acceleration > 0:
        raise InputError(f"setting off at {acceleration:.4g} m/s² gets nowhere; give more than 0")
    if not change >= 0:
        raise InputError(
            f"cannot set off from {_kmh(from_speed)} to {_kmh(to_speed)}; raise the final speed"
        )
    if change == 0:
        return ()
    peak = min(acceleration, float(np.sqrt(change * LAUNCH_JERK)))
    rise_s = peak / LAUNCH_JERK
    fall_s = 2 * change / peak - rise_s
    return Segment(rise_s, 0.0, LAUNCH_JERK), Segment(fall_s, peak, -peak / fall_s)


def brake_to_stop(from_speed: float, mean_deceleration: float) -> tuple[Segment, ...]:
    """Return onset and growth of a brake to standstill, where the deceleration ends at once.

    After the onset, by `BRAKE_JERK`, the deceleration grows steadily from `LIGHT_SHARE` of its
    last value. The mean holds between `STOP_BAND_MPS` below ``from_speed`` and the band's lower
    speed, as the paper's 70.5 and 0.5 km/h from 72 km/h. Speed in m/s, deceleration in m/s²,
    positive.
    """
    _check_brake(from_speed, 0.0, mean_deceleration)
    upper, lower = from_speed - STOP_BAND_MPS[0], STOP_BAND_MPS[1]
    if upper - lower <= STANDSTILL_MPS:
        raise InputError(
            f"{_kmh(from_speed)} is too slow for a stop, whose average deceleration counts from "
            f"{_kmh(STOP_BAND_MPS[0])} less down to {_kmh(lower)}; drive faster than "
            f"{_kmh(STOP_BAND_MPS[0] + lower)}"
        )

    def excess(last: float) -> float:
        segments = _stopping(from_speed, last)
        elapsed = _time_to(from_speed, segments, lower) - _time_to(from_speed, segments, upper)
        return (upper - lower) / elapsed - mean_deceleration

    return _stopping(from_speed, brentq(excess, mean_deceleration / 2, 8 * mean_deceleration))


def _stopping(from_speed: float, last: float) -> tuple[Segment, ...]:
    first = LIGHT_SHARE * last
    onset_s = min(first / BRAKE_JERK, ONSET_SHARE * from_speed / last)
    growth_s = (from_speed - first * onset_s / 2) / ((first + last) / 2)
    jerk = (last - first) / growth_s
    return Segment(onset_s, 0.0, -first / onset_s), Segment(growth_s, -first, -jerk)


def _onset_and_hold(change: float, held: float, onset_s: float) -> tuple[Segment, ...]:
    hold_s = change / held - onset_s / 2
    return Segment(onset_s, 0.0, -held / onset_s), Segment(hold_s, -held)


def _time_to(from_speed: float, segments: tuple[Segment, ...], speed: float) -> float:
    """Return when onset and growth have slowed the vehicle to ``speed``, in s."""
    onset, growth = segments
    in_onset = onset.speed_gain(onset.duration_s)
    gain = speed - from_speed
    if gain >= in_onset:
        return _time_of(onset, gain)
    return onset.duration_s + _time_of(growth, gain - in_onset)


def _time_of(segment: Segment, gain: float) -> float:
    """Return the first time in a slowing segment at which the speed has changed by ``gain``."""
    start = segment.acceleration
    return float(2 * gain / (start - np.sqrt(start**2 + 2 * segment.jerk * gain)))


def _check_brake(from_speed: float, to_speed: float, mean_deceleration: float) -> None:
    if not (mean_deceleration > 0 and np.isfinite(mean_deceleration)):
        raise InputError(
            f"mean deceleration is {mean_deceleration:.4g} m/s²; it must be above zero"
        )
    if not 0 <= to_speed < from_speed:
        raise InputError(
            f"cannot brake from {_kmh(from_speed)} to {_kmh(to_speed)}; give a lower speed to "
            "brake to, or a higher one before"
        )


def _kmh(speed: float) -> str:
    return f"{3.6 * speed:.4g} km/h"
