"""Slope in the waveband of 1.6 to 8 m: what every profiler and reference of a road share.

Hills, datum and the profilers' own high-pass lie above it, footprint and texture below.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from floatref.errors import InputError
from floatref.measures.roughness.gaps import bridge
from floatref.measures.roughness.wavebands import waveband_slope
from floatref.values.arrays import BoolArray, FloatArray, release
from floatref.values.profile import ProfileTrack

STEP_M = 0.25
"""Between the points of a slope: six of them in the shortest wave."""
CLIPPED_AT = 3.0
"""Slopes are clipped at this many times their 90th percentile, for artefacts would outweigh all."""
LEAST_VALID_M = 50.0
"""With less than that marked valid, all measured points are used."""
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
    bridged.
    """
    usable = usable_points(track, interval_m)
    if np.count_nonzero(usable) < 2 or interval_m >= 2.0:
        return None
    cut = slice(int(usable.argmax()), usable.size - int(usable[::-1].argmax()))
    z = bridge(track.elevation[cut], ~usable[cut])
    # Bridged, it is a copy, and what was read of the file would stay beside it.
    release(track.elevation)
    z, factor = _within_reach(z, z if z.flags.owndata else np.empty(z.size))
    release(track.elevation)
    try:
        slope = waveband_slope(z, interval_m, "medium")
    except InputError:
        return None
    del z
    slope *= factor
    known = usable[cut][:-1] & usable[cut][1:]
    slope[~known] = 0.0
    begin = start_m + interval_m * (cut.start + 0.5)
    return _on_steps(begin, interval_m, slope, known, clipped)


def usable_points(track: ProfileTrack, interval_m: float) -> BoolArray:
    """Return the valid points of ``track``, or all measured ones if too few of them are."""
    if np.count_nonzero(track.valid) * interval_m >= LEAST_VALID_M:
        return track.valid
    return np.isfinite(track.elevation)


def _within_reach(z: FloatArray, rise: FloatArray) -> tuple[FloatArray, float]:
    """Return ``z`` about its mean and less by a factor, so that no filter refuses it, in ``rise``.

    ``rise`` may be ``z``.
    """
    np.subtract(z, z.mean(), out=rise)
    factor = max(float(rise.max()) / HIGHEST, -float(rise.min()) / HIGHEST, 1.0)
    rise /= factor
    return rise, factor


def _on_steps(
    begin_m: float, interval_m: float, slope: FloatArray, known: BoolArray, clipped: bool
) -> Slope:
    """Return ``slope``, whose value 0 lies at ``begin_m``, linearly at whole steps."""
    end_m = begin_m + interval_m * (slope.size - 1)
    first = math.ceil(begin_m / STEP_M)
    steps = STEP_M * np.arange(first, math.floor(end_m / STEP_M) + 1)
    place = np.clip((steps - begin_m) / interval_m, 0.0, slope.size - 1.0)
    low = np.floor(place).astype(np.int64)
    high, part = np.minimum(low + 1, slope.size - 1), place - low
    measured = np.where(part < 0.999, known[low], True) & np.where(part > 0.001, known[high], True)
    between = slope[low] + part * (slope[high] - slope[low])
    values = np.where(measured, between, 0.0)
    if clipped and measured.any():
        limit = CLIPPED_AT * float(np.quantile(np.abs(values[measured]), 0.9))
        values = np.clip(values, -limit, limit)
    return Slope(float(STEP_M * first), values, measured)


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
