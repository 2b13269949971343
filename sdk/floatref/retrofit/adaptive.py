"""The high-pass filter whose cut-off follows the travel speed, before each integration."""

from collections.abc import Callable
from fractions import Fraction

from numpy.typing import ArrayLike

from floatref.retrofit.alone import Alone, chunks, in_time, over_distance
from floatref.retrofit.calls import Band, Calls, require_profile
from floatref.stages.conditioning import FromFirst
from floatref.stages.filters.schedule import AdaptiveCutOff, ScheduleCutOff, ScheduleWaveNumber
from floatref.stages.filters.varying import (
    VaryingHighPassB3,
    VaryingHighPassB3R,
    VaryingHighPassB3S1,
    VaryingHighPassB3S2,
)
from floatref.stages.protocol import Stage
from floatref.stages.signals import ACCELERATION, ELEVATION, HEIGHT, TRAVEL_SPEED, VELOCITY
from floatref.values.arrays import FloatArray
from floatref.values.block import Header


class AdaptiveHighPass:
    """Adaptive high-pass filtering (5.7) at the cut-off (5.3) of every sample's speed.

    As `HighPass`, with the speed beside every chunk: at low speed the cut-off is a frequency, at
    high speed a wavelength. The filter removes content below the cut-off; at low speed that is
    content of the roughness too.

    Attributes:
        schedule: the cut-off that it follows.
    """

    def __init__(
        self,
        rate_hz: float | Fraction,
        low_speed_cutoff_hz: float = 0.45,
        cutoff_wavelength_m: float = 105.91,
        transition_speed_mps: float = 2.778,
        transition_steepness: float = 2.5,
    ) -> None:
        """Filter signals sampled at ``rate_hz`` at f_ls, λ_c, v_0 and α (in s/m) of (5.3).

        Raises InputError for an unlikely rate, or unless the others are above zero.
        """
        self.schedule = AdaptiveCutOff(
            low_speed_cutoff_hz, cutoff_wavelength_m, transition_speed_mps, transition_steepness
        )
        self._calls = Calls(type(self).__name__)
        axis = in_time(rate_hz)
        self._band = Band(self.schedule, axis.step)
        self._acceleration = self._forward(axis, ACCELERATION, VaryingHighPassB3S1)
        self._velocity = self._forward(axis, VELOCITY, VaryingHighPassB3S2)
        self._height = self._forward(axis, HEIGHT, FromFirst, VaryingHighPassB3)
        self._reverse = backward(axis, ScheduleCutOff(self.schedule), VaryingHighPassB3R)

    @property
    def bridged(self) -> int:
        """How many samples were bridged so far, of the signals and the profile, or their speed."""
        all_of = self._acceleration, self._velocity, self._height, self._reverse
        return sum(each.bridged for each in all_of)

    def acceleration(self, a: ArrayLike, speed: ArrayLike) -> FloatArray:
        """Return HPF_B3S1 of the acceleration with 1 g removed, before the first integration.

        Args:
            a: next samples in m/s², shape (N,).
            speed: travel speed there in m/s, shape (N,).

        Raises:
            InputError: for arrays of other shapes or infinite samples; for a speed whose cut-off is
                not below half the rate.
            StageError: after the end of the run.
        """
        call = "AdaptiveHighPass.acceleration"
        x, v_x = chunks(call, a=a, speed=speed)
        self._band.require(call, v_x)
        self._calls.add("acceleration", x.size, v_x)
        return self._acceleration(x, v_x)

    def velocity(self, v: ArrayLike, speed: ArrayLike) -> FloatArray:
        """Return HPF_B3S2 of the integrated acceleration, before the second integration.

        Args:
            v: next samples in m/s, shape (N,).
            speed: travel speed there in m/s, shape (N,).

        Raises:
            InputError: for arrays of other shapes or infinite samples; for a speed whose cut-off is
                not below half the rate.
            StageError: beyond the samples of the acceleration so far; after the end of the run.
        """
        call = "AdaptiveHighPass.velocity"
        x, v_x = chunks(call, v=v, speed=speed)
        self._band.require(call, v_x)
        self._calls.add("velocity", x.size, v_x)
        return self._velocity(x, v_x)

    def height(self, h: ArrayLike, speed: ArrayLike) -> FloatArray:
        """Return HPF_B3 of the height, counted from its first sample, to be subtracted.

        Args:
            h: next samples in m, shape (N,).
            speed: travel speed there in m/s, shape (N,).

        Raises:
            InputError: for arrays of other shapes or infinite samples; for a speed whose cut-off is
                not below half the rate.
            StageError: after the end of the run.
        """
        call = "AdaptiveHighPass.height"
        x, v_x = chunks(call, h=h, speed=speed)
        self._band.require(call, v_x)
        self._calls.add("height", x.size, v_x)
        return self._height(x, v_x)

    def reverse(self, profile: ArrayLike, speed: ArrayLike) -> FloatArray:
        """Return the backward pass in time over the whole run's elevation, HPF_B3S2R, HPF_B3S1R.

        Args:
            profile: the second integral minus the filtered height in m, shape (N,).
            speed: the speed of all forward calls in m/s, shape (N,).

        Raises:
            InputError: for arrays of other shapes or infinite samples; a profile of NaN only; for a
                speed whose cut-off is not below half the rate.
            StageError: unless N samples of all three signals have passed, at this speed; the
                second time.
        """
        call = "AdaptiveHighPass.reverse"
        z, v_x = chunks(call, profile=profile, speed=speed)
        require_profile(call, z)
        self._band.require(call, v_x)
        self._calls.end_in_time(z.size, v_x)
        return self._reverse(z, v_x)

    def reverse_over_distance(
        self, profile: ArrayLike, speed: ArrayLike, interval_m: float
    ) -> FloatArray:
        """Return the backward pass over distance, after the decimation (fig. 5.12).

        The cut-off wavelength of a point is that of its speed, at least four intervals.

        Args:
            profile: elevation every ``interval_m`` in m, shape (K,).
            speed: speed stored with each point in m/s, shape (K,).
            interval_m: distance between points in m.

        Raises:
            InputError: for arrays of other shapes or infinite samples; a profile of NaN only; an
                interval not above zero; a speed without a cut-off.
            StageError: unless all three signals have equally many samples; the second time.
        """
        call = "AdaptiveHighPass.reverse_over_distance"
        z, v_x = chunks(call, profile=profile, speed=speed)
        require_profile(call, z)
        scheduled = ScheduleWaveNumber(self.schedule)
        back = backward(over_distance(interval_m), scheduled, VaryingHighPassB3R)
        self._band.require_over_distance(call, v_x, interval_m)
        self._calls.end("reverse_over_distance")
        self._reverse = back
        return back(z, v_x)

    def finish(self) -> None:
        """End a run without a backward pass; StageError unless all three signals are complete."""
        self._calls.end("finish")

    def _forward(self, axis: Header, signal: str, *kinds: Callable[[str], Stage]) -> Alone:
        stages = ScheduleCutOff(self.schedule), *(kind(signal) for kind in kinds)
        return Alone(axis, (signal, TRAVEL_SPEED), signal, stages)


def backward(axis: Header, scheduled: Stage, *kinds: Callable[[str], Stage]) -> Alone:
    """Return the backward pass over elevation and speed, at the cut-off of the stage ``scheduled``.

    Its stages are of ``kinds``, first to last.
    """
    stages = scheduled, *(kind(ELEVATION) for kind in kinds)
    return Alone(axis, (ELEVATION, TRAVEL_SPEED), ELEVATION, stages)
