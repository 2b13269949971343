"""How much two vectors of features have in common, beyond what good devices differ by.

Good devices of several pipelines span a range of every feature, widened by `MARGIN` of its half
and by `FLOOR`. Of a device only what lies outside counts, as the distance to the range: a pipeline
that is off at a stop, as all of its kind are, does not resemble a flaw by that. Two such vectors u
and v have 2u·v/(u² + v²) in common: 1 if they are equal, 0 if they share nothing, below 0 if they
oppose each other. One that is half as long as the other has 0.8 in common with it.
"""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

import numpy as np

from floatref_conformance.resemblance.features import Features

MARGIN = 0.25
FLOOR = 0.25
"""By how much the range of good devices is widened: a share of its half, and in features."""
LEAST = 0.5
"""A flaw that has less in common with a device is not near: more of both differs than agrees."""
MOST_FLAWS = 3
SHORTEST = 0.5
"""A shorter vector is that of a good device: a flaw has several features, or a large one."""


@dataclass(frozen=True)
class GoodRange:
    """The range of every feature that good devices span, by the feature's name.

    Attributes:
        low, high: its ends, widened.
    """

    low: Mapping[str, float]
    high: Mapping[str, float]

    @classmethod
    def of(cls, good: Iterable[Features]) -> "GoodRange":
        """Return the range of the features of ``good`` devices."""
        values: dict[str, list[float]] = {}
        for features in good:
            for name, value in features.items():
                if value is not None:
                    values.setdefault(name, []).append(value)
        wide = {n: FLOOR + MARGIN * (max(x) - min(x)) / 2 for n, x in values.items()}
        return cls(
            {name: min(x) - wide[name] for name, x in values.items()},
            {name: max(x) + wide[name] for name, x in values.items()},
        )

    def exceed(self, features: Features) -> dict[str, float]:
        """Return how far each feature is above the range, or below it as a negative number.

        Features without a value, and those that no good device has, are left out.
        """
        return {
            name: max(value - self.high[name], 0.0) + min(value - self.low[name], 0.0)
            for name, value in features.items()
            if value is not None and name in self.low
        }


def compare(one: Features, other: Features, good: GoodRange) -> float:
    """Return how much two devices have in common, -1 to 1; 0 where one of them is good.

    Features that only one of them has are not compared.
    """
    mine, its = good.exceed(one), good.exceed(other)
    shared = [name for name in mine if name in its]
    u, v = (np.array([each[name] for name in shared]) for each in (mine, its))
    if min(float(u @ u), float(v @ v)) < SHORTEST**2:
        return 0.0
    return float(2.0 * (u @ v) / (u @ u + v @ v))
