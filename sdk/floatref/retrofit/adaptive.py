"""The high-pass filter whose cut-off follows the travel speed, before each integration."""

from collections.abc import Callable
from fractions import Fraction
from typing import ClassVar

from numpy.typing import ArrayLike

from floatref.retrofit.alone import Alone, chunks, in_time, over_distance
from floatref.retrofit.calls import MOTION, Band, Calls, require_profile
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


class FollowingHighPass:
    """A high-pass filter at the cut-off (5.3) of every sample's speed, with its backward passes.

    The cut-off is a frequency at low speed, a wavelength at high speed; content below is removed.

    Attributes:
        schedule: the cut-off that it follows.
    """

    _signals: ClassVar[tuple[str, ...]] = MOTION
    _back: ClassVar[tuple[Callable[[str], Stage], ...]]

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
        axis = in_time(rate_hz)
        self._calls = Calls(type(self).__name__, self._signals)
        self._band = Band(self.schedule, axis.step)
        self._forward = self._make_forward(axis)
        self._reverse = self._backward(axis, ScheduleCutOff(self.schedule))

    @property
    def bridged(self) -> int:
        """How many samples were bridged so far, of the signals and the profile, or their speed."""
        return sum(each.bridged for each in (*self._forward.values(), self._reverse))

    def reverse(self, profile: ArrayLike, speed: ArrayLike) -> FloatArray:
        """Return the backward pass in time over the whole run's elevation, HPF_B3S2R, HPF_B3S1R.

        Args:
            profile: elevation in m before this pass, shape (N,): the floating reference height
                minus the height, or the second integral minus the filtered height.
            speed: the speed of all forward calls in m/s, shape (N,).

        Raises:
            InputError: for arrays of other shapes or infinite samples; a profile of NaN only; for a
                speed whose cut-off is not below half the rate.
            StageError: unless N samples of every signal have passed at this speed; the second time.
        """
        call = f"{type(self).__name__}.reverse"
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
            StageError: unless all signals have equally many samples; the second time.
        """
        call = f"{type(self).__name__}.reverse_over_distance"
        z, v_x = chunks(call, profile=profile, speed=speed)
        require_profile(call, z)
        back = self._backward(over_distance(interval_m), ScheduleWaveNumber(self.schedule))
        self._band.require_over_distance(call, v_x, interval_m)
        self._calls.end("reverse_over_distance")
        self._reverse = back
        return back(z, v_x)

    def _make_forward(self, axis: Header) -> dict[str, Alone]:
        """Return what makes the result of each call."""
        raise NotImplementedError

    def _pass(self, call: str, **given: ArrayLike) -> FloatArray:
        """Filter the samples ``given`` to method ``call``, of which the last is the speed."""
        name = f"{type(self).__name__}.{call}"
        *signals, v_x = chunks(name, **given)
        self._band.require(name, v_x)
        self._calls.add(call, v_x.size, v_x)
        return self._forward[call](*signals, v_x)

    def _backward(self, axis: Header, scheduled: Stage) -> Alone:
        stages = scheduled, *(kind(ELEVATION) for kind in self._back)
        return Alone(axis, (ELEVATION, TRAVEL_SPEED), ELEVATION, stages)


class AdaptiveHighPass(FollowingHighPass):
    """Adaptive high-pass filtering (5.7) at the cut-off (5.3) of every sample's speed.

    As `HighPass`, with the speed beside every chunk. At low speed the content that the filter
    removes is content of the roughness too.
    """

    _back = (VaryingHighPassB3R,)

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
        return self._pass("acceleration", a=a, speed=speed)

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
        return self._pass("velocity", v=v, speed=speed)

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
        return self._pass("height", h=h, speed=speed)

    def finish(self) -> None:
        """End a run without a backward pass; StageError unless all three signals are complete."""
        self._calls.end("finish")

    def _make_forward(self, axis: Header) -> dict[str, Alone]:
        kinds: dict[str, tuple[str, tuple[Callable[[str], Stage], ...]]] = {
            "acceleration": (ACCELERATION, (VaryingHighPassB3S1,)),
            "velocity": (VELOCITY, (VaryingHighPassB3S2,)),
            "height": (HEIGHT, (FromFirst, VaryingHighPassB3)),
        }
        return {
            call: Alone(
                axis,
                (signal, TRAVEL_SPEED),
                signal,
                (ScheduleCutOff(self.schedule), *(kind(signal) for kind in of)),
            )
            for call, (signal, of) in kinds.items()
        }
