"""From flags to validity: which points of a profile are valid."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from math import sqrt
from typing import Any

import numpy as np

from floatref.values.arrays import BoolArray, Flag, FlagArray, FloatArray, IndexArray

PIECE = 1 << 18
"""Points processed together, so that memory stays bounded on a long profile."""
REACHED = np.uint8(0x80)
"""A bit that no flag has: the point is within reach of a flagged one."""
PART = 1 << 14
"""Points of a piece whose mean slopes are taken together: their indices are longer than they."""


@dataclass(frozen=True)
class Reach:
    """The distance in m around a flagged point within which its error matters.

    Every flagged point is invalid: it was bridged, or the vehicle crawled, stood still or braked
    hard for its speed there. The high-pass filter spreads the error of such a point:

    Attributes:
        drift_m: to either side of a long gap of the accelerometer: a cut-off wavelength.
        run_in_m: from either end of the run: half a cut-off wavelength, beyond which the filter's
            start does not change the IRI.
        before_slow_m, after_slow_m: of slow travel. Contamination reached 47 m before and 76 m
            behind a stop without suppression (section 3.3.7), and 1.5 cut-off wavelengths where the
            stop is one time step; with suppression 15 and 30 m are enough. The remaining profile
            has the road's IRI within 5 % on the published runs, simulated.
        after_braking_m: behind braking; the sharpest kink is where the brake is released, and
            raised the roughness up to 31.5 m behind it (section 3.3.5).
    """

    drift_m: float = 0.0
    run_in_m: float = 0.0
    before_slow_m: float = 0.0
    after_slow_m: float = 0.0
    after_braking_m: float = 0.0

    @classmethod
    def of(cls, settings: Mapping[str, Any]) -> "Reach":
        """Return the reach from a pipeline's settings; a missing setting is 0."""
        wavelength = settings.get("cutoff_wavelength_m") or 0.0
        return cls(
            drift_m=settings.get("drift_reach_m") or wavelength,
            run_in_m=settings.get("run_in_m") or wavelength / 2,
            before_slow_m=settings.get("before_slow_m") or 0.0,
            after_slow_m=settings.get("after_slow_m") or 0.0,
            after_braking_m=settings.get("after_braking_m") or 0.0,
        )


def replace_by_validity(flags: FlagArray, interval_m: float, reach: Reach) -> BoolArray:
    """Return which points are valid: unflagged, and out of ``reach`` of flagged ones.

    In the memory of ``flags``, which are lost: a long run has no room for both.
    """

    def points(length_m: float) -> int:
        return round(min(length_m / interval_m, flags.size))

    kinds = (
        (Flag.DRIFT, points(reach.drift_m), points(reach.drift_m)),
        (Flag.SLOW, points(reach.before_slow_m), points(reach.after_slow_m)),
        (Flag.BRAKING, 0, points(reach.after_braking_m)),
    )
    for flag, before, after in kinds:
        _spread(flags, flag, before, after)
    run_in = points(reach.run_in_m)
    flags[:run_in] |= REACHED
    flags[flags.size - run_in :] |= REACHED
    return np.equal(flags, 0, out=flags.view(np.bool_))


def _spread(flags: FlagArray, flag: Flag, before: int, after: int) -> None:
    for begin in range(0, flags.size, PIECE):
        marked = (flags[begin : begin + PIECE] & np.uint8(flag)) != 0
        for first, last in _groups(marked, before + after + 1):
            flags[max(begin + first - before, 0) : begin + last + after + 1] |= REACHED


def _groups(marked: BoolArray, apart: int) -> Iterator[tuple[int, int]]:
    """Yield first and last of the marked points in groups, up to ``apart`` from the next."""
    index = np.flatnonzero(marked)
    if index.size:
        gaps = np.flatnonzero(np.diff(index) > apart)
        firsts, lasts = index[np.append(0, gaps + 1)], index[np.append(gaps, -1)]
        yield from zip(firsts.tolist(), lasts.tolist(), strict=True)


LAG_M = 0.05
"""Length in m over which slopes are taken: an encoder's error after a few hundred metres."""
AROUND_M = 50.0
"""Length in m: the slope is the root mean square within half of it to either side."""


def add_axis_error(
    sigma: FloatArray, elevation: FloatArray, interval_m: float, scale: float
) -> None:
    """Add to ``sigma`` in m, shape (N,), the effect of a relative error ``scale`` of distance.

    It is changed in place: for a long run a second array would need much memory.
    """
    beside = round((AROUND_M / 2 + LAG_M) / interval_m) + 1
    for begin in range(0, sigma.size, PIECE):
        end = min(begin + PIECE, sigma.size)
        low = max(begin - beside, 0)
        slopes = slope(elevation[low : end + beside], interval_m)[begin - low : end - low]
        off = scale * interval_m * np.arange(begin, end)
        np.hypot(sigma[begin:end], off * slopes, out=sigma[begin:end])


def add_contact_error(
    sigma: FloatArray, elevation: FloatArray, interval_m: float, contact_m: float
) -> None:
    """Add to ``sigma`` in m, shape (N,), what a tyre smooths over ``contact_m``; in place.

    Of a road whose spectrum falls as C/n², the mean over L omits ∫ C/n² (1 - sin(πnL)/(πnL))² dn =
    π²CL/6 of the variance. Two points L apart on the smoothed road differ by 2 ∫ C/n²
    (sin(πnL)/(πnL))² (1 - cos 2πnL) dn = 4π²CL/3 in the mean square, eight times as much.
    """
    beside = round((AROUND_M / 2 + contact_m) / interval_m) + 1
    lag_m = max(1, round(contact_m / interval_m)) * interval_m
    for begin in range(0, sigma.size, PIECE):
        end = min(begin + PIECE, sigma.size)
        low = max(begin - beside, 0)
        slopes = slope(elevation[low : end + beside], interval_m, lag_m)[begin - low : end - low]
        np.hypot(sigma[begin:end], slopes * sqrt(lag_m * contact_m / 8.0), out=sigma[begin:end])


def slope(elevation: FloatArray, interval_m: float, lag_m: float = LAG_M) -> FloatArray:
    """Return the root mean square of the slopes around every point, shape (N,).

    A slope is taken over ``lag_m``. Missing elevations are omitted; the result is 0 where fewer
    than two elevations are known.
    """
    lag = max(1, round(lag_m / interval_m))
    if elevation.size <= lag:
        return np.zeros(elevation.size)
    squares, counts = _running_sums(elevation, lag, lag * interval_m)
    half, last = max(1, round(AROUND_M / 2 / interval_m)), counts.size - 1
    mean = np.empty(elevation.size)
    for begin in range(0, mean.size, PART):
        place = np.arange(begin, min(begin + PART, mean.size))
        low, high = np.clip(place - half, 0, last - 1), np.clip(place + half, 0, last)
        number = np.maximum(counts[high] - counts[low], 1)
        mean[begin : begin + PART] = np.sqrt((squares[high] - squares[low]) / number)
    return mean


def _running_sums(
    elevation: FloatArray, lag: int, length_m: float
) -> tuple[FloatArray, IndexArray]:
    """Return the sums of the squares of all slopes before each, and how many are known."""
    steps = (elevation[lag:] - elevation[:-lag]) / length_m
    there = np.isfinite(steps)
    steps[~there] = 0.0
    steps *= steps
    return np.cumsum(np.append(0.0, steps)), np.cumsum(np.append(0, there))
