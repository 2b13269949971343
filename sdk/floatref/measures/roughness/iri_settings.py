"""The settings of the IRI: explicit, and printed with every value."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from floatref.errors import InputError

LONGEST_INTERVAL_M = 2.0
"""Longest interval in m: a coarser profile has lost wavelengths that move the car."""
MOST_INTERVALS = 1e12
"""Most points of a profile."""


def intervals_in(length_m: float, interval_m: float) -> int:
    """Return the whole intervals next to ``length_m``, ties to even, at least 1."""
    return max(round(min(length_m / interval_m, MOST_INTERVALS)), 1)


@dataclass(frozen=True)
class IriSettings:
    """How the IRI is calculated (Karamihas 2021, 2.1.1).

    ``moving_average_m`` is the base length of the tyre envelope in m, 0 for no envelope;
    ``start_length_m`` the length in m whose mean slope the car starts at, so that it starts at
    rest; ``speed_kmh`` the simulated speed in km/h; ``segment_m`` the length in m of the
    segments that the output is cut into, None for the whole profile as one.
    """

    moving_average_m: float = 0.25
    start_length_m: float = 11.0
    speed_kmh: float = 80.0
    segment_m: float | None = None

    def __post_init__(self) -> None:
        """Refuse lengths and speeds that are not positive, finite numbers."""
        self._check("moving_average_m", self.moving_average_m, self.moving_average_m >= 0)
        self._check("start_length_m", self.start_length_m, self.start_length_m > 0)
        self._check("speed_kmh", self.speed_kmh, self.speed_kmh > 0)
        if self.segment_m is not None:
            self._check("segment_m", self.segment_m, self.segment_m > 0)

    @staticmethod
    def _check(name: str, value: float, in_range: bool) -> None:
        """Raise InputError unless ``value`` is finite and ``in_range``."""
        if not (np.isfinite(value) and in_range):
            raise InputError(f"{name} is {value}; it must be a finite number above zero")

    def window(self, interval_m: float) -> int:
        """Return the slopes in one moving average: round(base/interval), ties to even.

        1, which is no smoothing, at intervals of the base length and above.
        """
        if interval_m > LONGEST_INTERVAL_M:
            raise InputError(
                f"interval is {interval_m:g} m; the IRI needs {LONGEST_INTERVAL_M:g} m or less"
            )
        return intervals_in(self.moving_average_m, interval_m)

    def start_count(self, interval_m: float) -> int:
        """Return the intervals in the start length."""
        return intervals_in(self.start_length_m, interval_m)

    def as_dict(self, interval_m: float) -> dict[str, Any]:
        """Return the record printed with an IRI at ``interval_m``; lengths in m."""
        window = self.window(interval_m)
        return {
            "interval_m": interval_m,
            "moving_average_m": self.moving_average_m if window > 1 else None,
            "moving_average_samples": window,
            "start": "at rest, at the mean slope of the start length",
            "start_length_m": self.start_length_m,
            "speed_kmh": self.speed_kmh,
            "segment_m": self.segment_m,
            "segments": "one pass of the car, cut afterwards; a rest below a tenth joins the last",
            "missing_elevation": "bridged by a straight line, left out at the ends",
        }
