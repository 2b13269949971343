"""Agreement of two signals: cross correlation over a range of offsets (2.1.5.1).

Mean and standard deviation are those of the overlap at each offset, so a shifted copy of a
signal scores 1 for any values beyond the overlap.
"""

import math
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from floatref.errors import InputError
from floatref.measures.roughness.gaps import check_heights
from floatref.values.arrays import BoolArray, FloatArray
from floatref.values.profile import Profile, ProfileTrack


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
    tied = np.flatnonzero(overlap.correlation == overlap.correlation.max())
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
    p_centred, q_centred = p - p.mean(), q - q.mean()
    products = _lagged_products(p_centred, q_centred, largest)
    counts = p.size - np.abs(np.arange(-largest, largest + 1))
    p_sums, p_squares = (_overlap_sums(v, largest) for v in (p_centred, np.square(p_centred)))
    # Seen from q the same overlaps come in the opposite order of lags.
    q_sums, q_squares = (_overlap_sums(v, largest)[::-1] for v in (q_centred, np.square(q_centred)))
    p_sigma = _sigma(p_sums, p_squares, counts, p)
    q_sigma = _sigma(q_sums, q_squares, counts, q)
    covariance = (products - p_sums * q_sums / counts) / counts
    shaped = (p_sigma > 0) & (q_sigma > 0)
    rho = np.divide(covariance, p_sigma * q_sigma, out=np.zeros(counts.size), where=shaped)
    low, high = np.minimum(p_sigma, q_sigma), np.maximum(p_sigma, q_sigma)
    gamma = np.divide(low, high, out=np.ones(counts.size), where=high > 0)
    return _Overlap(np.clip(rho, -1.0, 1.0), gamma)


def _lagged_products(p: FloatArray, q: FloatArray, largest: int) -> FloatArray:
    """Return Σ p(k)·q(k + i) over the overlap for lags i from −``largest`` to ``largest``.

    The transform is only ``largest`` points longer than the signals: the wrapped part falls on lags
    that are not needed.
    """
    from scipy.fft import irfft, next_fast_len, rfft

    size = next_fast_len(p.size + largest, real=True)
    spectrum = np.conj(rfft(p, size))
    spectrum *= rfft(q, size)
    circular = irfft(spectrum, size)
    return np.concatenate((circular[circular.size - largest :], circular[: largest + 1]))


def _overlap_sums(values: FloatArray, largest: int) -> FloatArray:
    """Return, per lag i from −L to L, the sum of those k for which k + i is a point as well."""
    total = values.sum()
    head = np.cumsum(values[:largest])
    tail = np.cumsum(values[::-1][:largest])
    return np.concatenate((total - head[::-1], [total], total - tail))


def _sigma(
    sums: FloatArray, squares: FloatArray, counts: np.ndarray, signal: FloatArray
) -> FloatArray:
    """Return the standard deviation on each overlap, 0 where it is rounding of ``signal``."""
    variance = squares / counts - np.square(sums / counts)
    rounding = np.square(1e-13 * np.abs(signal).max())
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
    step = reference.interval_m / profile.interval_m
    first = (reference.start_m - profile.start_m) / profile.interval_m
    index = first + step * np.arange(_size(reference), dtype=np.float64)
    nearest = np.rint(index)
    same = np.abs(index - nearest) < SAME_POINT
    index[same] = nearest[same]
    inside = np.flatnonzero((index >= 0) & (index <= _size(profile) - 1))
    if inside.size < 2:
        raise InputError(
            f"the profiles do not overlap: the reference covers {_span(reference)}, "
            f"the profile {_span(profile)}"
        )
    cut = slice(int(inside[0]), int(inside[-1]) + 1)
    start = reference.start_m + cut.start * reference.interval_m
    kept = tuple(_cut(track, cut) for track in reference.tracks)
    moved = tuple(_interpolate(track, index[cut]) for track in profile.tracks)
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


def _interpolate(track: ProfileTrack, index: FloatArray) -> ProfileTrack:
    """Return ``track`` at the fractional points ``index``."""
    low = np.floor(index).astype(np.int64)
    fraction = index - low
    high = np.where(fraction > 0, low + 1, low)
    z = track.elevation
    elevation = np.where(fraction > 0, z[low] + fraction * (z[high] - z[low]), z[low])
    return ProfileTrack.of(track.name, elevation, _both(track.valid, low, high))


def _both(valid: BoolArray, low: NDArray[np.int64], high: NDArray[np.int64]) -> BoolArray:
    """Return where both neighbours are valid."""
    return np.asarray(valid[low] & valid[high])
