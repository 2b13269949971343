"""Slope in the waveband of 1.6 to 8 m: what every profiler and reference of a road share.

Hills, datum and the profilers' own high-pass lie above it, footprint and texture below.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from floatref.errors import InputError
from floatref.measures.gaps import bridge
from floatref.measures.roughness.pieces_of_road import RUN_IN_WAVES, cut_road, mean_slope
from floatref.measures.roughness.wavebands import WAVEBANDS, waveband_slope
from floatref.values.arrays import BoolArray, FloatArray, release
from floatref.values.profile import ProfileTrack
from floatref.values.scanning import chunks, flags_where

BAND = "medium"
"""Its waveband, in `floatref.measures.WAVEBANDS`."""
STEP_M = 0.25
"""Between the points of a slope: six of them in the shortest wave."""
CLIPPED_AT = 3.0
"""Slopes are clipped at this many times their 90th percentile, for artefacts would outweigh all."""
LEAST_VALID_M = 50.0
"""With less than that marked valid, all measured points are used."""
BEYOND = 1e100
"""An elevation of a damaged file, in any unit: its square is a number still."""
HIGHEST = 9e5
"""Elevations beyond are refused by filters; a road in mm may be higher."""


@dataclass(frozen=True, eq=False)
class Slope:
    """Slope at ``start_m + k * STEP_M``, 0 where ``measured`` is false; both of shape (n,)."""

    start_m: float
    values: FloatArray
    measured: BoolArray

    @property
    def distance_m(self) -> FloatArray:
        """Position of every point in m."""
        return self.start_m + STEP_M * np.arange(self.values.size, dtype=np.float64)

    @property
    def end_m(self) -> float:
        """Position of the last point in m."""
        return self.start_m + STEP_M * (self.values.size - 1)

    def energy(self) -> float:
        """Return the sum of squares."""
        return float(np.square(self.values).sum())


def slope_of(
    track: ProfileTrack, start_m: float, interval_m: float, clipped: bool = True
) -> Slope | None:
    """Return the slope of ``track``, whose point 0 lies at ``start_m``; None without a valid point.

    Elevation may be in any unit: its mean is taken away first, and points that are not usable are
    bridged. A long road is filtered in pieces.
    """
    usable = usable_points(track, interval_m)
    if np.count_nonzero(usable) < 2 or interval_m >= 2.0:
        return None
    cut = slice(int(usable.argmax()), usable.size - int(usable[::-1].argmax()))
    z, usable = track.elevation[cut], usable[cut]
    begin_m, count = start_m + interval_m * (cut.start + 0.5), usable.size - 1
    first = math.ceil(begin_m / STEP_M)
    last_m = begin_m + interval_m * (count - 1)
    steps = STEP_M * np.arange(first, math.floor(last_m / STEP_M) + 1)
    place = np.clip((steps - begin_m) / interval_m, 0.0, count - 1.0)
    found = Slope(STEP_M * first, np.zeros(steps.size), np.zeros(steps.size, dtype=np.bool_))
    try:
        _fill(found, place, z, usable, interval_m)
    except InputError:
        return None
    return _clip(found) if clipped and found.measured.any() else found


def usable_points(track: ProfileTrack, interval_m: float) -> BoolArray:
    """Return the valid points of ``track``, or all measured ones if too few of them are.

    A point of `BEYOND` or more is not usable.
    """
    measured = flags_where(lambda z: np.abs(z) < BEYOND, track.elevation)
    usable = track.valid & measured
    return usable if np.count_nonzero(usable) * interval_m >= LEAST_VALID_M else measured


def _fill(
    found: Slope, place: FloatArray, z: FloatArray, usable: BoolArray, interval_m: float
) -> None:
    """Write the slope of ``z``, its values being at 0, 1, and so on, to ``found``, at ``place``.

    InputError as `waveband_slope`.
    """
    mean, factor = _level(z, usable)
    run_in_m = RUN_IN_WAVES * WAVEBANDS[BAND].long_m
    mean_rise = mean_slope(z, interval_m) / factor
    for piece in cut_road(usable, run_in_m, interval_m):
        missing = ~usable[piece.points]
        rise = (bridge(z[piece.points], missing) - mean) / factor
        # What was read of a file would stay in memory.
        release(z)
        slope = factor * waveband_slope(rise, interval_m, BAND, mean_rise)
        known = ~(missing[:-1] | missing[1:])
        slope[~known] = 0.0
        at = slice(*np.searchsorted(np.floor(place), (piece.begin, piece.end)))
        found.values[at], found.measured[at] = _between(slope, known, place[at] - piece.first)


def _level(z: FloatArray, usable: BoolArray) -> tuple[float, float]:
    """Return the mean of ``z``, and a factor by which no filter refuses it, less its mean."""
    total, low, high = 0.0, np.inf, -np.inf
    for at, part in chunks(z):
        known = part[usable[at : at + part.size]]
        total += float(known.sum())
        low, high = float(known.min(initial=low)), float(known.max(initial=high))
    mean = total / np.count_nonzero(usable)
    return mean, max((high - mean) / HIGHEST, (mean - low) / HIGHEST, 1.0)


def _between(
    slope: FloatArray, known: BoolArray, place: FloatArray
) -> tuple[FloatArray, BoolArray]:
    """Return ``slope`` linearly at the fractional ``place``, and where it is known."""
    low = np.floor(place).astype(np.int64)
    high, part = np.minimum(low + 1, slope.size - 1), place - low
    measured = np.where(part < 0.999, known[low], True) & np.where(part > 0.001, known[high], True)
    between = slope[low] + part * (slope[high] - slope[low])
    return np.where(measured, between, 0.0), measured


def _clip(slope: Slope) -> Slope:
    """Return ``slope`` within its limit."""
    limit = CLIPPED_AT * float(np.quantile(np.abs(slope.values[slope.measured]), 0.9))
    return replace(slope, values=np.clip(slope.values, -limit, limit))


def align(slopes: Sequence[Slope]) -> tuple[Slope, ...]:
    """Return ``slopes`` from their first point to their last; 0 where a slope has no point."""
    start = min(s.start_m for s in slopes)
    end = max(s.end_m for s in slopes)
    return tuple(_extend(s, start, end) for s in slopes)


def _extend(slope: Slope, start_m: float, end_m: float) -> Slope:
    """Return ``slope`` from ``start_m`` to ``end_m``."""
    before = round((slope.start_m - start_m) / STEP_M)
    after = round((end_m - slope.end_m) / STEP_M)
    return Slope(
        start_m, np.pad(slope.values, (before, after)), np.pad(slope.measured, (before, after))
    )
