"""What is read off the trace of a profilograph: the profile index and what must be ground.

The rules are those of California Test 526, on which ASTM E1274 rests too. A blanking band covers
the middle of the trace; every scallop that leaves it is measured, and the sum of their heights per
length is the profile index. The test places band and template by eye. Here the band is centred on
the mean of the trace of each segment, and a point must be ground where the trace is lower by more
than the template's height on both sides of it, within the template's length.
"""

from collections.abc import Iterator
from dataclasses import asdict, dataclass
from itertools import pairwise
from typing import Any

import numpy as np

from floatref.errors import InputError
from floatref.measures.roughness.areas import list_areas, share
from floatref.measures.roughness.roughness_index import M_PER_KM, segment_edges
from floatref.measures.roughness.roughness_profile import TENTH_OF_A_MILE_M
from floatref.values.arrays import BoolArray, FloatArray
from floatref.values.scanning import CHUNK


@dataclass(frozen=True)
class TraceRules:
    """How a trace is read; all lengths and heights in m.

    Height of the blanking band (0.2 in; 0 for the zero blanking band); a scallop counts from a
    height of 0.03 in and a length of 2 ft on, and its height is rounded to 0.05 in (0: not
    rounded); the template for bumps is 0.3 in high and 25 ft long. Raises InputError for a value
    that is not finite, below zero, or zero where that has no meaning.
    """

    blanking_band_m: float = 0.00508
    least_height_m: float = 0.000762
    least_length_m: float = 0.6096
    rounding_m: float = 0.00127
    bump_height_m: float = 0.00762
    bump_length_m: float = 7.62
    segment_m: float = TENTH_OF_A_MILE_M

    def __post_init__(self) -> None:
        """Refuse what cannot be a length or a height."""
        needed = ("bump_height_m", "bump_length_m", "segment_m")
        for name, value in asdict(self).items():
            if not (np.isfinite(value) and (value > 0.0 or (value == 0.0 and name not in needed))):
                raise InputError(f"{name} is {value}; give a finite length above zero, in m")

    def as_dict(self) -> dict[str, Any]:
        """Return the rules by name."""
        return asdict(self)


CALIFORNIA_RULES = TraceRules()


@dataclass(frozen=True)
class IndexOfSegment:
    """Profile index of a segment of a trace, and how many scallops it is the sum of.

    ``measured_m`` is the length in m that the trace covers, by which the index is divided;
    ``profile_index_m_per_km`` is NaN where that is 0. ``valid_share`` is the share, 0 to 1, of its
    values under whose frame all points are valid.
    """

    start_m: float
    length_m: float
    measured_m: float
    scallops: int
    profile_index_m_per_km: float
    valid_share: float


@dataclass(frozen=True)
class MustGrind:
    """An area from its first to its last point in m, and where in m its highest point is.

    ``height_m`` is how far that is above the higher of the lowest points on both sides, in m.
    """

    start_m: float
    end_m: float
    peak_at_m: float
    height_m: float
    valid_share: float


def profile_indices(
    trace: FloatArray,
    sound: BoolArray,
    interval_m: float,
    rules: TraceRules = CALIFORNIA_RULES,
    start_m: float = 0.0,
) -> tuple[IndexOfSegment, ...]:
    """Return the profile index of every segment of ``trace`` in m, which may have NaN.

    ``sound`` says for each value whether it rests on valid points only; ``start_m`` is the position
    of value 0 in m. The index is Σ h/length, h the heights of the scallops. Raises InputError for a
    segment shorter than the interval. Source: California Test 526.
    """
    edges = segment_edges(trace.size, interval_m, rules.segment_m).tolist()
    return tuple(
        index_of_stretch(
            trace[first:end], sound[first:end], interval_m, rules, start_m + first * interval_m
        )
        for first, end in pairwise(edges)
    )


def index_of_stretch(
    trace: FloatArray,
    sound: BoolArray,
    interval_m: float,
    rules: TraceRules = CALIFORNIA_RULES,
    start_m: float = 0.0,
) -> IndexOfSegment:
    """Return the profile index of all of ``trace``; arguments as of `profile_indices`."""
    measured = np.isfinite(trace)
    heights = list(scallop_heights(trace, interval_m, rules))
    length = float(np.count_nonzero(measured)) * interval_m
    index = M_PER_KM * sum(heights) / length if length else float("nan")
    whole, valid_share = trace.size * interval_m, share(sound[measured])
    return IndexOfSegment(start_m, whole, length, len(heights), index, valid_share)


