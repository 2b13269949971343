"""Slopes of a reference and of a run laid on it, as spectra of windows along the section."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from floatref.measures.locating.lags import Line
from floatref.measures.locating.slopes import usable_points
from floatref.values.arrays import BoolArray, FloatArray
from floatref.values.profile import ProfileTrack

Spectra = NDArray[np.complex128]

STEP_M = 0.1
"""Between the points at which both are taken, and the length over which they are averaged."""
MOST_MISSING = 0.5
"""A window with a larger share of missing points is left out."""


@dataclass(frozen=True, eq=False)
class Windows:
    """Spectra of slope, shape (windows, wave numbers), at wave numbers in cycles per m.

    ``at_m`` are the middles of the windows on the reference's axis, shape (windows,).
    """

    wave_number: FloatArray
    at_m: FloatArray
    reference: Spectra
    run: Spectra

    def within(self, longest_m: float, shortest_m: float) -> "Windows":
        """Return the waves between ``shortest_m`` and ``longest_m``."""
        k = self.wave_number
        chosen = (k >= 1.0 / longest_m) & (k <= 1.0 / shortest_m)
        return Windows(k[chosen], self.at_m, self.reference[:, chosen], self.run[:, chosen])


class Surface:
    """Elevation of one wheel path, between its points as well."""

    def __init__(self, track: ProfileTrack, start_m: float, interval_m: float) -> None:
        from scipy.interpolate import CubicSpline

        known = usable_points(track, interval_m)
        points = np.arange(known.size)
        z = np.interp(points, points[known], track.elevation[known])
        self._distance_m = start_m + interval_m * points
        self._known = known.astype(np.float64)
        self._integral = CubicSpline(self._distance_m, z - np.median(z)).antiderivative()

    def slope(self, line: Line, at_m: FloatArray) -> tuple[FloatArray, BoolArray]:
        """Return the slope at ``at_m`` of the reference, 0 where it is not measured, and where.

        It is the difference of averages over `STEP_M` to both sides, the same for any interval.
        """
        places = [line.run_at(at_m + step) for step in (-STEP_M, 0.0, STEP_M)]
        known = (
            self._is_measured(places[0])
            & self._is_measured(places[1])
            & self._is_measured(places[2])
        )
        areas = [np.asarray(self._integral(p)) for p in places]
        slope = (areas[2] - 2.0 * areas[1] + areas[0]) / (line.scale * STEP_M**2)
        return np.where(known, slope, 0.0), known

    def _is_measured(self, places: FloatArray) -> BoolArray:
        """Return which ``places`` lie between measured points."""
        return np.asarray(np.interp(places, self._distance_m, self._known, 0.0, 0.0) > 0.999)


def windows_of(
    reference: Surface, run: Surface, line: Line, stretch_m: tuple[float, float], length_m: float
) -> Windows:
    """Return the spectra of windows of ``length_m`` of ``stretch_m``, half over each other.

    Windows are Hann's, each freed of its straight line. What is missing in one of the two is left
    out of both.
    """
    at = np.arange(stretch_m[0] + STEP_M, stretch_m[1] - STEP_M, STEP_M)
    p, p_known = reference.slope(Line(0.0, 0.0, 1.0), at)
    q, q_known = run.slope(line, at)
    size = round(length_m / STEP_M)
    starts = np.arange(0, max(at.size - size + 1, 0), size // 2)
    cut = starts[:, None] + np.arange(size)
    known = (p_known & q_known)[cut]
    kept = known.mean(axis=1) >= 1.0 - MOST_MISSING
    cut, known = cut[kept], known[kept]
    shape = np.hanning(size + 1)[:size]
    spectra = [np.fft.rfft(_level(v[cut] * known) * known * shape, axis=1) for v in (p, q)]
    wave_number = np.fft.rfftfreq(size, STEP_M).astype(np.float64)
    return Windows(wave_number, at[cut].mean(axis=1), *spectra)


def _level(rows: FloatArray) -> FloatArray:
    """Return every row less the straight line through it."""
    ramp = np.linspace(-1.0, 1.0, rows.shape[1])
    slants = rows @ ramp / (ramp @ ramp)
    return np.asarray(rows - rows.mean(axis=1, keepdims=True) - slants[:, None] * ramp)
