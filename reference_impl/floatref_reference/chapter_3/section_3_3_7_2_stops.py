"""3.3.7.2 Effects on Short-Interval Roughness Profiles: what a stop contaminates (Table 3.10)."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from floatref_reference.chapter_2.section_2_1_3_roughness_profiles import BASE_LENGTH
from floatref_reference.signals import Real, samples


class Contamination(NamedTuple):
    """What a stop contaminated, places counted from the stop and positive past it.

    Args:
        peak: greatest rise of the short-interval roughness, m/km.
        upstream: first contaminated place, m; negative or zero.
        downstream: last contaminated place, m.
    """

    peak: np.longdouble
    upstream: np.longdouble
    downstream: np.longdouble


class Row(NamedTuple):
    """A row of Table 3.10.

    Args:
        profiler: number of the profiler.
        side: "left" or "right".
        passes: number of passes.
        lowest: lowest peak localized roughness, m/km.
        highest: highest, m/km.
        upstream: farthest contaminated place before the stop, m.
        downstream: farthest past it, m.
    """

    profiler: int
    side: str
    passes: int
    lowest: float
    highest: float
    upstream: float
    downstream: float


TABLE_3_10 = (
    Row(1, "left", 14, 9, 20, -13.5, 23.5),
    Row(1, "right", 14, 6, 10, -13.3, 41.9),
    Row(2, "left", 12, 48, 99, -14.1, 48.7),
    Row(2, "right", 12, 0, 35, -10.4, 37.4),
    Row(3, "left", 13, 0, 3, -10.0, 29.2),
    Row(3, "right", 13, 0.5, 3, -18.1, 28.2),
    Row(4, "left", 13, 103, 651, -23.9, 52.1),
    Row(4, "right", 13, 64, 584, -14.1, 47.7),
    Row(5, "left", 13, 425, 2698, -46.3, 75.6),
    Row(5, "right", 13, 163, 4050, -47.3, 74.6),
    Row(6, "right", 12, 30, 159, -22.6, 46.6),
)
"""Table 3.10. Profiler 6 did not measure the left wheel path."""


def contaminated(
    delta: npt.ArrayLike, dx: float, stop: Real, threshold: float, base: float = BASE_LENGTH
) -> Contamination:
    """Find the length around a stop over which the roughness profile is wrong.

    Equation:
        Section 3.3.7.2, figure 3.26: from where the pass with a stop "departs" from that at
        constant speed until "they begin to agree again". They agree where the change is within the
        threshold for one base length, looked for from the stop to either side.

    Args:
        delta: change of the short-interval roughness, m/km, shape (N,).
        dx: constant interval Δx, m.
        stop: place of the stop, m from the first sample.
        threshold: largest change that is agreement, m/km; print has no figure for it.
        base: base length of the roughness profile, m.

    Returns:
        Peak and both ends; zeros if the profiles agree around the stop.
    """
    d_k, n = samples(delta), round(base / dx)
    middle = round(float(stop) / dx)
    first, last = _reach(d_k, middle, -1, n, threshold), _reach(d_k, middle, 1, n, threshold)
    peak = max(max(d_k[first : last + 1]), np.longdouble(0))
    up, down = (np.longdouble((k - middle) * dx) for k in (first, last))
    return Contamination(peak, up, down)


def _reach(d_k: list[np.longdouble], k: int, step: int, n: int, threshold: float) -> int:
    """Return the last sample that differs before n samples in a row agree."""
    reached, agreeing = k, 0
    while 0 <= k < len(d_k) and agreeing < n:
        agreeing = 0 if abs(d_k[k]) > threshold else agreeing + 1
        reached = reached if agreeing else k
        k += step
    return reached


def widest(profiler: int, side: str, passes: Sequence[Contamination]) -> Row:
    """Summarize the passes of a profiler with a stop.

    Equation:
        Table 3.10: range of the peaks, and the farthest places to either side.

    Args:
        profiler: its number.
        side: "left" or "right".
        passes: what each pass contaminated, at least one.

    Returns:
        The row.
    """
    peaks = [float(p.peak) for p in passes]
    upstream = min(float(p.upstream) for p in passes)
    downstream = max(float(p.downstream) for p in passes)
    return Row(profiler, side, len(passes), min(peaks), max(peaks), upstream, downstream)
