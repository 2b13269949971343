"""Units checked against the data: a sample that no vehicle reaches is in another unit."""

from collections.abc import Mapping
from math import pi
from typing import NamedTuple

from floatref.errors import InputError
from floatref.values.channels import STANDARD_GRAVITY
from floatref.values.recording import Channel
from floatref.values.scanning import every

TOLERANCES: Mapping[str, float] = {
    "unsprung_specific_force": 5.0,
    "rear_unsprung_specific_force": 5.0,
    "sprung_specific_force": 2.0,
    "equipment_specific_force": 2.0,
}
"""Largest distance of the mean from g, in m/s²: a sensor for the 50 g of a wheel has more bias."""
MEANINGS = (
    (1.0, 0.5, "it looks like g, so state unit = 'g'"),
    (
        0.0,
        0.5,
        "1 g is missing, removed or never passed on by an AC-coupled sensor, so add it by "
        "offset = 9.80665, or offset = 1 where unit is 'g'",
    ),
    (-1.0, 0.5, "it looks like g, upside down, so state unit = 'g' and sign = -1"),
    (-STANDARD_GRAVITY, 5.0, "its axis points down, so state sign = -1"),
    (32.174, 5.0, "it looks like ft/s^2, so state unit = 'ft/s^2'"),
)
"""A mean that an accelerometer at rest cannot have, its tolerance in m/s², and the remedy."""


def check_gravity(channel: str, mean: float) -> None:
    """Raise InputError if ``channel`` has to be about 9.8 m/s² and its ``mean`` is not.

    The mean over a drive is that at rest, except for the change of velocity divided by the
    duration. NaN, the mean of no samples, passes.
    """
    if not abs(mean - STANDARD_GRAVITY) > TOLERANCES.get(channel, float("inf")):
        return
    likely = [remedy for level, near, remedy in MEANINGS if abs(mean - level) <= near]
    advice = likely[0] if likely else "check unit, axis and offset"
    raise InputError(f"mean is {mean:.4g}, expected about 9.8 m/s^2 of a specific force; {advice}")


SAMPLED = 1 << 16
"""Samples of a channel from which its median size is calculated."""


class Limit(NamedTuple):
    """Largest size of a sample, ``most``, and of the median, ``usual``, and the likely cause.

    ``other`` is the likely unit of the file, with its number per SI unit; ``cure`` is the remedy in
    all other cases.
    """

    most: float
    usual: float
    other: str
    per_unit: float
    cure: str = "correct it"


DEGREE = 180 / pi
AGAINST_REST = "take off its value at rest by an offset"
ANGLE = Limit(pi / 2, 0.5, "deg", DEGREE)
BODY_ANGLE = Limit(0.6, 0.2, "deg", DEGREE, AGAINST_REST)
RATE = Limit(50.0, 1.0, "deg/s", DEGREE)
ANGULAR = Limit(1e3, 10.0, "deg/s^2", DEGREE)
FORCE = Limit(1e4, 5.0, "mg", 1000 / 9.80665)
CARRIER = Limit(1e4, 500.0, "mg", 1000 / 9.80665)
DEFLECTION = Limit(0.5, 0.25, "mm", 1000.0, AGAINST_REST)
DISPLACEMENT = Limit(100.0, 5.0, "mm", 1000.0, AGAINST_REST)
VELOCITY = Limit(100.0, 5.0, "mm/s", 1000.0)
SPEED = Limit(100.0, 42.0, "km/h", 3.6)
TRAVEL = Limit(1e6, 1e6, "mm", 1000.0)
LIMITS: Mapping[str, Limit] = {
    "gnss_latitude": Limit(pi / 2 + 1e-9, pi / 2, "deg", DEGREE),
    "gnss_longitude": Limit(2 * pi + 1e-9, 2 * pi, "deg", DEGREE),
    "gnss_height": Limit(1e5, 9500.0, "mm", 1000.0),
    "gnss_vertical_velocity": Limit(100.0, 5.0, "km/h", 3.6),
    "gnss_speed": SPEED,
    "gnss_pitch": ANGLE,
    "gnss_roll": ANGLE,
    "gnss_quality": Limit(9.0, 9.0, "another table of qualities", 1.0),
    "roll_rate": RATE,
    "pitch_rate": RATE,
    "yaw_rate": RATE,
    "longitudinal_specific_force": FORCE,
    "lateral_specific_force": FORCE,
    "wheel_speed": SPEED,
    "wheel_distance": TRAVEL,
    "optical_distance": TRAVEL,
    **dict.fromkeys(TOLERANCES, CARRIER),
    "suspension_deflection": DEFLECTION,
    "rear_suspension_deflection": DEFLECTION,
    "unsprung_displacement": DISPLACEMENT,
    "rear_unsprung_displacement": DISPLACEMENT,
    "sprung_displacement": DISPLACEMENT,
    "equipment_displacement": DISPLACEMENT,
    "unsprung_velocity": VELOCITY,
    "rear_unsprung_velocity": VELOCITY,
    "sprung_velocity": VELOCITY,
    "equipment_velocity": VELOCITY,
    "pitch_angle": BODY_ANGLE,
    "roll_angle": BODY_ANGLE,
    "pitch_acceleration": ANGULAR,
    "roll_acceleration": ANGULAR,
}
"""Limits of the channels that the processing itself does not check."""


def check_limits(channel: Channel) -> None:
    """Raise InputError if samples of ``channel`` cannot be in its unit, or lack gravity."""
    limit = LIMITS.get(channel.id.name)
    if limit is None:
        return
    summary = channel.scan.summary
    size = max(summary.greatest, -summary.least)
    if size > limit.most:
        raise InputError(_describe("a sample", size, channel.unit, limit))
    few = abs(every(max(1, channel.values.size // SAMPLED), channel.values))
    few = few[few == few]
    if few.size:
        few.sort()
        usual = float(few[few.size // 2])
        if usual > limit.usual:
            raise InputError(_describe("the median size", usual, channel.unit, limit))
    check_gravity(channel.id.name, summary.mean)


def _describe(what: str, size: float, unit: str, limit: Limit) -> str:
    unit_text = "" if unit == "1" else f" {unit}"
    line = f"{what} is {size:.4g}{unit_text}, which no vehicle reaches"
    if limit.per_unit == 1:
        return f"{line}; it is from {limit.other}, so map one that is in NMEA's"
    return f"{line}; if the file has {limit.other}, state unit = {limit.other!r}, or {limit.cure}"
