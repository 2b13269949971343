"""The units in which pictures show quantities, metric and US; values stay in SI units."""

from collections.abc import Mapping, Sequence
from types import MappingProxyType
from typing import NamedTuple

import numpy as np

from floatref.values.channels import channel_spec

SMALL_M = 0.5
"""Largest range of a length in m that is shown in mm or inches."""
NEAR_M = 10.0
"""Largest such length in m: a height above the sea stays in m or feet."""
SYSTEMS = ("si", "us")
"""Names of the metric and the US units, as options have them."""


class Unit(NamedTuple):
    """A unit as it is written, and how many of it one SI unit is."""

    text: str
    factor: float


SHOWN: Mapping[str, Mapping[str, Unit]] = MappingProxyType(
    {
        "distance": {"si": Unit("m", 1.0), "us": Unit("ft", 1.0 / 0.3048)},
        "small distance": {"si": Unit("mm", 1000.0), "us": Unit("in", 1.0 / 0.0254)},
        "time": {"si": Unit("s", 1.0), "us": Unit("s", 1.0)},
        "speed": {"si": Unit("km/h", 3.6), "us": Unit("mi/h", 3600.0 / 1609.344)},
        "velocity": {"si": Unit("m/s", 1.0), "us": Unit("ft/s", 1.0 / 0.3048)},
        "acceleration": {"si": Unit("m/s²", 1.0), "us": Unit("g", 1.0 / 9.80665)},
        "angle": {"si": Unit("°", 180.0 / np.pi), "us": Unit("°", 180.0 / np.pi)},
        "angular rate": {"si": Unit("°/s", 180.0 / np.pi), "us": Unit("°/s", 180.0 / np.pi)},
        "angular acceleration": {
            "si": Unit("°/s²", 180.0 / np.pi),
            "us": Unit("°/s²", 180.0 / np.pi),
        },
        "roughness": {"si": Unit("m/km", 1.0), "us": Unit("in/mi", 63.36)},
        "number": {"si": Unit("", 1.0), "us": Unit("", 1.0)},
    }
)
"""Of every kind of quantity the unit of either system; the values are in m, s, rad, m/km."""
KINDS = MappingProxyType(
    {
        "m/s": "velocity",
        "m/s^2": "acceleration",
        "rad": "angle",
        "rad/s": "angular rate",
        "rad/s^2": "angular acceleration",
        "1": "number",
    }
)
SPEEDS = ("wheel_speed", "gnss_speed")
"""Channels in m/s that are the speed of the vehicle."""


Span = tuple[float, float]
"""Lowest and highest value."""


def kind_of_channel(name: str, spans: Sequence[Span] = ()) -> str:
    """Return the kind of quantity of channel ``name``, whose lines have these ``spans``."""
    if name in SPEEDS:
        return "speed"
    unit = channel_spec(name).unit
    return kind_of_length(spans) if unit == "m" else KINDS[unit]


def kind_of_length(spans: Sequence[Span]) -> str:
    """Return the kind in which lengths with these ``spans``, in m, are shown."""
    is_small = all(high - low < SMALL_M and max(-low, high) < NEAR_M for low, high in spans)
    return "small distance" if is_small else "distance"
