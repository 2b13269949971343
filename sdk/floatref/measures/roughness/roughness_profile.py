"""Where the roughness lies: the short-interval roughness profile and its peaks (2.1.3)."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from floatref.errors import InputError
from floatref.measures.gaps import check_elevation
from floatref.measures.roughness.areas import list_areas, share, valid_points, valid_throughout
from floatref.measures.roughness.iri_settings import IriSettings, intervals_in
from floatref.measures.roughness.roughness_index import STANDARD, iri_trace
from floatref.values.arrays import BoolArray, FloatArray, release
from floatref.values.scanning import CHUNK

BASE_M = 7.62
"""Base length of the short-interval roughness profile in m (25 ft)."""

LOCALIZED_ABOVE_M_PER_KM = 2.5
"""Continuous IRI in m/km above which roughness is localized, unless a contract says otherwise."""

M_PER_KM_TO_IN_PER_MI = 63.36
"""One m/km in inches per mile."""

TENTH_OF_A_MILE_M = 160.9344
"""Length in m of a segment that is reported by itself (0.1 mile)."""


@dataclass(frozen=True)
class LocalizedRoughness:
    """A stretch in m above a threshold, and the highest value in m/km and where it lies in m.

    ``valid_share`` is the share, 0 to 1, of its values whose base length holds valid points only.
    """

    start_m: float
    end_m: float
    peak_at_m: float
    peak_m_per_km: float
    valid_share: float = 1.0


def short_interval_roughness(
    elevation: FloatArray,
    interval_m: float,
    base_m: float = BASE_M,
    settings: IriSettings = STANDARD,
    out: FloatArray | None = None,
) -> FloatArray:
    """Return the moving average of the rectified IRI output in m/km, over ``base_m`` in m.

    One value fewer than ``elevation``: value k belongs to the interval from point k to k + 1 and
    is the mean of n = round(base/interval) values from k − n//2 on, of those there are near the
    ends. NaN before the first and after the last measured point. With ``out`` it is written there.
    Source: section 2.1.3.
    """
    if not (np.isfinite(base_m) and base_m > 0):
        raise InputError(f"base length is {base_m} m; it must be above zero")
    trace = iri_trace(elevation, interval_m, settings, out=out)
    rectified = np.abs(trace, out=trace)
    return _moving_average(rectified, intervals_in(base_m, interval_m))


def localized_roughness(
    elevation: FloatArray,
    interval_m: float,
    threshold_m_per_km: float,
    base_m: float = BASE_M,
    start_m: float = 0.0,
    valid: ArrayLike | None = None,
) -> tuple[LocalizedRoughness, ...]:
    """Return every stretch whose short-interval roughness exceeds ``threshold_m_per_km``.

    ``start_m`` is the position of point 0 in m; a stretch goes from the start of its first to the
    end of its last interval, and the peak lies in the middle of one. In order of position.
    ``valid`` has one value for each point; without it, finite points are valid. Source: 2.1.3; with
    7.62 m these are the areas of localized roughness of AASHTO R 54.
    """
    roughness = short_interval_roughness(elevation, interval_m, base_m)
    sound = valid_bases(elevation, interval_m, base_m, valid)
    return tuple(
        LocalizedRoughness(
            start_m + area.first * interval_m,
            start_m + area.end * interval_m,
            start_m + (area.peak + 0.5) * interval_m,
            float(roughness[area.peak]),
            share(sound[area.first : area.end]),
        )
        for area in list_areas(roughness, threshold_m_per_km)
    )


def valid_bases(
    elevation: FloatArray, interval_m: float, base_m: float = BASE_M, valid: ArrayLike | None = None
) -> BoolArray:
    """Return of which values of `short_interval_roughness` the base length holds valid points only.

    Same length as they; arguments and InputError as in `localized_roughness`.
    """
    values = check_elevation(elevation, interval_m)
    points = valid_points(valid, values)
    release(values)
    window = intervals_in(base_m, interval_m)
    before = window // 2
    return valid_throughout(points, before, window - before)[:-1]


def mean_roughness_index(left: float, right: float) -> float:
    """Return the mean of the IRIs of the two wheel paths of one lane, in their unit."""
    return (left + right) / 2.0


def in_per_mi(m_per_km: float) -> float:
    """Return a roughness in m/km as inches per mile."""
    return m_per_km * M_PER_KM_TO_IN_PER_MI


def m_per_km(in_per_mi: float) -> float:
    """Return a roughness in inches per mile as m/km."""
    return in_per_mi / M_PER_KM_TO_IN_PER_MI


def _moving_average(values: FloatArray, window: int) -> FloatArray:
    """Put the mean of ``window`` values from k − window//2 on, of the finite ones there are, at k.

    It goes in pieces over ``values``, which it overwrites and returns: a long profile then takes no
    more memory than they do.
    """
    before = values[:0]
    for first in range(0, values.size, CHUNK):
        end = min(first + CHUNK, values.size)
        part = np.concatenate((before, values[first : end + window]))
        values[first:end] = _means_of(part, before.size, end - first, window)
        overwritten = part[: before.size + end - first]
        before = overwritten[max(0, overwritten.size - window // 2) :]
    return values


def _means_of(values: FloatArray, before: int, count: int, window: int) -> FloatArray:
    """Return ``count`` means from index ``before`` on of ``values``, which go on where they do."""
    finite = np.isfinite(values)
    sums = np.concatenate(([0.0], np.cumsum(np.where(finite, values, 0.0))))
    counts = np.concatenate(([0], np.cumsum(finite)))
    first = np.arange(before, before + count) - window // 2
    ends = np.clip(first + window, 0, values.size)
    first = np.clip(first, 0, None)
    found = counts[ends] - counts[first]
    known = finite[before : before + count]
    means = np.divide(sums[ends] - sums[first], found, out=np.full(count, np.nan), where=known)
    return np.asarray(np.maximum(means, 0.0))
