"""Features of a probe at constant speed: scale, lag, filter, axis, motion of the body, holds."""

from collections.abc import Iterator, Sequence

import numpy as np

from floatref_conformance.resemblance.band_fits import (
    find_lag,
    fit_complex,
    fit_real,
    root_mean_square,
    slope_of,
    waves_of,
)
from floatref_conformance.resemblance.compared_path import STEP_M, ComparedPath

Feature = tuple[str, float, float]
"""Name, value, and the smallest difference that counts, in the unit of the value."""
BANDS_M = ((0.8, 2.0), (2.0, 6.0), (6.0, 20.0), (20.0, 50.0), (50.0, 100.0))
GAIN_BAND_M, MOTION_BAND_M = (1.5, 12.0), (3.0, 30.0)
MOST_LAG_M, LONG_M = 2.0, 20.0
"""Largest lag that is searched, and the waves whose phase is that of filters, in m."""


def list_waves(path: ComparedPath) -> Iterator[Feature]:
    """Yield gain, phase and what is unexplained of waves of several lengths.

    Both are of the profile moved by its lag, which is a feature of its own.
    """
    lag = find_lag(path.found, path.truth, MOST_LAG_M)
    for number, band in enumerate(BANDS_M):
        # The phase of long waves is that of filters, and of the profile as it is.
        found = waves_of(path.found, band, 0.0 if band[0] >= LONG_M else lag)
        factor, left = fit_complex(found, waves_of(path.truth, band))
        yield f"gain {number}", factor.real - 1.0, 0.004
        yield f"phase {number}", factor.imag, 0.004
        yield f"left {number}", left, 0.02
    yield "lag", lag, 0.01
    yield "lag grows", _grow(path), 0.03
    turned, truth = (waves_of(z, (6.0, 50.0)) for z in (path.found[::-1], path.truth))
    backward, _ = fit_complex(turned, truth)
    yield "backward", abs(backward), 0.3


def _grow(path: ComparedPath) -> float:
    """Return by how much the lag of the last third is larger than that of the first, in m."""
    third = path.truth.size // 3
    first, last = (
        find_lag(path.found[part], path.truth[part], MOST_LAG_M)
        for part in (slice(0, third), slice(-third, None))
    )
    return last - first


def list_gain(path: ComparedPath) -> Iterator[Feature]:
    """Yield scale, lag in s, and what is unexplained of waves of middle length."""
    lag = find_lag(path.found, path.truth, MOST_LAG_M)
    found, truth = (path.found, GAIN_BAND_M, lag), (path.truth, GAIN_BAND_M)
    factor, left = fit_complex(waves_of(*found), waves_of(*truth))
    yield "gain", factor.real - 1.0, 0.004
    yield "left", left, 0.03
    yield "late", lag / max(float(np.median(path.speed_mps)), 0.1), 0.001


def list_motion(path: ComparedPath) -> Iterator[Feature]:
    """Yield which shares of road and body motion are in the error, and their delays in s."""
    speed = max(float(np.median(path.speed_mps)), 0.1)
    signals = (path.truth, speed * slope_of(path.truth), path.body, speed * slope_of(path.body))
    waves = [waves_of(signal, MOTION_BAND_M) for signal in signals]
    factors, left = fit_real(waves_of(path.error, MOTION_BAND_M), waves)
    for name, factor, least in zip(
        ("road", "road rate", "motion", "motion rate"),
        factors,
        (0.004, 0.0003, 0.004, 0.0003),
        strict=True,
    ):
        yield name, float(factor), least
    yield "strange", left / max(root_mean_square(waves[0]), root_mean_square(waves[2]), 1e-5), 0.02


def list_holds(path: ComparedPath) -> Iterator[Feature]:
    """Yield how often and how far the elevation stays the same from point to point."""
    same = np.diff(path.fine) == 0.0
    edges = np.flatnonzero(np.diff(np.concatenate(([0], same.astype(np.int8), [0]))))
    longest = int(np.max(edges[1::2] - edges[::2], initial=0))
    yield "same", float(same.mean()) if same.size else 0.0, 0.02
    yield "held", min(longest * path.fine_m, 5.0), 0.05
    yield "missing", float(path.missing.mean()), 0.01
    late = path.missing[-round(min(50.0, path.truth.size * STEP_M / 3) / STEP_M) :]
    yield "missing at the end", float(late.mean()), 0.02
    yield "flagged", float(path.flagged.mean()), 0.05


def list_pairs(paths: Sequence[ComparedPath]) -> Iterator[Feature]:
    """Yield which share of the other wheel path is in the first one."""
    if len(paths) == 2:
        band = (1.0, 8.0)
        one, other = paths
        difference = waves_of(other.truth - one.truth, band)
        factors, _ = fit_real(waves_of(one.error, band), (waves_of(one.truth, band), difference))
        yield "other path", float(factors[1]), 0.03
