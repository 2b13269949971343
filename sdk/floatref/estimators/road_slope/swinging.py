"""The body as an oscillator that rolls over the road: its answer at three nodes."""

from typing import NamedTuple

import numpy as np

from floatref.estimators.road_prior.excitation import response_weights
from floatref.values.arrays import FloatArray, IndexArray

SMALL = 1e-4
"""Change of ln f and ln ζ over which derivatives are differences, accurate to its square."""


class Swing(NamedTuple):
    """θ_{k+1} - T θ_k + D θ_{k-1} = G_0 u_{k-1} + G_1 u_k + G_2 u_{k+1}, and 2ζ/ω.

    Attributes:
        free: D, -T and 1.
        driven: G.
        lag_s: 2ζ/ω, in s.
    """

    free: tuple[float, float, float]
    driven: tuple[float, float, float]
    lag_s: float

    @classmethod
    def of(cls, log_hz: float, log_damping: float, interval_s: float) -> "Swing":
        """Return that of nodes ``interval_s`` apart, u linear in between."""
        hz, damping = float(np.exp(log_hz)), float(np.exp(log_damping))
        by = response_weights(hz, damping, interval_s)
        (a, b, c_before, c_now), (d, e, r_before, r_now) = by.tolist()
        # The rate is eliminated: it is what the value's own row leaves unexplained.
        driven = (
            b * r_before - e * c_before,
            c_before - e * c_now + b * r_now,
            c_now,
        )
        return cls((a * e - b * d, -(a + e), 1.0), driven, damping / (np.pi * hz))

    def excess(self, pitch: FloatArray, u: FloatArray, middles: IndexArray) -> FloatArray:
        """Return right less left side at ``middles``, in rad."""
        sides = (middles - 1, middles, middles + 1)
        total = np.zeros(middles.size)
        for at, free, driven in zip(sides, self.free, self.driven, strict=True):
            total += driven * u[at] - free * pitch[at]
        return total
