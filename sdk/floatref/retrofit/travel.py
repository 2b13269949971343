"""Travel speed from the encoder."""

from fractions import Fraction

from numpy.typing import ArrayLike

from floatref.retrofit.alone import Alone, chunks, in_time, require_above_zero
from floatref.stages import speed
from floatref.stages.signals import DISTANCE, TRAVEL_SPEED
from floatref.values.arrays import FloatArray


class TravelSpeed:
    """Speed from the encoder's progress over the preceding ``window_s`` (5.6, 5.7).

    Before its first sample the vehicle is taken to stand, so the speed grows from zero within the
    window. One object serves all wheel paths.
    """

    def __init__(self, rate_hz: float | Fraction, window_s: float = 0.05) -> None:
        """Take distances sampled at ``rate_hz``; InputError for an unlikely rate or window."""
        require_above_zero("window_s", window_s)
        stages = (speed.TravelSpeed(window_s),)
        self._speed = Alone(in_time(rate_hz), (DISTANCE,), TRAVEL_SPEED, stages)

    @property
    def bridged(self) -> int:
        """How many missing (NaN) distances were bridged so far."""
        return self._speed.bridged

    def of(self, distance: ArrayLike) -> FloatArray:
        """Return the speed in m/s, shape (N,).

        Args:
            distance: next samples of the travelled distance in m, shape (N,).

        Raises:
            InputError: for what is no one-dimensional array of finite numbers and NaN.
        """
        (x,) = chunks("TravelSpeed.of", distance=distance)
        return self._speed(x)
