"""Agreement of two signals: cross correlation over a range of offsets (2.1.5.1).

Mean and standard deviation are those of the overlap at each offset, so a shifted copy of a
signal scores 1 for any values beyond the overlap.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from floatref.errors import InputError
from floatref.measures.roughness.gaps import check_heights
from floatref.values.arrays import BoolArray, FloatArray, release
from floatref.values.profile import Profile, ProfileTrack
from floatref.values.scanning import CHUNK, chunks


@dataclass(frozen=True)
class Agreement:
    """Agreement score, its two factors, and the offset in m at which they were found.

    ``cross_correlation`` is ``correlation`` · ``amplitude_factor`` (2.16); ``offset_m`` is above
    zero where the second signal lies farther along.
    """

    cross_correlation: float
    correlation: float
    amplitude_factor: float
    offset_m: float


SAME_CORRELATION = 1e-12
"""Correlations that differ by less are equal: they do by rounding."""


class _Overlap(NamedTuple):
    """Correlation (2.14) and amplitude factor (2.15) at every lag from −L to L."""

    correlation: FloatArray
    amplitude_factor: FloatArray


def cross_correlation(
    p: FloatArray, q: FloatArray, interval_m: float, max_offset_m: float = 1.0
) -> Agreement:
    """Return the agreement of ``q`` with ``p``, filtered signals on the same points.

    The offset is the one of highest correlation within ±``max_offset_m``, the nearest to zero
    of equals. A signal that is constant has no shape: its correlation is 0. Raises InputError
    for signals of unequal length, with NaN, or shorter than four times the largest offset.
    Source: (2.12) to (2.16), (2.14) with the factor 1/N that it needs.
    """
    p, q = _check_signals(p, q)
    if not 0.0 <= max_offset_m < math.inf:
        raise InputError(f"the largest offset is {max_offset_m} m; give 0 m or more")
    # A grid of 5.08 mm must reach 1.016 m as its 200th lag, whatever the rounding.
    largest = math.floor(min(max_offset_m, p.size * interval_m) / interval_m + 1e-9)
    if p.size < max(4 * largest, 2):
        raise InputError(
            f"{p.size * interval_m:g} m of signal are too short for offsets of up to "
            f"{max_offset_m:g} m; it takes four times as much"
        )
    overlap = _correlate(p, q, largest)
    lags = np.arange(-largest, largest + 1)
    tied = np.flatnonzero(overlap.correlation >= overlap.correlation.max() - SAME_CORRELATION)
    best = tied[np.argmin(np.abs(lags[tied]))]
    rho, gamma = float(overlap.correlation[best]), float(overlap.amplitude_factor[best])
    return Agreement(rho * gamma, rho, gamma, float(lags[best]) * interval_m)


def _check_signals(p: FloatArray, q: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return both signals as float64; InputError unless finite and of equal length."""
    p, q = np.asarray(p, dtype=np.float64), np.asarray(q, dtype=np.float64)
    if p.ndim != 1 or p.shape != q.shape:
        raise InputError(f"signals of shape {p.shape} and {q.shape}; cut them to the same points")
    if not (np.isfinite(p).all() and np.isfinite(q).all()):
        raise InputError("a signal holds NaN; bridge it or cut it away before correlating")
    return p, q


