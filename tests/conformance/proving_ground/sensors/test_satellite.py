"""Where the receiver's antenna goes."""

from dataclasses import replace

import numpy as np
import pytest

from floatref_conformance.proving_ground.scenario import Scenario
from floatref_conformance.proving_ground.sensors.satellite import EARTH_RADIUS_M, START_RAD
from floatref_conformance.proving_ground.simulate import simulate

CURVE = Scenario(
    road="flat", sensors=0.0, rate_hz=1000.0, length_m=400.0, tracks=("left",), speed_kmh=36.0
)


@pytest.mark.parametrize("per_km", [-5.0, 5.0, 2.0])
def test_an_antenna_drives_a_circle_of_its_own_outside_that_of_the_vehicle(per_km):
    """Ahead of the point that is steered by a m, it is sqrt(R² + a²) from the circle's centre.

    The course starts northward; a left turn has its centre in the west.
    """
    simulation = simulate(replace(CURVE, curvature_per_km=per_km))
    recording = simulation.recording
    latitude, longitude = (recording.channel(f"gnss_{n}").values for n in ("latitude", "longitude"))
    north = (latitude - START_RAD[0]) * EARTH_RADIUS_M
    west = -(longitude - START_RAD[1]) * EARTH_RADIUS_M * np.cos(START_RAD[0])
    radius, ahead = 1000.0 / per_km, recording.setup.gnss_antenna_offset_m[0]
    away = np.hypot(north, west - radius)
    np.testing.assert_allclose(away, np.hypot(radius, ahead), atol=1e-3)
    assert north[0] == pytest.approx(ahead, abs=0.2)
    assert np.sign(west[-1]) == np.sign(per_km)
    # It leads or trails the vehicle by the same angle all the way.
    angle = np.unwrap(np.arctan2(north * np.sign(radius), np.abs(radius) - west * np.sign(radius)))
    driven = np.interp(
        recording.channel("gnss_latitude").times_s,
        simulation.motion.times_s,
        simulation.motion.distance,
    )
    expected = np.arctan2(ahead * np.sign(radius), np.abs(radius)) + driven * per_km / 1000.0
    np.testing.assert_allclose(angle, expected, atol=1e-4)
