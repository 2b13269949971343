"""The exactly matched high-pass filter: an observer in place of both integrations."""

from fractions import Fraction

from numpy.typing import ArrayLike

from floatref.retrofit.adaptive import backward
from floatref.retrofit.alone import Alone, chunks, in_time, over_distance
from floatref.retrofit.calls import Band, Calls, require_profile
from floatref.stages.filters.matched_high_pass import MatchedHighPass as Observer
from floatref.stages.filters.schedule import AdaptiveCutOff, ScheduleCutOff, ScheduleWaveNumber
from floatref.stages.filters.varying import StateHighPassB3S1R, StateHighPassB3S2R
from floatref.stages.signals import ACCELERATION, HEIGHT, REFERENCE_HEIGHT, TRAVEL_SPEED
from floatref.values.arrays import FloatArray

BACKWARD = StateHighPassB3S2R, StateHighPassB3S1R


class MatchedHighPass:
    """The floating reference height, which follows the height below the cut-off (5.3) of the speed.

    It replaces both integrations and the filters around them: subtract the measured height. The
    vehicle's motion cancels at any variation of the cut-off. At a constant one the difference is
    (A.1) of the profile; content below the cut-off is removed.

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
        """Observe signals sampled at ``rate_hz`` at f_ls, λ_c, v_0 and α (in s/m) of (5.3).

        Raises InputError for an unlikely rate, or unless the others are above zero.
        """
        self.schedule = AdaptiveCutOff(
            low_speed_cutoff_hz, cutoff_wavelength_m, transition_speed_mps, transition_steepness
        )
        axis = in_time(rate_hz)
        self._band = Band(self.schedule, axis.step)
        self._calls = Calls(type(self).__name__, ("reference_height",))
        signals = ACCELERATION, HEIGHT, TRAVEL_SPEED
        stages = ScheduleCutOff(self.schedule), Observer()
        self._observer = Alone(axis, signals, REFERENCE_HEIGHT, stages)
        self._reverse = backward(axis, ScheduleCutOff(self.schedule), *BACKWARD)

    @property
    def bridged(self) -> int:
        """Number of samples so far bridged for a missing (NaN) signal, profile or speed."""
        return self._observer.bridged + self._reverse.bridged

    def reference_height(self, a: ArrayLike, h: ArrayLike, speed: ArrayLike) -> FloatArray:
        """Return the floating reference height in m, shape (N,); minus ``h`` it is the elevation.

        Args:
            a: next samples of the acceleration with 1 g removed in m/s², shape (N,).
            h: height as it was measured in m, shape (N,).
            speed: travel speed there in m/s, shape (N,).

        Raises:
            InputError: for arrays of other shapes or infinite samples; for a speed whose cut-off
                is not below half the rate.
            StageError: after the end of the run.
        """
        call = "MatchedHighPass.reference_height"
        x, height, v_x = chunks(call, a=a, h=h, speed=speed)
        self._band.require(call, v_x)
        self._calls.add("reference_height", x.size, v_x)
        return self._observer(x, height, v_x)

    def reverse(self, profile: ArrayLike, speed: ArrayLike) -> FloatArray:
        """Return the backward pass in time over the whole run's elevation, HPF_B3S2R, HPF_B3S1R.

        The stages are in state-variable form, which is valid at a stop.

        Args:
            profile: the floating reference height minus the height in m, shape (N,).
            speed: the speed of all forward calls in m/s, shape (N,).

        Raises:
            InputError: for arrays of other shapes or infinite samples; a profile of NaN alone;
                for a speed whose cut-off is not below half the rate.
            StageError: unless N samples were observed at this speed; the second time.
        """
        call = "MatchedHighPass.reverse"
        z, v_x = chunks(call, profile=profile, speed=speed)
        require_profile(call, z)
        self._band.require(call, v_x)
        self._calls.end_in_time(z.size, v_x)
        return self._reverse(z, v_x)

    def reverse_over_distance(
        self, profile: ArrayLike, speed: ArrayLike, interval_m: float
    ) -> FloatArray:
        """Return that backward pass over distance, after the decimation (fig. 5.12).

        Args:
            profile: elevation every ``interval_m`` in m, shape (K,).
            speed: speed stored with each point in m/s, shape (K,).
            interval_m: distance between points in m.

        Raises:
            InputError: for arrays of other shapes or infinite samples; a profile of NaN alone; an
                interval not above zero; a speed without a cut-off.
            StageError: before anything was observed; the second time.
        """
        call = "MatchedHighPass.reverse_over_distance"
        z, v_x = chunks(call, profile=profile, speed=speed)
        require_profile(call, z)
        scheduled = ScheduleWaveNumber(self.schedule)
        back = backward(over_distance(interval_m), scheduled, *BACKWARD)
        self._band.require_over_distance(call, v_x, interval_m)
        self._calls.end("reverse_over_distance")
        self._reverse = back
        return back(z, v_x)
