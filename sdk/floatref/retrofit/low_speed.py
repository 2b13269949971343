"""Algorithms for low speed only: local suppression, timer distortion, height-sensor reflection."""

from fractions import Fraction

from numpy.typing import ArrayLike

from floatref.errors import InputError
from floatref.retrofit.alone import Alone, chunks, in_time, over_distance
from floatref.stages.signals import (
    HEIGHT,
    REFERENCE_HEIGHT,
    TIME_STEP,
    TRAVEL_SPEED,
    TRUE_TIME_STEP,
    VELOCITY,
)
from floatref.stages.suppression import SuppressLocally
from floatref.stages.timer_distortion import IntegrateReflecting, adjusted_time_step
from floatref.values.arrays import FloatArray
from floatref.values.plain import above_zero


class LocalSuppression:
    """A PI controller that holds the vertical velocity at zero below a speed (5.6).

    Use it after the first integration, alone or between the stages of `HighPass`. Every sample
    below ``below_mps`` loses content below about 0.13 Hz; there is no step at either end.
    """

    def __init__(
        self,
        rate_hz: float | Fraction,
        below_mps: float = 4.4704,
        proportional: float = 0.001,
        integral_per_s: float = 0.834,
    ) -> None:
        """Control at ``rate_hz`` with K_P ``proportional`` and K_I ``integral_per_s``.

        Raises InputError for an unlikely rate, or unless the others are above zero.
        """
        above_zero("below_mps", below_mps)
        above_zero("proportional", proportional)
        above_zero("integral_per_s", integral_per_s)
        stages = (SuppressLocally(VELOCITY, below_mps, proportional, integral_per_s),)
        self._control = Alone(in_time(rate_hz), (VELOCITY, TRAVEL_SPEED), VELOCITY, stages)

    @property
    def bridged(self) -> int:
        """Number of samples so far with missing (NaN) velocity or speed, which were bridged."""
        return self._control.bridged

    def velocity(self, v: ArrayLike, speed: ArrayLike) -> FloatArray:
        """Return the controlled velocity in m/s, shape (N,).

        Args:
            v: next samples of the integrated acceleration in m/s, shape (N,).
            speed: travel speed there in m/s, shape (N,).

        Raises:
            InputError: for arrays of other shapes or infinite samples.
        """
        x, v_x = chunks("LocalSuppression.velocity", v=v, speed=speed)
        return self._control(x, v_x)


class TimerDistortion:
    """A limit on the time step of an integration over distance (5.7, 5.8).

    Use the adjusted step in place of the measured one in both integrations. Points passed more
    slowly than about ``slow_speed_mps`` lose content in proportion to the square of the time
    taken away. It has no state: one object serves all wheel paths.

    Attributes:
        limit_s: Δt_0 of (5.7), the longest adjusted step in s.
    """

    def __init__(
        self, interval_m: float, slow_speed_mps: float = 3.576, sharpness: float = 25.0
    ) -> None:
        """Limit the steps over ``interval_m`` to that of ``slow_speed_mps``; β is ``sharpness``.

        Raises InputError unless all are above zero.
        """
        above_zero("interval_m", interval_m)
        above_zero("slow_speed_mps", slow_speed_mps)
        above_zero("sharpness", sharpness)
        self.limit_s, self._sharpness = interval_m / slow_speed_mps, sharpness

    def time_step(self, dt: ArrayLike) -> FloatArray:
        """Return the adjusted time steps in s, shape (N,).

        Args:
            dt: measured time steps (5.4) in s, shape (N,).

        Raises:
            InputError: unless the array is one-dimensional; for a step below zero or missing.
        """
        (steps,) = chunks("TimerDistortion.time_step", dt=dt)
        _require_steps("TimerDistortion.time_step: dt", steps)
        return adjusted_time_step(steps, self.limit_s, self._sharpness)


class HeightReflection:
    """The second integration over distance, completed from the height sensor (5.9).

    Where the time step was shortened, the change of the height replaces the missing part of the
    integral, and cancels when the height is subtracted: the profile is flat there.
    """

    def __init__(self) -> None:
        """Begin the integral at zero."""
        inputs = VELOCITY, TIME_STEP, TRUE_TIME_STEP, HEIGHT
        stages = (IntegrateReflecting(),)
        self._integral = Alone(over_distance(1.0), inputs, REFERENCE_HEIGHT, stages)

    @property
    def bridged(self) -> int:
        """Number of samples so far with missing (NaN) velocity or height, which were bridged."""
        return self._integral.bridged

    def reference_height(
        self,
        velocity: ArrayLike,
        adjusted_time_step: ArrayLike,
        time_step: ArrayLike,
        filtered_height: ArrayLike,
    ) -> FloatArray:
        """Return the floating reference height in m, shape (N,).

        Args:
            velocity: next samples of the vertical velocity in m/s, shape (N,).
            adjusted_time_step: the step of the integration in s, shape (N,).
            time_step: the step as it was measured in s, shape (N,).
            filtered_height: the height in m as it will be subtracted, shape (N,).

        Raises:
            InputError: for arrays of other shapes, infinite samples, or a step below zero or
                missing.
        """
        call = "HeightReflection.reference_height"
        signals = chunks(
            call,
            velocity=velocity,
            adjusted_time_step=adjusted_time_step,
            time_step=time_step,
            filtered_height=filtered_height,
        )
        _require_steps(f"{call}: adjusted_time_step", signals[1])
        _require_steps(f"{call}: time_step", signals[2])
        return self._integral(*signals)


def _require_steps(name: str, steps: FloatArray) -> None:
    wrong = ~(steps >= 0.0)
    if wrong.any():
        where = int(wrong.argmax())
        raise InputError(f"{name} sample {where} is {steps[where]:g} s; a step is zero or above")
