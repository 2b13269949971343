"""The International Roughness Index of a profile, whole and by segment (Karamihas 2021, 2.1.1).

Slope is the finite difference of elevation. Value i of the moving average is the mean of slopes
i to i + n − 1, fewer at the end of the profile. The Golden Car runs once over the whole profile.
Missing elevations between measured ones are bridged by a straight line; before the first and
after the last measured one nothing is calculated.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from floatref.errors import InputError
from floatref.kernels.compiling import compiled
from floatref.measures.roughness.gaps import bridged, check_elevation, measured_stretch
from floatref.measures.roughness.iri_settings import IriSettings
from floatref.measures.roughness.quarter_car import GOLDEN_CAR, KMH
from floatref.values.arrays import FloatArray


@compiled
def car_response(
    elevation: FloatArray,
    window: int,
    start_slope: float,
    per_step: float,
    modes: FloatArray,
    response: FloatArray,
) -> None:
    """Write the output after each of the ``elevation.size - 1`` intervals to ``response``."""
    a_re, a_im, a_gain_re, a_gain_im = modes[0], modes[1], modes[2], modes[3]
    b_re, b_im, b_gain_re, b_gain_im = modes[4], modes[5], modes[6], modes[7]
    a_x = a_y = b_x = b_y = 0.0
    last = elevation.size - 1
    per_window = per_step / window
    for k in range(last):
        if k + window <= last:
            slope = (elevation[k + window] - elevation[k]) * per_window - start_slope
        else:
            slope = (elevation[last] - elevation[k]) * per_step / (last - k) - start_slope
        # The newest state enters each sum last: the chain from point to point stays short.
        a_next = (a_gain_re * slope - a_im * a_y) + a_re * a_x
        a_y = (a_gain_im * slope + a_im * a_x) + a_re * a_y
        a_x = a_next
        b_next = (b_gain_re * slope - b_im * b_y) + b_re * b_x
        b_y = (b_gain_im * slope + b_im * b_x) + b_re * b_y
        b_x = b_next
        response[k] = a_x + b_x


@compiled
def rectified_sums(
    elevation: FloatArray,
    window: int,
    start_slope: float,
    per_step: float,
    modes: FloatArray,
    edges: np.ndarray[tuple[int], np.dtype[np.int64]],
    sums: FloatArray,
) -> None:
    """Write the sum of the rectified output from ``edges[j]`` to ``edges[j + 1]`` to ``sums[j]``.

    The car runs once from the first interval to the last edge and is not started again.
    """
    a_re, a_im, a_gain_re, a_gain_im = modes[0], modes[1], modes[2], modes[3]
    b_re, b_im, b_gain_re, b_gain_im = modes[4], modes[5], modes[6], modes[7]
    a_x = a_y = b_x = b_y = 0.0
    last = elevation.size - 1
    per_window = per_step / window
    for segment in range(sums.size):
        total = 0.0
        for k in range(edges[segment], edges[segment + 1]):
            if k + window <= last:
                slope = (elevation[k + window] - elevation[k]) * per_window - start_slope
            else:
                slope = (elevation[last] - elevation[k]) * per_step / (last - k) - start_slope
            a_next = (a_gain_re * slope - a_im * a_y) + a_re * a_x
            a_y = (a_gain_im * slope + a_im * a_x) + a_re * a_y
            a_x = a_next
            b_next = (b_gain_re * slope - b_im * b_y) + b_re * b_x
            b_y = (b_gain_im * slope + b_im * b_x) + b_re * b_y
            b_x = b_next
            total += abs(a_x + b_x)
        sums[segment] = total


M_PER_KM = 1000.0
"""Slopes of 1 m/m in m/km."""

STANDARD = IriSettings()
"""The settings of the IRI as it is defined."""


@dataclass(frozen=True)
class Segment:
    """IRI in m/km of ``length_m`` from ``start_m`` on; NaN where nothing was measured."""

    start_m: float
    length_m: float
    iri_m_per_km: float


def iri_trace(
    elevation: FloatArray, interval_m: float, settings: IriSettings = STANDARD
) -> FloatArray:
    """Return the signed output of steps 1 to 3 in m/km, one value fewer than ``elevation``.

    Value k is the output at the end of the interval from point k to point k + 1; NaN before the
    first and after the last measured point. Raises InputError for a profile shorter than the
    start length. Source: steps 1 to 3 of section 2.1.1.
    """
    run = _Run.of(elevation, interval_m, settings)
    trace = np.full(max(np.size(elevation) - 1, 0), np.nan)
    measured = trace[run.first : run.first + run.elevation.size - 1]
    car_response(run.elevation, run.window, run.start_slope, 1.0 / interval_m, run.modes, measured)
    return trace


def iri(elevation: FloatArray, interval_m: float, settings: IriSettings = STANDARD) -> float:
    """Return the IRI in m/km of ``elevation`` in m at ``interval_m``, by section 2.1.1.

    The average goes from the first to the last measured point. Raises InputError for a profile
    shorter than the start length.
    """
    run = _Run.of(elevation, interval_m, settings)
    count = run.elevation.size - 1
    return float(run.rectified_sums(np.array([0, count], dtype=np.int64))[0] / count)


def iri_segments(
    elevation: FloatArray,
    interval_m: float,
    settings: IriSettings = STANDARD,
    start_m: float = 0.0,
) -> tuple[Segment, ...]:
    """Return the IRI of every ``settings.segment_m`` of the profile, whose point 0 is at start_m.

    The car is not started again between segments. Boundaries lie at the points next to whole
    multiples of the segment length, so they do not drift; the last, partial segment is kept
    with its own length. A segment's IRI is the mean over its measured part, NaN without one.
    Raises InputError for a segment shorter than the interval.
    """
    run = _Run.of(elevation, interval_m, settings)
    edges = segment_edges(np.size(elevation) - 1, interval_m, settings.segment_m)
    inside = np.clip(edges - run.first, 0, run.elevation.size - 1)
    sums = run.rectified_sums(inside)
    counts = np.diff(inside)
    means = np.divide(sums, counts, out=np.full(sums.size, np.nan), where=counts > 0)
    starts, lengths = start_m + edges[:-1] * interval_m, np.diff(edges) * interval_m
    return tuple(map(Segment, starts.tolist(), lengths.tolist(), means.tolist()))


def segment_edges(count: int, interval_m: float, segment_m: float | None) -> NDArray[np.int64]:
    """Return the first interval of every segment of ``count`` intervals, and ``count``.

    A segment of the profile's length or longer is the whole profile.
    """
    if segment_m is None or segment_m >= count * interval_m > 0:
        return np.array([0, count], dtype=np.int64)
    if segment_m < interval_m:
        raise InputError(f"segment is {segment_m:g} m, less than the interval {interval_m:g} m")
    whole = np.arange(int(count * interval_m / segment_m) + 2)
    edges = np.rint(whole * segment_m / interval_m).astype(np.int64)
    return np.append(edges[edges < count], count)


@dataclass(frozen=True, eq=False)
class _Run:
    """One pass of the car: the bridged profile in m from its first measured point on."""

    first: int
    elevation: FloatArray
    interval_m: float
    window: int
    start_slope: float
    modes: FloatArray

    @classmethod
    def of(cls, elevation: FloatArray, interval_m: float, settings: IriSettings) -> "_Run":
        """Return the pass over ``elevation``; InputError unless it is longer than the start."""
        values = check_elevation(elevation, interval_m)
        window, start = settings.window(interval_m), settings.start_count(interval_m)
        stretch = measured_stretch(values)
        measured = bridged(values[stretch])
        if measured.size <= start:
            raise InputError(
                f"{(measured.size - 1) * interval_m:g} m of profile were measured; the car needs "
                f"{settings.start_length_m:g} m to find the slope it starts at"
            )
        start_slope = float(measured[start] - measured[0]) / (start * interval_m)
        modes = GOLDEN_CAR.modes(interval_m / (settings.speed_kmh * KMH), M_PER_KM)
        return cls(stretch.start, measured, interval_m, window, start_slope, modes)

    def rectified_sums(self, edges: NDArray[np.int64]) -> FloatArray:
        """Return the sum of the rectified output in m/km between successive ``edges``."""
        sums = np.zeros(edges.size - 1)
        rectified_sums(
            self.elevation,
            self.window,
            self.start_slope,
            1.0 / self.interval_m,
            self.modes,
            edges,
            sums,
        )
        return sums
