"""What levelling leaves in the elevation: 1-σ of the high-passed road of a fit."""

import numpy as np
from scipy.sparse import csr_array, vstack

from floatref.estimators.road_slope.gauss_newton import Fit
from floatref.estimators.road_slope.rows import Stretch
from floatref.estimators.road_slope.sparse.elimination import Elimination
from floatref.estimators.road_slope.stretches import BRAKING_MPS2
from floatref.estimators.smoothing.sigma import REACH, high_pass
from floatref.values.arrays import FloatArray, IndexArray

KNOWN_M, APART_M, BESIDE_M = 2e-3, 8.0, 2.0
"""1-σ, from the smoother, of a second difference of the road over so much travel, so far from
where the vehicle brakes: its own 1-σ is there already."""
GAIN_DOUBT, TURN_DOUBT = 0.045, 1.0
"""A body is no half car: its gain is sure within this part, and for each rad by which the road
turns under a wheelbase within so much more."""
TOGETHER, GRADE_DOUBT = 8.0, 0.016
"""The 1-σ of the grade of the whole stretch, which ½gP² shows, is this number of times that of the
rows, and the second at most: rows that count as drawn one by one err together where a brake
ends."""


def elevation_sigma(fit: Fit, marks_m: FloatArray, wavelength_m: float) -> FloatArray:
    """Return 1-σ in m of the high-passed elevation at the places ``marks_m``, shape (m,).

    Beyond the stretch the road goes on with the slope of its end.
    """
    stretch, rows, n = fit.stretch, fit.rows(), marks_m.size
    weights = np.concatenate((_delivered(stretch, marks_m, wavelength_m), _doubted(stretch)))
    derivative = vstack([rows.derivative, _known_outside(stretch)], format="csr")
    plan = Elimination.of(derivative, stretch.order)
    covariance = plan.factor(derivative).covariance(weights)
    by_doubted = covariance[:n, n:] / np.diag(covariance)[n:]
    gain = np.hypot(GAIN_DOUBT, TURN_DOUBT * turn(fit)) * fit.of("gain")
    grade = min(TOGETHER * float(np.sqrt(covariance[-1, -1])), GRADE_DOUBT)
    doubted = np.square(by_doubted) @ np.square([gain, grade])
    return np.asarray(np.sqrt(np.diag(covariance)[:n] + doubted))


def _doubted(stretch: Stretch) -> FloatArray:
    """Return the weights of all unknowns in the gain and the mean slope, shape (2, unknowns)."""
    found = np.zeros((2, stretch.layout.size))
    found[0, stretch.layout.place("gain")] = 1.0
    found[1, stretch.layout.slope] = 1.0 / stretch.layout.points
    return found


def turn(fit: Fit) -> float:
    """Return τ: by how much the slope under the wheels changes in a wheelbase, where it brakes."""
    seen, places = fit.stretch.readings, fit.stretch.places
    beta = fit.stretch.slope @ fit.unknowns[fit.stretch.layout.elevation]
    active = _braking(fit.stretch)
    if active.size == 0:
        return 0.0
    place, first = np.unique(seen.place, return_index=True)
    behind = np.interp(seen.place[active] - places.wheelbase_m, place, beta[first])
    return float(np.sqrt(np.mean(np.square(beta[active] - behind))))


def _braking(stretch: Stretch) -> IndexArray:
    """Return the nodes at which the vehicle accelerates along the road."""
    return np.flatnonzero(np.abs(stretch.readings.along) > BRAKING_MPS2)


def _known_outside(stretch: Stretch) -> csr_array:
    """Return the rows of the road outside of the brake, as the smoother knows it."""
    lay, spacing = stretch.layout, stretch.model.spacing_m
    m = round(APART_M / spacing)
    x: FloatArray = stretch.first_m + spacing * np.arange(lay.points, dtype=np.float64)
    outside = _distance(x, stretch.readings.place[_braking(stretch)]) >= BESIDE_M
    middles = np.arange(m, lay.points - m)
    middles = middles[outside[middles - m] & outside[middles] & outside[middles + m]]
    columns = np.concatenate((middles - m, middles, middles + m))
    values = np.repeat([1.0, -2.0, 1.0], middles.size) / KNOWN_M
    rows = np.tile(np.arange(middles.size), 3)
    return csr_array((values, (rows, columns)), (middles.size, lay.size))


def _distance(x: FloatArray, places: FloatArray) -> FloatArray:
    """Return the distance of every ``x`` from the nearest of the rising ``places``, in m."""
    ends = np.concatenate(([-np.inf], places, [np.inf]))
    behind = np.searchsorted(places, x, "right")
    return np.asarray(np.minimum(x - ends[behind], ends[behind + 1] - x))


def _delivered(stretch: Stretch, marks_m: FloatArray, wavelength_m: float) -> FloatArray:
    """Return the weights of all unknowns in the high-passed elevation at ``marks_m``."""
    lay, spacing = stretch.layout, stretch.model.spacing_m
    beyond = int(np.ceil(REACH * wavelength_m / spacing))
    places: FloatArray = spacing * np.arange(-beyond, lay.points + beyond, dtype=np.float64)
    wanted = np.rint((marks_m - stretch.first_m) / spacing).astype(np.int64) + beyond
    wide = high_pass(places, wavelength_m, np.clip(wanted, 0, places.size - 1))
    found = np.zeros((marks_m.size, lay.size))
    found[:, lay.elevation] = wide[:, beyond:-beyond]
    away = spacing * np.arange(1, beyond + 1)
    sides = ((0, wide[:, beyond - 1 :: -1], -away), (lay.points - 1, wide[:, -beyond:], away))
    for end, weights, distance in sides:
        found[:, lay.elevation.start + end] += weights.sum(axis=1)
        found[:, lay.slope.start + end] += weights @ distance
    return found
