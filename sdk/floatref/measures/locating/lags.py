"""The lag of a run along the section: a straight line, followed from where the two agree."""

import math
from dataclasses import dataclass

import numpy as np

from floatref.measures.locating.slopes import STEP_M, Slope
from floatref.values.arrays import BoolArray, FloatArray

WINDOW_M = 10.0
SEARCH_M = 1.0
"""Largest distance from the line at which lags are searched."""
AGREES = 0.5
"""Least correlation of a window whose lag is used."""
STARTS_M = 100.0
"""The line is followed from so far around the place where it is known."""


@dataclass(frozen=True)
class Line:
    """``at_m`` of the reference lies at ``run_m`` of the run, ``scale`` times as long."""

    at_m: float
    run_m: float
    scale: float

    def run_at(self, distance_m: FloatArray) -> FloatArray:
        """Return where ``distance_m`` of the reference lies in the run, in m."""
        return self.run_m + self.scale * (distance_m - self.at_m)

    def lag_at(self, distance_m: float) -> float:
        """Return by how much the run lies farther along at ``distance_m``, in m."""
        return self.run_m + self.scale * (distance_m - self.at_m) - distance_m


@dataclass(frozen=True, eq=False)
class Lags:
    """Lag in m beyond a line, and the correlation there, of every window; all of shape (n,)."""

    at_m: FloatArray
    lag_m: FloatArray
    correlation: FloatArray


def follow_line(reference: Slope, run: Slope, line: Line, sign: float = 1.0) -> Line:
    """Return ``line`` corrected until it fits all of the section that the run covers.

    ``sign`` is -1 for heights upside down.
    """
    reach, length = STARTS_M, reference.end_m - reference.start_m
    while True:
        for _ in range(2):
            line = _correct_line(line, window_lags(reference, run, line, sign), reach)
        if reach > length:
            return line
        reach *= 2.0


def window_lags(reference: Slope, run: Slope, line: Line, sign: float = 1.0) -> Lags:
    """Return the lags beyond ``line`` of windows of `WINDOW_M` of the section."""
    per_window = round(WINDOW_M / STEP_M)
    count = max(reference.values.size // per_window, 1)
    points = min(count * per_window, reference.values.size)
    at = reference.distance_m[:points]
    shifts = np.arange(-SEARCH_M, SEARCH_M + 0.5 * STEP_M, STEP_M)
    places = line.run_at(at) + shifts[:, None]
    q = sign * np.interp(places.ravel(), run.distance_m, run.values, 0.0, 0.0).reshape(places.shape)
    scores = _window_scores(reference.values[:points], q, count)
    lags, best = _peaks(scores, shifts)
    middles = at.reshape(count, -1).mean(axis=1)
    return Lags(middles, lags, best)


def _window_scores(p: FloatArray, q: FloatArray, count: int) -> FloatArray:
    """Return the correlation of every window at every shift, shape (shifts, count)."""
    shape = (q.shape[0], count, -1)
    products = (q * p).reshape(shape).sum(axis=2)
    energies = np.square(q).reshape(shape).sum(axis=2) * np.square(p).reshape(count, -1).sum(axis=1)
    shaped = energies > 0
    roots = np.sqrt(np.where(shaped, energies, 1.0))
    return np.asarray(np.where(shaped, products / roots, 0.0))


def _peaks(scores: FloatArray, shifts: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return the shift of the highest score of every window, by a parabola, and that score."""
    # Of equal peaks of a periodic road the nearest to the line counts.
    nearest = scores * (1.0 - 0.05 * np.abs(shifts))[:, None]
    top = np.clip(np.argmax(nearest, axis=0), 1, shifts.size - 2)
    windows = np.arange(scores.shape[1])
    before, here, after = (scores[top + d, windows] for d in (-1, 0, 1))
    bend = before - 2.0 * here + after
    slanted = np.where(bend < 0, 0.5 * (before - after) / np.where(bend < 0, bend, 1.0), 0.0)
    return shifts[top] + STEP_M * np.clip(slanted, -1.0, 1.0), here


def _correct_line(line: Line, lags: Lags, reach_m: float) -> Line:
    """Return ``line`` plus the straight line through the lags within ``reach_m`` of its middle."""
    used = (np.abs(lags.at_m - line.at_m) <= reach_m) & (lags.correlation >= AGREES)
    if np.count_nonzero(used) < 3:
        return line
    at, lag = lags.at_m - line.at_m, lags.lag_m
    for _ in range(3):
        slope, shift = np.polyfit(at[used], lag[used], 1)
        used = _within(lag - shift - slope * at, used)
        if np.count_nonzero(used) < 3:
            break
    return Line(line.at_m, line.run_m + float(shift), line.scale + float(slope))


def _within(rest: FloatArray, used: BoolArray) -> BoolArray:
    """Return the windows in ``used`` whose ``rest`` is no outlier."""
    spread = max(1.4826 * float(np.median(np.abs(rest[used]))), 0.02)
    return used & (np.abs(rest) <= 3.0 * spread)


def gain(reference: Slope, run: Slope, line: Line, sign: float = 1.0) -> float:
    """Return the slope of the regression of ``run`` on ``reference``, one being laid on the other.

    Windows that disagree are left out. NaN if no window agrees.
    """
    agreeing = window_lags(reference, run, line, sign).correlation >= AGREES
    counted = np.zeros(reference.values.size, dtype=np.bool_)
    per_window = np.repeat(agreeing, round(WINDOW_M / STEP_M))[: counted.size]
    counted[: per_window.size] = per_window
    p, q = _in_common(reference, run, line, counted)
    energy = float(np.square(p).sum())
    return float((p * q).sum()) / energy if energy > 0 else math.nan


def common_score(reference: Slope, run: Slope, line: Line, whole_m: float) -> float:
    """Return the correlation over all points that both measured, ``run`` laid along ``line``.

    It is below zero for heights upside down. What is shorter than ``whole_m`` counts by the root
    of its share of that, as in `score_places`: over a few metres chance reaches any correlation.
    """
    p, q = _in_common(reference, run, line, reference.measured)
    energy = float(np.square(p).sum() * np.square(q).sum())
    share = min(STEP_M * p.size / whole_m, 1.0)
    return math.sqrt(share / energy) * float((p * q).sum()) if energy > 0 else 0.0


def _in_common(
    reference: Slope, run: Slope, line: Line, counted: BoolArray
) -> tuple[FloatArray, FloatArray]:
    """Return both slopes where ``reference`` is ``counted`` and ``run`` has measured."""
    places = line.run_at(reference.distance_m[counted])
    known = np.interp(places, run.distance_m, run.measured.astype(np.float64), 0.0, 0.0) > 0.999
    q = np.interp(places, run.distance_m, run.values, 0.0, 0.0)[known]
    return reference.values[counted][known], q
