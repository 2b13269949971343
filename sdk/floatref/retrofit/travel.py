"""Travel speed from the encoder."""

from fractions import Fraction

import numpy as np
from numpy.typing import ArrayLike

from floatref.errors import InputError
from floatref.retrofit.alone import Alone, chunks, in_time
from floatref.stages import speed
from floatref.stages.signals import DISTANCE, TRAVEL_SPEED
from floatref.values.arrays import FloatArray
from floatref.values.plain import above_zero

WIDEST_S = 60.0
"""Longest window of a speed, in s."""
ROUNDING_M = 1e-6
"""Largest step back of a distance, in m, that counts as rounding."""


class TravelSpeed:
    """Speed from the encoder's progress over the preceding ``window_s`` (5.6, 5.7).

    Before its first sample the vehicle is assumed to be stationary, so the speed grows from zero
    within the window. One object serves all wheel paths: call it once for each chunk, and use the
    result for all paths. A chunk given twice is a distance that goes back, and is refused.
    """

    def __init__(self, rate_hz: float | Fraction, window_s: float = speed.WINDOW_S) -> None:
        """Take distances sampled at ``rate_hz``.

        Raises InputError for an unlikely rate, or a window not within 0 to `WIDEST_S`.
        """
        if above_zero("window_s", window_s) > WIDEST_S:
            raise InputError(f"window_s is {window_s}; give at most {WIDEST_S:g} s")
        stages = (speed.TravelSpeed(float(window_s)),)
        self._speed = Alone(in_time(rate_hz), (DISTANCE,), TRAVEL_SPEED, stages)
        self._furthest = -np.inf

    @property
    def bridged(self) -> int:
        """Number of missing (NaN) distances that were bridged so far."""
        return self._speed.bridged

    def of(self, distance: ArrayLike) -> FloatArray:
        """Return the speed in m/s, shape (N,).

        Args:
            distance: next samples of the travelled distance in m, shape (N,).

        Raises:
            InputError: unless the array is one-dimensional, of finite numbers and NaN; for a
                distance that goes back by more than `ROUNDING_M`.
        """
        (x,) = chunks("TravelSpeed.of", distance=distance)
        self._furthest = _furthest(self._furthest, x)
        return self._speed(x)


def _furthest(before: float, distance: FloatArray) -> float:
    reached = np.fmax.accumulate(np.concatenate(([before], distance)))
    back = reached[:-1] - distance
    wrong = back > ROUNDING_M
    if wrong.any():
        where = int(wrong.argmax())
        raise InputError(
            f"TravelSpeed.of: distance sample {where} goes back by {back[where]:.4g} m to "
            f"{distance[where]:.10g} m; give each chunk once, and its speed to all wheel paths"
        )
    return float(reached[-1])