def scallop_heights(
    trace: FloatArray, interval_m: float, rules: TraceRules = CALIFORNIA_RULES
) -> Iterator[float]:
    """Yield the rounded height in m of every scallop of one segment, those above the band first.

    A scallop is a stretch of successive values beyond one edge of the band; its height is that of
    its outermost value beyond the edge, its length the count of its values times the interval,
    compared with the least length to one part in 10⁹.
    """
    measured = trace[np.isfinite(trace)]
    if not measured.size:
        return
    centre = float(np.mean(measured))
    for side in (1.0, -1.0):
        beyond = side * (trace - centre) - rules.blanking_band_m / 2.0
        for area in list_areas(beyond):
            height = float(beyond[area.peak])
            length = (area.end - area.first) * interval_m
            if height >= rules.least_height_m and length >= rules.least_length_m * (1.0 - 1e-9):
                yield _round(height, rules.rounding_m)


def must_grind(
    trace: FloatArray,
    sound: BoolArray,
    interval_m: float,
    rules: TraceRules = CALIFORNIA_RULES,
    start_m: float = 0.0,
) -> tuple[MustGrind, ...]:
    """Return the areas of ``trace`` in m that must be ground, in order of position.

    A point belongs to one if ``trace`` is lower by more than ``bump_height_m`` at a point before it
    and at one behind it that are at most ``bump_length_m`` apart. Arguments as of
    `profile_indices`. Source: California Test 526, whose template is placed across the base of a
    bump.
    """
    span = max(round(rules.bump_length_m / interval_m), 2)
    height = grind_heights(trace, span, rules.bump_height_m)
    return tuple(
        MustGrind(
            start_m + area.first * interval_m,
            start_m + (area.end - 1) * interval_m,
            start_m + area.peak * interval_m,
            float(height[area.peak]),
            share(sound[area.first : area.end]),
        )
        for area in list_areas(height, rules.bump_height_m)
    )


def grind_heights(trace: FloatArray, span: int, limit: float) -> FloatArray:
    """Return how far each value lies above its base where that is above ``limit``, else 0.

    The height, in the unit of ``trace``, is t_k − min over m of max(lowest of t_{k−m} … t_k,
    lowest of t_k … t_{k+span−m}), m from 0 to ``span``: both ends of the base are at most ``span``
    values apart. NaN counts for nothing.
    """
    heights = np.zeros(trace.size)
    for at in range(0, trace.size, CHUNK):
        low, end = max(at - span, 0), min(at + CHUNK, trace.size)
        part = _grind_heights(trace[low : end + span], span, limit)[at - low : end - low]
        # Zeros that are never written take no memory.
        high = np.flatnonzero(part)
        heights[at + high] = part[high]
    return heights


def _grind_heights(trace: FloatArray, span: int, limit: float) -> FloatArray:
    """Return what `grind_heights` does, of the values that have ``span`` others on both sides."""
    from floatref.measures.ride.bump_template import heights_above_base

    known = np.where(np.isfinite(trace), trace, np.inf)
    ahead, behind = _lowest_ahead(known, span), _lowest_ahead(known[::-1], span)[::-1]
    # No base is lower than the higher of the lowest values on both sides.
    possible = np.isfinite(trace) & (known - limit > np.maximum(ahead, behind))
    heights = np.zeros(trace.size)
    heights_above_base(known, np.flatnonzero(possible), limit, np.empty(span + 1), heights)
    return heights


def _lowest_ahead(values: FloatArray, span: int) -> FloatArray:
    """Return the lowest of each value and the ``span`` that follow it, of those there are."""
    count, width = span + 1, 1
    lowest = np.concatenate((values, np.full(span, np.inf)))
    while 2 * width <= count:
        lowest[:-width] = np.minimum(lowest[:-width], lowest[width:])
        width *= 2
    rest = count - width
    return np.asarray(np.minimum(lowest[: values.size], lowest[rest : rest + values.size]))


def _round(height: float, step: float) -> float:
    """Return the multiple of ``step`` next to ``height``, halves upwards; 0 does not round."""
    return float(np.floor(height / step + 0.5)) * step if step else height
