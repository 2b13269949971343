"""1-σ of the delivered elevation from the smoother's covariance.

The delivered elevation is filtered by HPF_B3x2 over distance; what that leaves of the height's
error e is e - L e, L the complementary low-pass of gain 1 / (1 + (2 pi nu / k_c)^6). Its variance
needs the covariance of e between all marks within reach of the filter:
E[e_i e_j'] = P_i Psi_ji' (I - Lambda_j P_j), i before j, Lambda the covariance of lambda.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from floatref.estimators.smoothing.segment import Marks
from floatref.values.arrays import FloatArray, IndexArray

REACH = 1.5
"""Cut-off wavelengths to either side beyond which the low-pass is nothing."""


@dataclass(eq=False)
class Settled:
    """Marks with the information of the readings behind them.

    Attributes:
        at: samples, shape (n,).
        distance_m: encoder distance, shape (n,).
        column: P e_r, shape (n, states).
        passed: product of (I - K H) F from the mark before, shape (n, states, states).
        gathered: what the readings since then add to Lambda, shape (n, states, states).
        left: (I - Lambda P) e_r, shape (n, states).
    """

    at: IndexArray
    distance_m: FloatArray
    column: FloatArray
    passed: FloatArray
    gathered: FloatArray
    left: FloatArray

    @classmethod
    def of(cls, marks: Sequence["Marks | Settled"]) -> "Settled":
        """Settle ``marks`` of segments one after the other, nothing known behind them."""
        from floatref.estimators.smoothing import covariance

        column = np.concatenate([m.column for m in marks])
        passed = np.concatenate([m.passed for m in marks])
        gathered = np.concatenate([m.gathered for m in marks])
        left = np.empty_like(column)
        covariance.settle(column, passed, gathered, left)
        at = np.concatenate([m.at for m in marks])
        distance = np.concatenate([m.distance_m for m in marks])
        # Distances may be missing, and tremble at a stop.
        return cls(at, np.fmax.accumulate(distance), column, passed, gathered, left)

    def part(self, where: slice) -> "Settled":
        """Return the marks ``where``."""
        return Settled(*(values[where] for values in vars(self).values()))

    def without_standing(self) -> "Settled":
        """Return the first and the last mark of each standstill, and all others.

        Those between have no weight in the filter. What passes from one mark to the next, and what
        the readings add on the way, goes to the mark behind them.
        """
        from floatref.estimators.smoothing import covariance

        place = self.distance_m
        between = np.zeros(place.size, np.bool_)
        between[1:-1] = (place[1:-1] == place[:-2]) & (place[1:-1] == place[2:])
        passed, gathered = self.passed.copy(), self.gathered.copy()
        covariance.compose(between, passed, gathered)
        kept = ~between
        return Settled(
            self.at[kept],
            place[kept],
            self.column[kept],
            passed[kept],
            gathered[kept],
            self.left[kept],
        )

    def behind(self, other: "Settled") -> "Settled":
        """Return ``other`` with these marks behind it, all settled by what is known now."""
        return Settled.of((other, self))


def sigma(marks: Settled, first: int, end: int, wavelength_m: float, noise_m: float) -> FloatArray:
    """Return 1-σ in m at marks ``first`` to ``end - 1``, shape (end - first,).

    ``wavelength_m`` is the cut-off of either pass of the filter, ``noise_m`` the 1-σ of a reading
    of the height sensor, which passes the filter as it is.
    """
    from floatref.estimators.smoothing import covariance

    place, reach = marks.distance_m, REACH * wavelength_m
    weights = high_pass(place, wavelength_m, np.arange(first, end))
    low = np.searchsorted(place, place[first:end] - reach)
    high = np.searchsorted(place, place[first:end] + reach, "right")
    variance = np.empty(end - first)
    covariance.spread(covariances(marks, 2 * reach), weights, low, high, variance)
    deviation: FloatArray = np.sqrt(np.maximum(variance, 0.0) + noise_m**2)
    return deviation


def covariances(marks: Settled, width_m: float = np.inf) -> FloatArray:
    """Return E[e_i e_j] of the smoothed height at all marks, shape (n, n), in m².

    It stays 0 for marks further than ``width_m`` apart.
    """
    from floatref.estimators.smoothing import covariance

    found = np.zeros((len(marks.at), len(marks.at)))
    covariance.relate(marks.column, marks.left, marks.passed, marks.distance_m, width_m, found)
    return found


def high_pass(distance_m: FloatArray, wavelength_m: float, wanted: IndexArray) -> FloatArray:
    """Return what HPF_B3x2 takes of all marks for those ``wanted``, in order, shape (m, n).

    1 for the mark itself less the low-pass, whose weights sum to 1. Its impulse response is
    k_c/6 (e^-a + e^(-a/2) (cos(b) + sqrt(3) sin(b))), a = k_c |x|, b = sqrt(3)/2 a,
    k_c = 2 pi / ``wavelength_m``.
    """
    from floatref.estimators.smoothing import covariance

    found = np.zeros((wanted.size, distance_m.size))
    cutoff, reach_m = 2 * np.pi / wavelength_m, REACH * wavelength_m
    covariance.high_pass(distance_m, wanted, cutoff, reach_m, found)
    return found
