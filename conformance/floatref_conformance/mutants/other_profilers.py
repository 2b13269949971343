"""The high-pass filters of other profilers (Table 3.2), in place of ours.

They are sound filters; that they are others is what a check of wavebands has to see.
"""

from collections.abc import Callable

import numpy as np
import numpy.typing as npt

from floatref.values.arrays import FloatArray
from floatref.values.profile import Profile
from floatref_conformance.mutants import profiles as p
from floatref_conformance.mutants.mutation import After, Mutation

Waves = npt.NDArray[np.complex128]
OWN_CUT_OFF_M = 105.91
"""Cut-off wavelength in m of one pass of our filter, which runs forward and back."""
LEAST = 0.02
"""Our gain below which nothing is restored: what is left of such waves is rounding."""
AVERAGED_M, CUT_OFF_M, SECTIONS = 70.0, 91.44, 3
"""Base length of the moving average and cut-off wavelength of the others, in m; order of both."""
Response = Callable[[FloatArray, float], Waves]
"""Gain and phase of a filter at wavelengths, shape (n,), and an interval, all in m."""


def refilter(response: Response) -> After:
    """Return a mutation that replaces our high-pass by the one of ``response``."""

    def replace_filter(z: FloatArray, profile: Profile) -> FloatArray:
        known = np.nan_to_num(z)
        # Twice as long, so that the end does not reach round to the beginning.
        waves = np.fft.rfft(known, 2 * known.size)
        lengths = 1 / np.fft.rfftfreq(2 * known.size, profile.interval_m)[1:-1]
        ours = np.abs(pass_third_order(lengths, profile.interval_m, OWN_CUT_OFF_M)) ** 2
        theirs = response(lengths, profile.interval_m)
        waves[1:-1] *= np.where(ours > LEAST, theirs / np.maximum(ours, LEAST), 0.0)
        return np.where(np.isnan(z), z, np.fft.irfft(waves)[: z.size])

    return p.change_elevation(replace_filter)


def take_average_away(lengths_m: FloatArray, interval_m: float) -> Waves:
    """Return the response of a profile less its moving average, which has no phase."""
    count = 2 * round((AVERAGED_M / interval_m - 1) / 2) + 1
    half = np.pi * interval_m / lengths_m
    return np.asarray(1 - np.sin(count * half) / (count * np.sin(half)), dtype=np.complex128)


def pass_cotangent(lengths_m: FloatArray, interval_m: float) -> Waves:
    """Return the response of equal first-order sections that lose 3 dB together at the cut-off."""
    share = np.sqrt(2 ** (1 / SECTIONS) - 1)
    over = np.tan(np.pi * interval_m / lengths_m) / np.tan(np.pi * interval_m / CUT_OFF_M) / share
    return np.asarray((1j * over / (1 + 1j * over)) ** SECTIONS)


def pass_third_order(
    lengths_m: FloatArray, interval_m: float, cut_off_m: float = CUT_OFF_M
) -> Waves:
    """Return the response of a Butterworth high-pass of third order, forward."""
    below = np.tan(np.pi * interval_m / cut_off_m) / np.tan(np.pi * interval_m / lengths_m) / 1j
    return np.asarray(1 / (1 + 2 * below + 2 * below**2 + below**3))


OTHER_PROFILERS = (
    Mutation(
        "moving-average",
        "takes a moving average of 70 m away, like profiler 5 of Table 3.2",
        ("waveband",),
        after=refilter(take_average_away),
    ),
    Mutation(
        "cotangent",
        "filters forward only, by the cotangent filter of profiler 6 of Table 3.2",
        ("waveband",),
        after=refilter(pass_cotangent),
    ),
    Mutation(
        "third-order",
        "filters forward only, by the third-order Butterworth of profiler 3 of Table 3.2",
        ("waveband",),
        after=refilter(pass_third_order),
    ),
)
"""Filters of production profilers."""
