"""Gauss–Newton over a stretch: the unknowns of least squares."""

from typing import NamedTuple

import numpy as np

from floatref.estimators.road_slope.bends import first_bends, renew_bends
from floatref.estimators.road_slope.known_rows import known_before
from floatref.estimators.road_slope.rows import Rows, Stretch, Weights
from floatref.values.arrays import FloatArray

PASSES, FEWEST, HALVINGS = 40, 7, 5
SETTLED_RAD = 3e-4
"""Change of all pitches by a whole step below which it was the last."""
LOOSEST, TIGHTER = 30.0, 0.5
"""The first passes take the springs for less sure than they are, each half as much as the one
before: from a start without a road the sum of squares has other minima."""
WHOLE_STEPS = 10
"""Passes that make whole steps, and later ones half of each: a step leaves out second derivatives,
and where they count, whole steps swing about the answer, each farther than the one before."""
ALLOWED, MORE = 1.001, 1.0
"""The sum of squares may grow so much by a step: it is next to flat where it ends."""
RANGES = {
    "gain": (0.0005, 0.02),
    "centre": (-0.1, 1.1),
    "log_front": (float(np.log(6.0)), float(np.log(200.0))),
    "log_rear": (float(np.log(6.0)), float(np.log(200.0))),
    "log_front_damping": (float(np.log(0.1)), float(np.log(20.0))),
    "log_rear_damping": (float(np.log(0.1)), float(np.log(20.0))),
    "log_gyration": (float(np.log(0.4)), float(np.log(1.6))),
}
"""Outside them there is no vehicle."""


class Fit(NamedTuple):
    """What was found of a stretch.

    Attributes:
        stretch: of which it is the fit.
        unknowns: in the order of its layout.
        bends: intensity of the slope's steps in 1/m.
        passes: that it took.
        changed_rad: largest change of a pitch by the whole step of the last of them.
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

    @property
    def prior_misfit(self) -> float:
        """Sum of the squares by which constants are off what is `known_before`, over their 1-σ."""
        known = known_before(self.stretch.layout, self.stretch.model)
        means, sigmas = np.array(list(known.values())).T
        return float(np.sum(np.square((self.unknowns[list(known)] - means) / sigmas)))

    def rows(self) -> Rows:
        """Return all rows where the fit has ended."""
        return self.stretch.rows(self.unknowns, self.stretch.weights(self.unknowns, self.bends))

    def covariance(self, weights: FloatArray) -> FloatArray:
        """Return that of the sums of all unknowns by ``weights``, shape (m, unknowns): (m, m).

        Raises LinAlgError where it is lost in rounding.
        """
        factors = self.stretch.elimination.factor(self.rows().derivative)
        return np.asarray(weights @ np.array([factors.solve(each) for each in weights]).T)


def fit(stretch: Stretch) -> Fit:
    """Return the unknowns with the least sum of squares, from the model's own start.

    It is not settled where rounding leaves no positive matrix of a pass.
    """
    y, bends = stretch.start(), first_bends(stretch.layout.points, stretch.model)
    changed, number = np.inf, 0
    while number < PASSES and not (changed < SETTLED_RAD and number >= FEWEST):
        held = stretch.weights(y, bends, max(1.0, LOOSEST * TIGHTER**number))
        if number == 0:
            held = held._replace(sagged=np.full(held.sagged.size, stretch.model.first_sag_m))
        rows = stretch.rows(y, held)
        try:
            step = _step(stretch, rows)
        except np.linalg.LinAlgError:
            return Fit(stretch, y, bends, number, np.inf)
        part = step if number < WHOLE_STEPS else 0.5 * step
        y = _go(stretch, y, part, float(rows.misfit @ rows.misfit), held)
        bends = renew_bends(y[stretch.layout.slope], stretch.model)
        changed, number = float(np.abs(step[stretch.layout.pitch]).max()), number + 1
    return Fit(stretch, y, bends, number, changed)


def _step(stretch: Stretch, rows: Rows) -> FloatArray:
    """Return the step to the least sum of squares of ``rows``."""
    return stretch.elimination.factor(rows.derivative).solve(rows.derivative.T @ rows.misfit)


def _go(
    stretch: Stretch, y: FloatArray, step: FloatArray, before: float, held: Weights
) -> FloatArray:
    """Return the unknowns after ``step``, or a part of it that does not make them worse."""
    share = 1.0
    for _ in range(HALVINGS):
        new = _within_ranges(stretch, y + share * step)
        if stretch.misfit(new, held) <= ALLOWED * before + MORE:
            break
        share *= 0.5
    return new


def _within_ranges(stretch: Stretch, y: FloatArray) -> FloatArray:
    for name, (least, most) in RANGES.items():
        at = stretch.layout.place(name)
        y[at] = np.clip(y[at], least, most)
    return y