def _correlate(p: FloatArray, q: FloatArray, largest: int) -> _Overlap:
    """Return correlation and amplitude factor at lags −``largest`` to ``largest``."""
    p_mean, q_mean = float(p.mean()), float(q.mean())
    products = _lagged_products(p, q, (p_mean, q_mean), largest)
    counts = p.size - np.abs(np.arange(-largest, largest + 1))
    p_sums, p_squares = (_overlap_sums(p, p_mean, power, largest) for power in (1, 2))
    # Seen from q the same overlaps come in the opposite order of lags.
    q_sums, q_squares = (_overlap_sums(q, q_mean, power, largest)[::-1] for power in (1, 2))
    p_sigma = _sigma(p_sums, p_squares, counts, p)
    q_sigma = _sigma(q_sums, q_squares, counts, q)
    covariance = (products - p_sums * q_sums / counts) / counts
    shaped = (p_sigma > 0) & (q_sigma > 0)
    rho = np.divide(covariance, p_sigma * q_sigma, out=np.zeros(counts.size), where=shaped)
    low, high = np.minimum(p_sigma, q_sigma), np.maximum(p_sigma, q_sigma)
    gamma = np.divide(low, high, out=np.ones(counts.size), where=high > 0)
    return _Overlap(np.clip(rho, -1.0, 1.0), gamma)


def _lagged_products(
    p: FloatArray, q: FloatArray, means: tuple[float, float], largest: int
) -> FloatArray:
    """Return Σ p(k)·q(k + i) over the overlap for lags i from −``largest`` to ``largest``.

    Both are taken less their ``means``. A long signal goes in pieces of p with all points of q that
    they meet: the transforms then take no memory to speak of.
    """
    from scipy.fft import irfft, next_fast_len, rfft

    step = max(CHUNK, 2 * largest)
    size = next_fast_len(min(step, p.size) + 2 * largest, real=True)
    total = np.zeros(2 * largest + 1)
    for first in range(0, p.size, step):
        piece = p[first : first + step] - means[0]
        # Value 0 is q's point first − L; there is nothing beyond the ends of q.
        low, high = max(first - largest, 0), min(first + piece.size + largest, q.size)
        met = np.zeros(piece.size + 2 * largest)
        met[low - first + largest : high - first + largest] = q[low:high] - means[1]
        spectrum = np.conj(rfft(piece, size))
        spectrum *= rfft(met, size)
        total += irfft(spectrum, size)[: total.size]
    return total


def _overlap_sums(values: FloatArray, mean: float, power: int, largest: int) -> FloatArray:
    """Return, per lag i from −L to L, the sum of those k for which k + i is a point as well.

    Summed is the ``power`` of what ``values`` differ by from ``mean``.
    """
    total = sum(float(np.sum((part - mean) ** power)) for _, part in chunks(values))
    head = np.cumsum((values[:largest] - mean) ** power)
    tail = np.cumsum((values[::-1][:largest] - mean) ** power)
    return np.concatenate((total - head[::-1], [total], total - tail))


def _sigma(
    sums: FloatArray, squares: FloatArray, counts: np.ndarray, signal: FloatArray
) -> FloatArray:
    """Return the standard deviation on each overlap, 0 where it is rounding of ``signal``."""
    variance = squares / counts - np.square(sums / counts)
    rounding = np.square(1e-13 * max(float(signal.max()), -float(signal.min())))
    return np.asarray(np.sqrt(np.where(variance > rounding, variance, 0.0)))


SAME_POINT = 1e-6
"""Points nearer than this, in intervals, are the same point: start positions are rounded."""


def on_common_grid(reference: Profile, profile: Profile) -> tuple[Profile, Profile]:
    """Return both profiles on the reference's points within the stretch that both cover.

    ``profile`` is interpolated linearly in distance between its points, without any filter
    against aliasing; a point is NaN next to a missing one, and valid between two valid ones.
    1-σ is dropped from it. Raises InputError where the two overlap by less than two points, and
    for an elevation beyond 1000 km.
    """
    for track in (*reference.tracks, *profile.tracks):
        _check_heights(track)
    places = _Places.of(reference, profile)
    cut = places.inside(_size(reference), _size(profile))
    if cut.stop - cut.start < 2:
        raise InputError(
            f"the profiles do not overlap: the reference covers {_span(reference)}, "
            f"the profile {_span(profile)}"
        )
    start = reference.start_m + cut.start * reference.interval_m
    kept = tuple(_cut(track, cut) for track in reference.tracks)
    moved = tuple(_interpolate(track, places, cut) for track in profile.tracks)
    return (
        replace(reference, tracks=kept, start_m=start),
        replace(profile, tracks=moved, start_m=start, interval_m=reference.interval_m),
    )


