"""Accelerometers on one body: each is a sum of the others and of the body's turning.

A rigid body has three vertical freedoms: heave, pitch and roll. So one of three accelerometers on
it is a sum of the other two and of the rates of the angular velocities, whatever the places. A body
that heaves without turning moves all alike: so the weights of the accelerometers sum up to 1. Sums
without the faulty one hold, and no other does.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from floatref.screening.second_sensor.fitting import Fit, fit, shifted
from floatref.values.arrays import BoolArray, FloatArray
from floatref.values.channels import ChannelId

BAND_HZ = (0.5, 8.0)
"""Band in Hz in which a body is rigid, above the drift of accelerometers."""
COHERENT = 0.9
"""Least share of an accelerometer's power that the others of a rigid body explain."""
SEPARATE = 10.0
"""Largest leverage of a gain that is known: scales off by 0.5 % make it wrong by 5 %. A body that
moves in one way alone, as in a bounce test, tells no gain."""
SEARCH = ((8, 7), (2, 3), (1, 1))
"""Lags that are searched: how many steps of the grid apart, and how many to either side; 0.28 s in
all."""


@dataclass(frozen=True, eq=False)
class Relation:
    """How one accelerometer follows from others.

    Attributes:
        fit: the sum.
        gain: sum of the weights of the accelerometers; 1 for working sensors, NaN where the body
            moves in too few ways to tell.
    """

    fit: Fit
    gain: float

    def is_off(self, by: float) -> bool:
        """Return whether the gain is known and differs from 1 by more than ``by``."""
        return abs(self.gain - 1.0) > by


@dataclass(frozen=True, eq=False)
class Body:
    """The vertical accelerometers of a body and its turning, in the band, on one grid.

    Attributes:
        forces: by channel, each of shape (n,), in m/s².
        turning: rates of the angular velocities, shape (k, n), in rad/s².
        known: points that count, shape (n,).
    """

    forces: Mapping[ChannelId, FloatArray]
    turning: FloatArray
    known: BoolArray

    def relate(
        self, target: ChannelId, others: Sequence[ChannelId], late: int = 0
    ) -> Relation | None:
        """Return ``target``, taken ``late`` steps later, as a sum of ``others`` and the turning."""
        if not others:
            return None
        rows = np.stack([self.forces[name] for name in others])
        series = shifted(self.forces[target], late)
        found = fit(series, np.concatenate([rows, self.turning]), self.known, COHERENT)
        if found is None:
            return None
        is_known = found.leverage(len(others)) <= SEPARATE
        return Relation(found, float(found.weights[: len(others)].sum()) if is_known else np.nan)

    def without(self, left_out: ChannelId) -> tuple[Relation, ...]:
        """Return how each accelerometer except ``left_out`` follows from the rest.

        Empty where fewer than two are left, or too little is known.
        """
        rest = [name for name in self.forces if name != left_out]
        found = [self.relate(name, [o for o in rest if o != name]) for name in rest]
        known = tuple(relation for relation in found if relation is not None)
        return known if len(known) == len(rest) > 1 else ()

    def lag(self, target: ChannelId) -> tuple[int, Relation | None]:
        """Return by how many steps ``target`` is later than the others, and how it follows then."""
        others = [name for name in self.forces if name != target]
        steps, best = 0, self.relate(target, others)
        for apart, many in SEARCH:
            middle = steps
            for step in range(middle - apart * many, middle + apart * many + 1, apart):
                found = self.relate(target, others, step)
                if found and best and found.fit.explained > best.fit.explained:
                    steps, best = step, found
        return steps, best
