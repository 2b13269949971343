"""Units that runs use instead of metres, and how the unit follows from a gain of heights."""

import math
from collections.abc import Mapping
from types import MappingProxyType

METRE = "m"

DISTANCE_UNITS: Mapping[str, float] = MappingProxyType(
    {
        METRE: 1.0,
        "ft": 0.3048,
        "km": 1000.0,
        "mi": 1609.344,
        "in": 0.0254,
        "yd": 0.9144,
        "mm": 0.001,
        "cm": 0.01,
    }
)
"""Metres per unit, in the order in which they are tried."""

HEIGHT_UNITS: Mapping[str, float] = MappingProxyType(
    {METRE: 1.0, "mm": 0.001, "cm": 0.01, "in": 0.0254, "ft": 0.3048, "mil": 2.54e-5}
)
"""Metres per unit of elevation."""

NEAR = 1.3
"""A gain within this factor of a unit's is taken for that unit."""


def height_unit(gain: float) -> str | None:
    """Return the unit of heights that are ``gain`` times those of the reference, in m.

    None where no unit explains it. Metres come first: a gain near one is a matter of scale.
    """
    if not gain > 0:
        return None
    for unit, factor in HEIGHT_UNITS.items():
        if abs(math.log(gain * factor)) <= math.log(NEAR):
            return unit
    return None


def reference_unit(gain: float) -> str | None:
    """Return the unit that the reference seems to have, if the run is in m; None without one."""
    unit = height_unit(1.0 / gain) if gain > 0 else None
    return None if unit == METRE else unit
