"""Where the receiver's antenna goes."""

from dataclasses import replace

import numpy as np
import pytest

from floatref_conformance.proving_ground.roads.wander import Line
from floatref_conformance.proving_ground.scenario import Scenario
from floatref_conformance.proving_ground.sensors.satellite import EARTH_RADIUS_M, START_RAD
from floatref_conformance.proving_ground.simulate import simulate
from floatref_conformance.proving_ground.staging import ground_of

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


@pytest.mark.parametrize("per_km", [-5.0, 0.0, 5.0])
@pytest.mark.parametrize("seed", [1, 2])
def test_two_antennas_are_as_far_aside_as_the_lines_of_their_vehicles(per_km, seed):
    """Across the course, which points to a heading of distance times curvature, west of north."""
    steady = replace(CURVE, curvature_per_km=per_km, seed=seed)
    wandering = replace(steady, wander_m=0.08, wander_within_m=0.03)
    straight, aside = (simulate(scenario) for scenario in (steady, wandering))
    apart = []
    for name in ("latitude", "longitude"):
        one, other = (s.recording.channel(f"gnss_{name}").values for s in (straight, aside))
        apart.append((other - one) * EARTH_RADIUS_M)
    north, west = apart[0], -apart[1] * np.cos(START_RAD[0])
    at = np.interp(
        aside.recording.channel("gnss_latitude").times_s,
        aside.motion.times_s,
        aside.motion.distance,
    )
    heading = at * per_km / 1000.0
    left = west * np.cos(heading) - north * np.sin(heading)
    np.testing.assert_allclose(left, Line(seed, 0.08, 0.03).at(at), atol=1e-6)
    np.testing.assert_allclose(north * np.cos(heading) + west * np.sin(heading), 0.0, atol=1e-6)
    assert np.ptp(left) > 0.02


def test_on_a_road_that_is_given_the_antenna_keeps_to_the_wheel_paths():
    scenario = replace(CURVE, road="flat", wander_m=0.08)
    road = ground_of(scenario, 500.0).rolled
    given, steady = simulate(scenario, road), simulate(replace(scenario, wander_m=0.0), road)
    for name in ("gnss_latitude", "gnss_longitude"):
        one, other = (s.recording.channel(name).values for s in (given, steady))
        np.testing.assert_array_equal(one, other)
