"""One wheel path of the reference and of a run, and what a run's errors have done to it undone."""

import math
from dataclasses import dataclass, replace

import numpy as np

from floatref.errors import InputError
from floatref.measures import agreement
from floatref.measures.locating.lags import Line
from floatref.measures.locating.placing import MAX_OFFSET_M
from floatref.values.arrays import BoolArray, FloatArray
from floatref.values.profile import Profile

MARGIN_M = 5.0
"""Beyond both ends, a profile is continued so far before it is smoothed."""


@dataclass(frozen=True, eq=False)
class Compared:
    """Elevation in m of the reference and of the run on the reference's points, shape (n,)."""

    interval_m: float
    reference: FloatArray
    run: FloatArray

    def correlation(self) -> float:
        """Return the cross correlation as `floatref compare` gives it, NaN if it is undefined."""
        try:
            return agreement(
                self.reference, self.run, self.interval_m, "iri", MAX_OFFSET_M
            ).cross_correlation
        except InputError:
            return math.nan

    def scale(self, gain: float) -> "Compared":
        """Return it with the run's heights divided by ``gain``."""
        return replace(self, run=self.run / gain)

    def without(self, points: BoolArray) -> "Compared":
        """Return it with ``points`` bridged in both."""
        z = [np.where(points, np.nan, v) for v in (self.reference, self.run)]
        return Compared(self.interval_m, *z)

    def scale_waves(self, smoothing_m2: float) -> "Compared":
        """Return it with the one that has more of the short waves smoothed like the other.

        Its waves are taken times exp(-|c|·k²), with c in m² and k in cycles per m.
        """
        rougher = self.run if smoothing_m2 > 0 else self.reference
        smooth = _smooth(rougher, self.interval_m, abs(smoothing_m2))
        if smoothing_m2 > 0:
            return replace(self, run=smooth)
        return replace(self, reference=smooth)


def compare_track(
    reference: Profile, run: Profile, track: str, line: Line | None = None
) -> Compared:
    """Return ``track`` of both on the reference's points, the run laid by ``line``.

    Linearly between the run's points, as `floatref compare` does; NaN beyond and next to missing
    ones. Without a line, distances are taken as they are.
    """
    at = reference.distance_m
    places = at if line is None else line.run_at(at)
    z = np.interp(places, run.distance_m, run.track(track).elevation, np.nan, np.nan)
    return Compared(reference.interval_m, reference.track(track).elevation, z)


def find_unusable(reference: Profile, run: Profile, track: str, line: Line) -> BoolArray:
    """Return the reference's points at which the run, laid by ``line``, has no valid elevation.

    What lies beyond its ends is not among them.
    """
    places = line.run_at(reference.distance_m)
    valid = run.track(track).valid.astype(np.float64)
    return np.asarray(np.interp(places, run.distance_m, valid, 1.0, 1.0) < 0.999)


def _smooth(z: FloatArray, interval_m: float, amount_m2: float) -> FloatArray:
    """Return ``z`` with every wave times exp(-amount·k²); NaN where it is NaN."""
    known = np.isfinite(z)
    if not known.any():
        return z
    points = np.arange(z.size)
    margin = min(math.ceil(MARGIN_M / interval_m), z.size - 1)
    whole = np.interp(points, points[known], z[known])
    padded = np.pad(whole, margin, mode="reflect", reflect_type="odd")
    ramp = np.linspace(padded[0], padded[-1], padded.size)
    spectrum = np.fft.rfft(padded - ramp)
    k = np.fft.rfftfreq(padded.size, interval_m)
    smooth = np.fft.irfft(spectrum * np.exp(-amount_m2 * np.square(k)), padded.size) + ramp
    return np.where(known, smooth[margin : margin + z.size], np.nan)
