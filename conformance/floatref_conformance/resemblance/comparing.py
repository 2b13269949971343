"""How much two vectors of features have in common, beyond what good devices differ by.

Of each feature only what exceeds the largest one of a good device counts: a pipeline that is
off at a stop, as all of its kind are, does not resemble a flaw by that. Two vectors u and v have
2u·v/(u² + v²) in common: 1 if they are equal, 0 if they share nothing, and below if they oppose
each other. One that is half as long as the other has 0.8 in common with it.
"""

from collections.abc import Iterable, Mapping

import numpy as np

from floatref_conformance.resemblance.features import Features

MARGIN = 1.25
"""By how much a feature has to exceed that of good devices to count in full."""
LEAST = 0.5
"""A flaw that has less in common with a device is not near: more of both differs than agrees."""
MOST_FLAWS = 3
SHORTEST = 1.0
"""A vector shorter than this is that of a good device, of one feature at its margin."""


def spread_of(good: Iterable[Features]) -> dict[str, float]:
    """Return the largest magnitude of every feature among ``good`` devices."""
    spread: dict[str, float] = {}
    for features in good:
        for name, value in features.items():
            spread[name] = max(spread.get(name, 0.0), abs(value or 0.0))
    return spread


def exceed(features: Features, spread: Mapping[str, float]) -> dict[str, float]:
    """Return by how much every feature exceeds the ``spread`` of good devices, with its sign.

    It is 0 within the spread. Features without a value are left out.
    """
    return {
        name: float(np.sign(value) * max(abs(value) - MARGIN * spread.get(name, 0.0), 0.0))
        for name, value in features.items()
        if value is not None
    }


def compare(one: Features, other: Features, spread: Mapping[str, float]) -> float:
    """Return how much two devices have in common, -1 to 1; 0 where one of them is good.

    Features that only one of them has are not compared.
    """
    shared = [n for n, x in one.items() if x is not None and other.get(n) is not None]
    u, v = (
        np.array([each[name] for name in shared])
        for each in (exceed(one, spread), exceed(other, spread))
    )
    lengths = float(u @ u + v @ v)
    if min(u @ u, v @ v, default=0.0) < SHORTEST**2 if shared else True:
        return 0.0
    return float(2.0 * (u @ v) / lengths)
