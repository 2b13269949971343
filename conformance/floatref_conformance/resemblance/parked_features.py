"""Features of a probe of a parked vehicle: the motion of its body, and the plate."""

from collections.abc import Iterator

import numpy as np

from floatref_conformance.resemblance.band_fits import (
    find_lag,
    fit_real,
    root_mean_square,
    slope_of,
    waves_of,
)
from floatref_conformance.resemblance.compared_path import ComparedPath
from floatref_conformance.resemblance.road_features import Feature

BOUNCED_M = (190.0, 340.0)
"""Where the body is pushed at 20 m/s, in m, and the ground on both sides."""
BAND_M = (3.0, 40.0)
CALM_M = (120.0, 430.0)
PLATE_M = (440.0, 545.0)


def list_parked(path: ComparedPath) -> Iterator[Feature]:
    """Yield what is in the flat profile, and height and place of the plate."""
    calm = path.error[_inside(path, CALM_M)]
    if calm.size < 100:
        return
    for number, band in enumerate(((0.5, 3.0), (3.0, 12.0), (12.0, 60.0))):
        yield f"unrest {number}", root_mean_square(waves_of(calm, band)), 2e-5
    where = _inside(path, PLATE_M)
    truth, found = path.truth[where], path.found[where]
    if truth.size < 100:
        return
    band = (0.5, 12.0)
    lag = find_lag(found, truth, 2.0)
    factors, _ = fit_real(waves_of(found, band, lag), (waves_of(truth, band),))
    yield "plate", float(factors[0]) - 1.0, 0.02
    yield "plate late", lag, 0.02


def list_bounce(path: ComparedPath) -> Iterator[Feature]:
    """Yield which share of the body's motion is in the error, its delay in s, and what is left."""
    where = _inside(path, BOUNCED_M)
    body, error = path.body[where], path.error[where]
    if body.size < 100:
        return
    speed = max(float(np.median(path.speed_mps)), 0.1)
    waves = [waves_of(body, BAND_M), waves_of(speed * slope_of(body), BAND_M)]
    factors, left = fit_real(waves_of(error, BAND_M), waves)
    yield "motion", float(factors[0]), 0.001
    yield "motion rate", float(factors[1]), 0.0001
    yield "strange", left / max(root_mean_square(waves[0]), 1e-5), 0.004


def _inside(path: ComparedPath, span_m: tuple[float, float]) -> slice:
    """Return the points between two distances in m."""
    first, last = np.searchsorted(path.distance_m, span_m)
    return slice(int(first), int(last))
