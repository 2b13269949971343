"""High-pass filters at a fixed cut-off before each integration, in time and over distance."""

from fractions import Fraction

from numpy.typing import ArrayLike

from floatref.kernels.cut_off import high_pass_setting
from floatref.retrofit.alone import Alone, chunks, in_time, over_distance
from floatref.retrofit.calls import Calls, require_profile
from floatref.stages.conditioning import FromFirst
from floatref.stages.filters.butterworth import (
    HighPassB3S1,
    HighPassB3S1R,
    HighPassB3S2,
    HighPassB3S2R,
    high_pass_b3,
)
from floatref.stages.signals import ACCELERATION, ELEVATION, HEIGHT, VELOCITY
from floatref.values.arrays import FloatArray
from floatref.values.block import Header
from floatref.values.plain import above_zero


class FixedHighPass:
    """HPF_B3 (A.1) in two stages, one before each integration, both on the height.

    The same filter on both sides of the difference cancels the vehicle's motion; so all three
    signals must pass, with the same samples, before the run can end.
    """

    def __init__(self, axis: Header, cutoff: float) -> None:
        """Filter at ``cutoff`` in cycles per unit of ``axis``."""
        self._calls = Calls(type(self).__name__)
        first, second = HighPassB3S1(ACCELERATION, cutoff), HighPassB3S2(VELOCITY, cutoff)
        both = FromFirst(HEIGHT), *high_pass_b3(HEIGHT, cutoff)
        self._acceleration = Alone(axis, (ACCELERATION,), ACCELERATION, (first,))
        self._velocity = Alone(axis, (VELOCITY,), VELOCITY, (second,))
        self._height = Alone(axis, (HEIGHT,), HEIGHT, both)
        back = HighPassB3S2R(ELEVATION, cutoff), HighPassB3S1R(ELEVATION, cutoff)
        self._reverse = Alone(axis, (ELEVATION,), ELEVATION, back)

    @property
    def bridged(self) -> int:
        """How many missing (NaN) samples of the signals and the profile were bridged so far."""
        all_of = self._acceleration, self._velocity, self._height, self._reverse
        return sum(each.bridged for each in all_of)

    def acceleration(self, a: ArrayLike) -> FloatArray:
        """Return HPF_B3S1 of the acceleration with 1 g removed, before the first integration.

        Args:
            a: next samples in m/s², shape (N,).

        Raises:
            InputError: unless the array is one-dimensional, of finite numbers and NaN.
            StageError: after the end of the run.
        """
        (x,) = chunks(f"{type(self).__name__}.acceleration", a=a)
        self._calls.add("acceleration", x.size)
        return self._acceleration(x)

    def velocity(self, v: ArrayLike) -> FloatArray:
        """Return HPF_B3S2 of the integrated acceleration, before the second integration.

        Args:
            v: next samples in m/s, shape (N,).

        Raises:
            InputError: unless the array is one-dimensional, of finite numbers and NaN.
            StageError: beyond the samples of the acceleration so far; after the end of the run.
        """
        (x,) = chunks(f"{type(self).__name__}.velocity", v=v)
        self._calls.add("velocity", x.size)
        return self._velocity(x)

    def height(self, h: ArrayLike) -> FloatArray:
        """Return HPF_B3 of the height, counted from its first sample, to be subtracted.

        Args:
            h: next samples in m, shape (N,).

        Raises:
            InputError: unless the array is one-dimensional, of finite numbers and NaN.
            StageError: after the end of the run.
        """
        (x,) = chunks(f"{type(self).__name__}.height", h=h)
        self._calls.add("height", x.size)
        return self._height(x)

    def reverse(self, profile: ArrayLike) -> FloatArray:
        """Return HPF_B3S1R of HPF_B3S2R of the whole run's elevation, which undoes the phase.

        Args:
            profile: the second integral minus the filtered height in m, shape (N,).

        Raises:
            InputError: unless the array is one-dimensional, of finite numbers and NaN, or of NaN
                alone.
            StageError: unless N samples of all three signals have passed; the second time.
        """
        call = f"{type(self).__name__}.reverse"
        (z,) = chunks(call, profile=profile)
        require_profile(call, z)
        self._calls.end_in_time(z.size)
        return self._reverse(z)

    def finish(self) -> None:
        """End a run without a backward pass; StageError unless all three signals are complete."""
        self._calls.end("finish")


class HighPass(FixedHighPass):
    """Temporal high-pass filtering before the integrations (5.5).

    ``cutoff_hz`` is that of each third-order pass; by default forward and backward pass together
    lose 3 dB at 0.0489 Hz, (A.20). The filter removes content below the cut-off from every
    sample; those within about a period of it from either end are run-in and run-out.
    """

    def __init__(
        self, rate_hz: float | Fraction, cutoff_hz: float = high_pass_setting(0.0489)
    ) -> None:
        """Filter signals sampled at ``rate_hz``.

        Raises InputError for an unlikely rate or a cut-off outside 0 to half of it.
        """
        super().__init__(in_time(rate_hz), above_zero("cutoff_hz", cutoff_hz))


class SpatialHighPass(FixedHighPass):
    """Spatial high-pass filtering before the integrations (5.9): one sample per interval.

    ``cutoff_wavelength_m`` is that of each third-order pass. The filter removes longer wavelengths
    from every point; points within about one such wavelength from either end are run-in and
    run-out.
    """

    def __init__(self, interval_m: float, cutoff_wavelength_m: float = 105.91) -> None:
        """Filter signals sampled every ``interval_m``.

        Raises InputError unless the interval is above zero and the wavelength above two of it.
        """
        wavelength = above_zero("cutoff_wavelength_m", cutoff_wavelength_m)
        super().__init__(over_distance(interval_m), 1.0 / wavelength)
