"""Gauss–Newton over a stretch: the unknowns of least squares, and their covariance."""

from typing import Any, NamedTuple

import numpy as np

from floatref.estimators.road_slope.bends import first_bends, renew_bends
from floatref.estimators.road_slope.rows import Rows, Stretch
from floatref.estimators.smoothing.sigma import REACH, high_pass
from floatref.values.arrays import FloatArray

PASSES, FEWEST, HALVINGS = 12, 4, 5
SETTLED_RAD = 3e-4
"""Change of all pitches by a pass below which it was the last."""
ALLOWED, MORE = 1.001, 1.0
"""The sum of squares may grow so much by a step: it is next to flat where it ends."""
RANGES = {
    "gain": (0.0005, 0.02),
    "centre": (-0.1, 1.1),
    "log_hz": (float(np.log(0.7)), float(np.log(3.0))),
    "log_damping": (float(np.log(0.05)), float(np.log(0.8))),
}
"""Outside them there is no vehicle."""


class Fit(NamedTuple):
    """What was found of a stretch.

    Attributes:
        stretch: of which it is the fit.
        unknowns: in the order of its layout.
        bends: intensity of the slope's steps in 1/m.
        passes: that it took.
        changed_rad: largest change of a pitch by the last of them.
    """

    stretch: Stretch
    unknowns: FloatArray
    bends: FloatArray
    passes: int
    changed_rad: float

    def of(self, name: str) -> float:
        """Return the one of `layout.GLOBALS`."""
        return float(self.unknowns[self.stretch.layout.place(name)])

    @property
    def grade(self) -> float:
        """The mean slope of the road."""
        return float(self.unknowns[self.stretch.layout.slope].mean())

    def covariance(self, weights: FloatArray) -> FloatArray:
        """Return that of the sums of all unknowns by ``weights``, shape (m, unknowns): (m, m)."""
        rows = self.stretch.rows(self.unknowns, self.bends)
        solved = _factor(rows).solve(np.ascontiguousarray(weights.T))
        return np.asarray(weights @ solved)

    def elevation_sigma(self, marks_m: FloatArray, wavelength_m: float) -> FloatArray:
        """Return 1-σ in m of the high-passed elevation at the places ``marks_m``, shape (m,).

        Beyond the stretch the road goes on with the slope of its end.
        """
        covariance = self.covariance(_delivered(self.stretch, marks_m, wavelength_m))
        return np.sqrt(np.diag(covariance))


def fit(stretch: Stretch) -> Fit:
    """Return the unknowns with the least sum of squares, from the model's own start."""
    y, bends = stretch.start(), first_bends(stretch.layout.points, stretch.model)
    changed, number = np.inf, 0
    while number < PASSES and not (changed < SETTLED_RAD and number >= FEWEST):
        rows = stretch.rows(y, bends)
        step = _factor(rows).solve(rows.derivative.T @ rows.misfit)
        y = _go(stretch, y, step, float(rows.misfit @ rows.misfit), bends)
        bends = renew_bends(y[stretch.layout.slope], stretch.model)
        changed, number = float(np.abs(step[stretch.layout.pitch]).max()), number + 1
    return Fit(stretch, y, bends, number, changed)


def _factor(rows: Rows) -> Any:
    """Return the factors of JᵀJ; the order that keeps them sparse is that of a symmetric matrix."""
    from scipy.sparse.linalg import splu

    normal = (rows.derivative.T @ rows.derivative).tocsc()
    options = {"SymmetricMode": True}
    return splu(normal, permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options=options)


def _go(
    stretch: Stretch, y: FloatArray, step: FloatArray, before: float, bends: FloatArray
) -> FloatArray:
    """Return the unknowns after ``step``, or a part of it that does not make them worse."""
    share = 1.0
    for _ in range(HALVINGS):
        new = _within_ranges(stretch, y + share * step)
        if stretch.misfit(new, bends) <= ALLOWED * before + MORE:
            break
        share *= 0.5
    return new


def _within_ranges(stretch: Stretch, y: FloatArray) -> FloatArray:
    for name, (least, most) in RANGES.items():
        at = stretch.layout.place(name)
        y[at] = np.clip(y[at], least, most)
    return y


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