def _check_heights(track: ProfileTrack) -> None:
    """Raise InputError naming ``track`` for an elevation that no road reaches."""
    try:
        check_heights(track.elevation)
    except InputError as error:
        raise InputError(f"track {track.name}: {error}") from error


def _size(profile: Profile) -> int:
    """Return the number of points."""
    return profile.tracks[0].elevation.size


def _span(profile: Profile) -> str:
    """Return the stretch of distance that ``profile`` covers, in words."""
    return f"{profile.start_m:g} to {profile.start_m + profile.length_m:g} m"


def _cut(track: ProfileTrack, stretch: slice) -> ProfileTrack:
    """Return the points of ``stretch`` of ``track``."""
    sigma = None if track.sigma is None else track.sigma[stretch]
    return ProfileTrack.of(track.name, track.elevation[stretch], track.valid[stretch], sigma)


class _Places(NamedTuple):
    """Where the points of a reference lie in a profile, in points of that: first + step k."""

    first: float
    step: float

    @classmethod
    def of(cls, reference: Profile, profile: Profile) -> "_Places":
        """Return the places of the points of ``reference`` in ``profile``."""
        first = (reference.start_m - profile.start_m) / profile.interval_m
        return cls(first, reference.interval_m / profile.interval_m)

    def at(self, begin: int, end: int) -> FloatArray:
        """Return the places of points from ``begin`` to before ``end``; same points are whole."""
        index = self.first + self.step * np.arange(begin, end, dtype=np.float64)
        nearest = np.rint(index)
        return np.where(np.abs(index - nearest) < SAME_POINT, nearest, index)

    def inside(self, count: int, size: int) -> slice:
        """Return which of ``count`` points lie from the first to the last of ``size`` points."""
        begin = self._next(-self.first / self.step, lambda place: place >= 0, count)
        last = (size - 1 - self.first) / self.step
        return slice(begin, self._next(last, lambda place: place > size - 1, count))

    def _next(self, near: float, met: Callable[[float], bool], count: int) -> int:
        """Return the first of ``count`` points, next to ``near``, whose place has ``met``."""
        guess = int(min(max(math.floor(near) - 2, 0), count))
        while guess < count and not met(float(self.at(guess, guess + 1)[0])):
            guess += 1
        return guess


def _interpolate(track: ProfileTrack, places: _Places, cut: slice) -> ProfileTrack:
    """Return ``track`` at the places of the points ``cut``; where all are its own, these."""
    begin = float(places.at(cut.start, cut.start + 1)[0])
    if places.step == 1.0 and begin.is_integer():
        same = slice(int(begin), int(begin) + cut.stop - cut.start)
        return ProfileTrack.of(track.name, track.elevation[same], track.valid[same])
    elevation = np.empty(cut.stop - cut.start)
    valid = np.empty(elevation.size, dtype=np.bool_)
    for first in range(0, elevation.size, CHUNK):
        inside = slice(first, min(first + CHUNK, elevation.size))
        at = places.at(cut.start + inside.start, cut.start + inside.stop)
        elevation[inside], valid[inside] = _at(track, at)
        release(track.elevation)
    return ProfileTrack.of(track.name, elevation, valid)


def _at(track: ProfileTrack, index: FloatArray) -> tuple[FloatArray, BoolArray]:
    """Return elevation and validity of ``track`` at the fractional points ``index``."""
    low = np.floor(index).astype(np.int64)
    fraction = index - low
    high = np.where(fraction > 0, low + 1, low)
    z = track.elevation
    elevation = np.where(fraction > 0, z[low] + fraction * (z[high] - z[low]), z[low])
    return elevation, track.valid[low] & track.valid[high]
