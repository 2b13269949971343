"""Estimates of lean and tilt of the vehicle from the brakes of a run."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from floatref.estimators.models.road_prior_values import LEAN, TILT
from floatref.estimators.road_prior.constants import RoadPrior
from floatref.values.arrays import FloatArray

BOTH = np.array([LEAN, TILT])
MOST_UNKNOWN = 0.5
"""A brake that reduces neither variance below this share is dropped."""

SMALLEST = np.finfo(np.float64).tiny


@dataclass(frozen=True, eq=False)
class Brake:
    """Lean and tilt as they are known before they begin anew, shape (2,), and covariance."""

    estimate: FloatArray
    covariance: FloatArray

    @classmethod
    def of(cls, x: FloatArray, p: FloatArray) -> "Brake":
        """Return those of a filter's state ``x`` and covariance ``p``."""
        return cls(x[BOTH], p[np.ix_(BOTH, BOTH)])

    def tells(self, variances: FloatArray) -> bool:
        """Return whether that is much more than the ``variances`` that it began with."""
        return bool((np.diag(self.covariance) < MOST_UNKNOWN * variances).any())


def pool(brakes: Sequence[Brake], constants: RoadPrior) -> Mapping[str, float]:
    """Return lean and tilt of all ``brakes`` with their 1-σ, by the names of `RoadPrior`.

    The mean is that of Gaussians, Λ = P₀⁻¹ + Σ (P⁻¹ - P₀⁻¹), which counts P₀ once. The 1-σ is
    that of one more brake: Λ⁻¹ and the variance of the brakes about the mean, each weighted by
    the information it adds. Without brakes there is nothing.
    """
    if not brakes:
        return {}
    start = np.array([constants.lean_expected_rad, constants.tilt_expected])
    variances = np.square([constants.lean_sigma_rad, constants.tilt_sigma])
    before = np.diag(1.0 / variances)
    information, weighted = before.copy(), before @ start
    for brake in brakes:
        sure = np.linalg.inv(brake.covariance)
        information += sure - before
        weighted += sure @ brake.estimate - before @ start
    covariance = np.linalg.inv(information)
    mean = covariance @ weighted
    estimates = np.array([brake.estimate for brake in brakes])
    known = np.array([1.0 - np.diag(brake.covariance) / variances for brake in brakes])
    # Without information the estimate of a brake stays at its start: subtract that part.
    off = estimates - start - known * (mean - start)
    spread = (off**2).sum(axis=0) / np.maximum(np.square(known).sum(axis=0), SMALLEST)
    sigma = np.sqrt(np.minimum(np.diag(covariance) + spread, variances))
    return {
        "lean_expected_rad": float(mean[0]),
        "lean_sigma_rad": float(sigma[0]),
        "tilt_expected": float(mean[1]),
        "tilt_sigma": float(sigma[1]),
    }
