"""Features of a probe with an event: errors, flags and shape near it and elsewhere."""

from collections.abc import Iterator

import numpy as np

from floatref.values.arrays import BoolArray, FloatArray
from floatref_conformance.resemblance.band_fits import find_lag, root_mean_square, waves_of
from floatref_conformance.resemblance.compared_path import STEP_M, ComparedPath
from floatref_conformance.resemblance.road_features import Feature

NEAR_M, FAR_M = 12.0, 40.0
"""An error at an event lies within the first, and errors elsewhere beyond the second, in m."""
SHORT_M = (0.5, 6.0)
"""Waves of a road that a straight line lacks, in m."""
STRAIGHT_M = 1e-9
"""Second differences below this, in m, are those of a straight line."""


def list_event(path: ComparedPath, places_m: tuple[float, ...]) -> Iterator[Feature]:
    """Yield errors in m near the places and elsewhere, flags, and what of the road is there."""
    near, middle = (
        path.near(places_m, NEAR_M),
        path.near(places_m, 2.5 * NEAR_M) & ~path.near(places_m, NEAR_M),
    )
    far = ~path.near(places_m, FAR_M)
    for name, where in (("near", near), ("beside", middle), ("away", far)):
        if where.sum() > 2:
            yield f"error {name}", _spread(path.error, where), 0.001
            yield f"flagged {name}", float(path.flagged[where].mean()), 0.1
    reached = path.near(places_m, FAR_M) & (path.flagged < 0.5)
    yield "error of valid", _spread(path.error, reached), 0.001
    yield "step", _step(path, places_m), 0.002
    yield "short waves", _short_waves(path, path.near(places_m, 2 * NEAR_M)), 0.1
    yield "straight", _straight(path), 0.1
    yield "lag behind", _lag_behind(path, places_m), 0.05


def list_flags(path: ComparedPath, places_m: tuple[float, ...]) -> Iterator[Feature]:
    """Yield what is flagged and how large the error is at each place by itself."""
    for number, place in enumerate(places_m, 1):
        here = path.near((place,), NEAR_M / 2)
        yield f"flagged at {number}", float(path.flagged[here].mean()), 0.1
        yield f"error at {number}", _spread(path.error, here), 0.001


def _spread(error: FloatArray, where: BoolArray) -> float:
    """Return the rms of the errors in m, without their mean."""
    return float(np.std(error[where])) if where.any() else 0.0


def _step(path: ComparedPath, places_m: tuple[float, ...]) -> float:
    """Return by how much the error is higher behind the last place than before it, in m."""
    place = places_m[-1]
    before = (path.distance_m < place - 1.0) & (path.distance_m > place - 6.0)
    behind = (path.distance_m > place + 1.0) & (path.distance_m < place + 6.0)
    if not (before.any() and behind.any()):
        return 0.0
    return float(path.error[behind].mean() - path.error[before].mean())


def _short_waves(path: ComparedPath, near: BoolArray) -> float:
    """Return the logarithm of delivered over true rms of short waves near the event."""
    inside = slice(int(np.argmax(near)), int(near.size - np.argmax(near[::-1])))
    found, true = (root_mean_square(waves_of(z[inside], SHORT_M)) for z in (path.found, path.truth))
    return float(np.log(max(found, 1e-6) / max(true, 1e-6)))


def _straight(path: ComparedPath) -> float:
    """Return the length in m of straight lines in the delivered points."""
    bends = np.abs(np.diff(path.fine, 2))
    scale = max(float(np.nanmax(np.abs(path.fine), initial=0.0)), 1.0)
    return float(np.sum(bends <= STRAIGHT_M * scale) * path.fine_m)


def _lag_behind(path: ComparedPath, places_m: tuple[float, ...]) -> float:
    """Return by how much the lag behind the last event is larger than before it, in m."""
    at = int(np.searchsorted(path.distance_m, places_m[-1]))
    reach, apart = round(35.0 / STEP_M), round(4.0 / STEP_M)
    before, behind = (
        slice(max(at - apart - reach, 0), max(at - apart, 0)),
        slice(at + apart, at + apart + reach),
    )
    if min(path.truth[part].size for part in (before, behind)) < reach // 2:
        return 0.0
    lags = [find_lag(path.found[part], path.truth[part], 1.0) for part in (before, behind)]
    return lags[1] - lags[0]
