"""Units held against the data: what no vehicle does is in another unit, or has another meaning."""

from collections.abc import Mapping
from math import pi
from typing import NamedTuple

from floatref.errors import InputError
from floatref.values.recording import Channel
from floatref.values.scanning import Summary, every

SAMPLED = 1 << 16
"""Samples of a channel that are looked at for its usual size."""


class Limit(NamedTuple):
    """No sample is beyond ``most``, nor is the median size beyond ``usual``; what may explain it.

    ``other`` is a unit in which it would be, and how many of it one SI unit is.
    """

    most: float
    usual: float
    other: str
    per_unit: float


DEGREE = 180 / pi
ANGLE = Limit(pi / 2, 0.5, "deg", DEGREE)
RATE = Limit(50.0, 1.0, "deg/s", DEGREE)
FORCE = Limit(1e4, 5.0, "mg", 1000 / 9.80665)
LIMITS: Mapping[str, Limit] = {
    "gnss_latitude": Limit(pi / 2 + 1e-9, pi / 2, "deg", DEGREE),
    "gnss_longitude": Limit(2 * pi + 1e-9, 2 * pi, "deg", DEGREE),
    "gnss_height": Limit(1e5, 9500.0, "mm", 1000.0),
    "gnss_vertical_velocity": Limit(100.0, 5.0, "km/h", 3.6),
    "gnss_pitch": ANGLE,
    "gnss_roll": ANGLE,
    "gnss_quality": Limit(9.0, 9.0, "another table of qualities", 1.0),
    "roll_rate": RATE,
    "pitch_rate": RATE,
    "yaw_rate": RATE,
    "longitudinal_specific_force": FORCE,
    "lateral_specific_force": FORCE,
}
"""Those of channels that the processing does not look at itself."""


def check_limits(channel: Channel) -> None:
    """Raise InputError if samples of ``channel`` cannot be in its unit."""
    limit = LIMITS.get(channel.id.name)
    if limit is None:
        return
    summary = Summary.of(channel.values)
    size = max(summary.greatest, -summary.least)
    if size > limit.most:
        raise InputError(_said("a sample", size, channel.unit, limit))
    few = abs(every(max(1, channel.values.size // SAMPLED), channel.values))
    few = few[few == few]
    if few.size:
        few.sort()
        usual = float(few[few.size // 2])
        if usual > limit.usual:
            raise InputError(_said("the median size", usual, channel.unit, limit))


def _said(what: str, size: float, unit: str, limit: Limit) -> str:
    said = "" if unit == "1" else f" {unit}"
    line = f"{what} is {size:.4g}{said}, which no vehicle reaches"
    if limit.per_unit == 1:
        return f"{line}; it is from {limit.other}, so map one that is in NMEA's"
    return f"{line}; if the file has {limit.other}, state unit = {limit.other!r}, or correct it"
