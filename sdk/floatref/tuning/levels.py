"""The values that are tried: half an octave apart, as for the sensitivity (section 6.4.4)."""

from collections.abc import Mapping
from dataclasses import dataclass
from math import ceil, log2

TUNED = ("acceleration_density", "acceleration_walk", "pitch_rate_walk", "roll_rate_walk")
"""The four settings that are tuned, of the eleven standard deviations of Table 6.1."""
FIXED = (
    *("gnss_height_sigma_m", "gnss_velocity_sigma_mps"),
    *("gnss_pitch_sigma_rad", "gnss_roll_sigma_rad"),
    *("roll_rate_density", "pitch_rate_density", "yaw_rate_density"),
)
"""The others, which are known from data sheets and sensors at rest."""
UNITS = {
    "acceleration_density": "m/s²/√Hz",
    "acceleration_walk": "m/s²/√s",
    "pitch_rate_walk": "rad/s/√s",
    "roll_rate_walk": "rad/s/√s",
    "gnss_height_sigma_m": "m",
    "gnss_velocity_sigma_mps": "m/s",
    "gnss_pitch_sigma_rad": "rad",
    "gnss_roll_sigma_rad": "rad",
    "roll_rate_density": "rad/s/√Hz",
    "pitch_rate_density": "rad/s/√Hz",
    "yaw_rate_density": "rad/s/√Hz",
}
PER_OCTAVE = 2
REACH = 6 * PER_OCTAVE
"""Steps up and down from where the search begins, and from the pipeline's own value."""
FARTHEST = 20 * PER_OCTAVE
"""Most steps from the start of the search, for any distance to the pipeline's own value."""
DENSITY_DOWN = 2 * PER_OCTAVE
"""Steps down for white noise: it is at least that of sensors at rest, unless that is wrong."""
DIGITS = 4
"""Digits of a value in a settings file."""

Point = tuple[int, int, int, int]
"""Steps of the `TUNED` settings from where the search begins, which is all zeros."""
START: Point = (0, 0, 0, 0)


@dataclass(frozen=True)
class Levels:
    """The values of the `TUNED` settings.

    Attributes:
        start: where the search begins.
        lowest, highest: steps of half an octave that it may go from there.
    """

    start: tuple[float, ...]
    lowest: Point
    highest: Point

    @classmethod
    def of(cls, start: Mapping[str, float], usual: Mapping[str, float]) -> "Levels":
        """Return the levels around ``start``, with those around the ``usual`` values in reach."""
        away = [PER_OCTAVE * log2(usual[name] / start[name]) for name in TUNED]
        down = (DENSITY_DOWN, REACH, REACH, REACH)
        lowest = [
            -min(n + max(0, ceil(-steps)), FARTHEST) for n, steps in zip(down, away, strict=True)
        ]
        highest = [min(REACH + max(0, ceil(steps)), FARTHEST) for steps in away]
        return cls(tuple(start[name] for name in TUNED), _point(lowest), _point(highest))

    def settings(self, point: Point) -> dict[str, float]:
        """Return the values at ``point``, those of the start as they are."""
        return {
            name: round_value(value * 2.0 ** (step / PER_OCTAVE)) if step else value
            for name, value, step in zip(TUNED, self.start, point, strict=True)
        }


def move(point: Point, which: int, step: int) -> Point:
    """Return ``point`` with setting number ``which`` at ``step``."""
    return _point([*point[:which], step, *point[which + 1 :]])


def round_value(value: float) -> float:
    """Return ``value`` as a settings file holds it."""
    return float(f"{value:.{DIGITS}g}")


def _point(steps: list[int]) -> Point:
    a, b, c, d = steps
    return a, b, c, d
