"""The golden vector of the road-prior smoother: a stop of a few seconds over a waving road."""

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import DTypeLike, NDArray

from floatref_reference.chapter_5.section_5_3 import capture, trigger
from floatref_reference.road_prior.encoder import inputs
from floatref_reference.road_prior.fixed_lag import fixed_lag
from floatref_reference.road_prior.lag_sections import Sections
from floatref_reference.road_prior.symbols import Constants, recorded

Array = NDArray[np.float64]
SETTINGS = {
    "rate_hz": 100.0,
    "interval_m": 0.25,
    "acceleration": 1.5e-4,
    "acceleration_bias": 0.03,
    "acceleration_walk": 1e-4,
    "walk_along": 1.6e-3,
    "reading_m": 2e-3,
    "road_m": 4e-6,
    "long_waves_per_m": 2e-7,
    "road_reach_m": 150.0,
    "lean_sigma_rad": 0.03,
    "tilt_sigma": 0.01,
    "pitch_hz": 1.6,
    "pitch_damping": 0.3,
}
"""Less than 500 nodes, so that the road's spectrum is not renewed, and none is an edge."""


def sensors(distance: Array, rate_hz: float) -> dict[str, Array]:
    """Return what sensors read of a body that heaves by 4 mm over a road, with six decimals."""
    t, omega = np.arange(distance.size) / rate_hz, 2 * np.pi * 1.3
    body = 0.004 * np.sin(omega * t)
    road = 0.005 * np.sin(2 * np.pi * distance / 3.1) + 0.002 * np.sin(2 * np.pi * distance / 0.9)
    a, h = 0.02 - omega**2 * body, 0.3 + body - road
    return {"acceleration": np.round(a, 6), "height": np.round(h, 6), "distance": distance}


def elevation(s: Mapping[str, float], i: Mapping[str, Any], kind: DTypeLike) -> Any:
    """Return the elevation of the points, with states of the precision ``kind``."""
    distance, a, h = i["distance"], np.asarray(i["acceleration"], float), i["height"]
    height = np.asarray(h, float)
    u = inputs(distance, 1 / s["rate_hz"], s["pitch_hz"], s["pitch_damping"])
    constants = Constants(
        s["acceleration"],
        s["acceleration_walk"],
        s["walk_along"],
        s["reading_m"],
        s["road_m"],
        s["long_waves_per_m"],
        s["road_reach_m"],
        sigma_b=s["acceleration_bias"],
        sigma_kappa=(s["lean_sigma_rad"], s["tilt_sigma"]),
    )
    t = np.arange(height.size) / s["rate_hz"]
    run = recorded(t, distance, a, height - height[0], np.stack(u, axis=-1), u[0])
    r = fixed_lag(run, constants, Sections([], [False] * t.size), kind) + height[0]
    return capture(r - height, trigger(distance, s["interval_m"]))
