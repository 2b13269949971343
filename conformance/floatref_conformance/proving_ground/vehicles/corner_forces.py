"""What leaf and progressive springs add to the linear forces at a vehicle's four corners.

Both act along a corner's travel d, body minus wheel from rest on level ground:
g = k·p·d³ + f. The first makes the spring's force k·d·(1 + p·d²). The second is Coulomb friction
as Dahl has it, df/dd = (F/s)·(1 − f/F·sgn d'): up to F it holds the body still like a spring of
F/s, so that pitch stays after a stop, and beyond that it slides at ±F. A function of velocity,
such as tanh(v/v₀), would let the body creep back. Its solution over a piece of travel,
f = ±F + (f₀ ∓ F)·exp(−|Δd|/s), is the equation by which Fancher, Ervin, MacAdam and Winkler
describe measured leaf springs ("Measurement and representation of the mechanical properties of
truck leaf springs", SAE 800905, 1980; s is their β).
"""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from floatref.values.arrays import FloatArray

SLIDE_M = 0.002
"""Travel s in m over which the friction nears its limit to 1/e. A round number of ours."""
ITERATIONS = 50
"""Newton's method halves the travel at worst, and then squares the error."""


@dataclass(frozen=True, eq=False)
class CornerForces:
    """The corners' forces as a vehicle has them; wheels in the order of the freedoms.

    Attributes:
        rows: travel of every corner per unit of each freedom, shape (4, n).
        cubic: k·p, shape (4,), in N/m³.
        limit: F, shape (4,), in N.
    """

    rows: FloatArray
    cubic: FloatArray
    limit: FloatArray

    def at_rest(self, stiffness: FloatArray, force: FloatArray) -> FloatArray:
        """Return the freedoms q of K·q + Rᵀ·(k·p·d³) = force by Newton's method, shape (n,).

        ``stiffness`` is K, shape (n, n). The friction bears nothing: where it came to rest
        depends on what was before.
        """
        freedoms = np.linalg.solve(stiffness, force)
        for _ in range(ITERATIONS if self.cubic.any() else 0):
            travel = self.rows @ freedoms
            left = force - stiffness @ freedoms - self.rows.T @ (self.cubic * travel**3)
            slope = 3 * self.cubic * travel**2
            tangent = stiffness + self.rows.T @ (slope[:, None] * self.rows)
            freedoms = freedoms + np.linalg.solve(tangent, left)
        return np.asarray(freedoms)


class Corners(NamedTuple):
    """The corners' forces as a kernel steps them; it changes the last three.

    Attributes:
        rows: as of `CornerForces`, shape (4, n).
        cubic, limit: likewise, shape (4,).
        slide_m: `SLIDE_M`.
        entry: change of the states per sum of a force before and after a step, shape (16, 4).
        reach: change of every corner's travel, likewise, shape (4, 4).
        lift: second derivatives of heave, pitch and roll per force, shape (3, 4).
        travel: at the last step, shape (4,), in m.
        friction: likewise, in N.
        force: of spring and friction, likewise, in N.
    """

    rows: FloatArray
    cubic: FloatArray
    limit: FloatArray
    slide_m: float
    entry: FloatArray
    reach: FloatArray
    lift: FloatArray
    travel: FloatArray
    friction: FloatArray
    force: FloatArray
