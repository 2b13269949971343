"""The floor of the driving checks: the profile contains a known bump, away from any event."""

import numpy as np

from floatref.values.arrays import FloatArray
from floatref_conformance.checks.scoring import Compared
from floatref_conformance.checks.verdict import Measurement
from floatref_conformance.classes import DeviceClass, Limits
from floatref_conformance.errors import DeviceError
from floatref_conformance.proving_ground.scenario import Scenario
from floatref_conformance.proving_ground.staging import BUMP_LENGTH_M

LIMITS: Limits = {DeviceClass.NOMINAL: 10.0, DeviceClass.ADEQUATE: 5.0, DeviceClass.REFERENCE: 2.0}
"""Largest error of the bump's height, in percent of it."""
BESIDE_M = 3.0
"""Length of the profile that is fitted on each side of the bump, in m."""
FARTHEST_M = 1.0
"""Largest displacement at which the bump is searched, in m; its place is not judged here."""


def measure_bump(compared: Compared, scenario: Scenario) -> Measurement:
    """Return the error of the bump's height, in percent of its true height.

    The result less the truth is fitted with the bump's shape, the truth's slope (a displacement),
    a level and a slope. Raises DeviceError for a point without elevation there.
    """
    height_m = scenario.bump_mm / 1000.0
    x = compared.distance_m - scenario.bump_at_m
    near = np.abs(x) <= BUMP_LENGTH_M / 2 + BESIDE_M
    result = compared.result[near]
    if np.isnan(result).any():
        raise DeviceError(
            f"track {compared.track}: points without elevation at the bump, "
            f"{scenario.bump_at_m:g} m, away from any event"
        )
    offset = _offset(compared, near)
    truth = np.interp(x[near] - offset, x, compared.truth)
    shape = _shape(x[near] - offset)
    columns = np.stack([shape, np.ones_like(shape), x[near]], axis=1)
    found = np.linalg.lstsq(columns, result - truth, rcond=None)[0][0]
    return Measurement(
        "bump error", compared.track, 100.0 * abs(float(found) / height_m), "%", LIMITS
    )


def _shape(x: FloatArray) -> FloatArray:
    """Return a raised cosine of height 1 around 0."""
    inside = np.abs(x) < BUMP_LENGTH_M / 2
    return np.where(inside, 0.5 + 0.5 * np.cos(2 * np.pi * x / BUMP_LENGTH_M), 0.0)


def _offset(compared: Compared, near: np.ndarray) -> float:
    """Return the forward displacement of the result relative to the truth, in m."""
    steps = int(FARTHEST_M / compared.interval_m)
    where = np.flatnonzero(near)
    first, last = max(where[0], steps), min(where[-1], compared.truth.size - 1 - steps)
    result = _level(compared.result[first : last + 1])
    lags = np.arange(-steps, steps + 1, max(1, steps // 100))
    errors = []
    for lag in lags:
        truth = _level(compared.truth[first - lag : last + 1 - lag])
        errors.append(float(np.sum((result - truth) ** 2)))
    return float(lags[int(np.argmin(errors))] * compared.interval_m)


def _level(elevation: FloatArray) -> FloatArray:
    """Return ``elevation`` without its mean and its slope."""
    place = np.arange(elevation.size) - (elevation.size - 1) / 2
    slope = float(np.dot(place, elevation) / np.dot(place, place))
    return np.asarray(elevation - elevation.mean() - slope * place)
