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
from floatref.measures.gaps import bridge, check_elevation, measured_stretch
from floatref.measures.roughness.iri_settings import IriSettings
from floatref.measures.roughness.quarter_car import GOLDEN_CAR, KMH, Modes, QuarterCar
from floatref.values.arrays import FloatArray, read_only, release
from floatref.values.scanning import CHUNK, chunks

M_PER_KM = 1000.0
"""Slopes of 1 m/m in m/km."""

SHORTEST_PART = 0.1
"""Part of a segment below which what remains at the end joins the segment before it."""

STANDARD = IriSettings()
"""The settings of the IRI as it is defined."""


@dataclass(frozen=True)
class Segment:
    """IRI in m/km of ``length_m`` from ``start_m`` on; NaN where nothing was measured."""

    start_m: float
    length_m: float
    iri_m_per_km: float


def iri_trace(
    elevation: FloatArray,
    interval_m: float,
    settings: IriSettings = STANDARD,
    car: QuarterCar = GOLDEN_CAR,
    out: FloatArray | None = None,
) -> FloatArray:
    """Return the signed output of steps 1 to 3 in m/km, one value fewer than ``elevation``.

    Value k is the output at the end of the interval from point k to point k + 1; NaN before the
    first and after the last measured point. With another ``car`` it is the trace of another index,
    as of the Ride Number. With ``out`` it is written there. Raises InputError for a profile shorter
    than the start length. Source: steps 1 to 3 of section 2.1.1.
    """
    from floatref.measures.roughness.golden_car import car_response

    run = _Run.of(elevation, interval_m, settings, car)
    trace = np.empty(max(np.size(elevation) - 1, 0)) if out is None else out
    trace[: run.first], trace[run.first + run.elevation.size - 1 :] = np.nan, np.nan
    measured = trace[run.first : run.first + run.elevation.size - 1]
    states = np.zeros(4)
    # In pieces, so that a file is not in memory as a whole beside the trace.
    for at, part in chunks(run.elevation, run.window):
        out = measured[at : at + CHUNK]
        car_response(part, run.window, run.start_slope, 1.0 / interval_m, run.modes, states, out)
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
    with its own length, unless it joins the one before: `segment_edges`. A segment's IRI is the
    mean over its measured part, NaN without one.
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

    A segment of the profile's length or longer is the whole profile. A remainder shorter than a
    tenth of a segment joins the segment before it: sections of 0.1 mile are then at most 0.11 mile
    long, as 23 CFR 490.309 has them. Raises InputError for a segment shorter than the interval.
    """
    if segment_m is None or segment_m >= count * interval_m > 0:
        return np.array([0, count], dtype=np.int64)
    if segment_m < interval_m:
        raise InputError(f"segment is {segment_m:g} m, less than the interval {interval_m:g} m")
    whole = np.arange(int(count * interval_m / segment_m) + 2)
    edges = np.rint(whole * segment_m / interval_m).astype(np.int64)
    inside = edges[edges < count]
    shortest = SHORTEST_PART * segment_m / interval_m
    # A remainder of exactly a tenth is a segment, whatever the rounding.
    if inside.size > 1 and count - inside[-1] < shortest * (1.0 - 1e-9):
        inside = inside[:-1]
    return np.append(inside, count)


def rectified_sums(
    elevation: FloatArray,
    interval_m: float,
    edges: NDArray[np.int64],
    settings: IriSettings = STANDARD,
) -> FloatArray:
    """Return the sum of the rectified output in m/km between successive ``edges`` of intervals.

    ``elevation`` is measured at both ends; the car runs from the first interval to the last edge.
    Raises InputError as `iri`.
    """
    return _Run.of(elevation, interval_m, settings).rectified_sums(edges)


@dataclass(frozen=True, eq=False)
class _Run:
    """One pass of the car: the bridged profile in m from its first measured point on."""

    first: int
    elevation: FloatArray
    interval_m: float
    window: int
    start_slope: float
    modes: Modes

    @classmethod
    def of(
        cls,
        elevation: FloatArray,
        interval_m: float,
        settings: IriSettings,
        car: QuarterCar = GOLDEN_CAR,
    ) -> "_Run":
        """Return the pass over ``elevation``; InputError unless it is longer than the start."""
        values = check_elevation(elevation, interval_m)
        window, start = settings.window(interval_m), settings.start_count(interval_m)
        stretch = measured_stretch(values)
        measured = read_only(bridge(values[stretch]))
        if measured.size <= start:
            raise InputError(
                f"{(measured.size - 1) * interval_m:g} m of profile were measured; the car needs "
                f"{settings.start_length_m:g} m to find the slope it starts at"
            )
        start_slope = float(measured[start] - measured[0]) / (start * interval_m)
        release(values)
        modes = car.modes(interval_m / (settings.speed_kmh * KMH), M_PER_KM)
        return cls(stretch.start, measured, interval_m, window, start_slope, modes)

    def rectified_sums(self, edges: NDArray[np.int64]) -> FloatArray:
        """Return the sum of the rectified output in m/km between successive ``edges``."""
        from floatref.measures.roughness.golden_car import rectified_sums

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
