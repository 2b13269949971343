"""Laws of the seven-freedom vehicle and the physical ranges of its parameter sets."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref.values.channels import STANDARD_GRAVITY
from floatref_conformance.proving_ground.roads.road import Road, flat_road
from floatref_conformance.proving_ground.vehicles.full_car import HEAVE, PITCH, ROLL, Vehicle
from floatref_conformance.proving_ground.vehicles.parameter_sets import (
    LOADED_VAN,
    VEHICLES,
    find_vehicle,
)
from floatref_conformance.proving_ground.vehicles.response import (
    ENVELOPE_M,
    Response,
    count_steps,
    equilibrium,
    state_space,
)

every_set = pytest.mark.parametrize("vehicle", VEHICLES.values(), ids=list(VEHICLES))


def modes(vehicle: Vehicle) -> tuple[np.ndarray, np.ndarray]:
    """Return frequencies in Hz and damping ratios of the oscillations, slowest first."""
    poles = np.linalg.eigvals(state_space(vehicle)[0])
    poles = poles[poles.imag > 0]
    poles = poles[np.argsort(abs(poles))]
    return abs(poles) / (2 * np.pi), -poles.real / abs(poles)


def pitch_per_g(vehicle: Vehicle) -> float:
    braking = np.array([0.0, 0.0, 0.0, 0.0, -STANDARD_GRAVITY, 0.0])
    return float(np.degrees(equilibrium(vehicle, braking)[PITCH]))


@every_set
def test_bounce_pitch_roll_and_wheel_hop_are_a_vehicles(vehicle: Vehicle) -> None:
    frequencies, damping = modes(vehicle)
    assert frequencies.size == 7
    assert np.all((frequencies[:3] > 1.0) & (frequencies[:3] < 2.3))
    assert np.all((frequencies[3:] > 8.0) & (frequencies[3:] < 13.0))
    assert np.all((damping > 0.05) & (damping < 0.6))


@every_set
def test_braking_pitches_two_to_five_degrees_per_g(vehicle: Vehicle) -> None:
    assert 2.0 <= pitch_per_g(vehicle) <= 5.2


def test_loaded_van_weighs_and_pitches_as_the_systems_vehicle() -> None:
    wheels = sum(axle.wheel_kg for axle, _ in LOADED_VAN.wheels())
    occupants = LOADED_VAN.sprung_kg + wheels - 31.49e3 / STANDARD_GRAVITY
    assert 0 <= occupants < 200
    assert LOADED_VAN.wheelbase_m == pytest.approx(3.43)
    assert pitch_per_g(LOADED_VAN) == pytest.approx(2.1, abs=0.2)


def test_one_set_is_soft_lightly_damped_and_mounted_far_behind() -> None:
    soft = [
        v
        for v in VEHICLES.values()
        if pitch_per_g(v) > 4.9 and modes(v)[1].max() < 0.15 and v.sensor_x_m < -2.8
    ]
    assert soft


@every_set
def test_vehicle_follows_a_lifted_and_a_tilted_road_rigidly(vehicle: Vehicle) -> None:
    """Translation and rotation of the whole road strain no spring."""
    x = np.array([axle.x_m for axle, _ in vehicle.wheels()])
    y = np.array([side for _, side in vehicle.wheels()])
    for under, freedom in ((np.ones(4), HEAVE), (-x, PITCH), (y, ROLL)):
        at_rest = equilibrium(vehicle, np.array([*under, 0.0, 0.0]))
        assert at_rest[3:] == pytest.approx(under, abs=1e-12)
        assert at_rest[:3] == pytest.approx(np.eye(3)[freedom], abs=1e-12)


@settings(deadline=None, max_examples=30)
@given(
    name=st.sampled_from(sorted(VEHICLES)),
    anti_dive=st.floats(0.0, 0.9),
    roll_links=st.floats(0.0, 0.9),
    a_x=st.floats(-8.0, 8.0),
    a_y=st.floats(-5.0, 5.0),
)
def test_tyres_take_the_whole_load_transfer(
    name: str, anti_dive: float, roll_links: float, a_x: float, a_y: float
) -> None:
    """Moments about the ground balance the inertia of the body, whatever the links carry."""
    vehicle = replace(VEHICLES[name], anti_dive=anti_dive, roll_links=roll_links)
    rest = equilibrium(vehicle, np.array([0.0, 0.0, 0.0, 0.0, a_x, a_y]))
    loads = -np.array([axle.tyre for axle, _ in vehicle.wheels()]) * rest[3:]
    x = np.array([axle.x_m for axle, _ in vehicle.wheels()])
    y = np.array([side for _, side in vehicle.wheels()])
    moment = vehicle.sprung_kg * vehicle.cg_height_m
    assert loads.sum() == pytest.approx(0.0, abs=1e-6)
    assert loads @ x == pytest.approx(-moment * a_x, abs=1e-6)
    assert loads @ y == pytest.approx(-moment * a_y, abs=1e-6)


@pytest.mark.slow
@every_set
def test_steady_braking_reaches_the_tilt_of_the_springs_in_series(vehicle: Vehicle) -> None:
    """Front sinks and rear rises by its share of the transfer over spring and tyre."""
    deceleration, rate = 3.0, 8000.0
    ground = np.zeros((2, int(30 * rate)))
    ground[0, 1000:] = -deceleration
    response = Response.of(vehicle, flat_road(10.0), 1 / rate, np.zeros(2))
    body = response.advance(np.zeros(ground.shape[1]), ground)
    transfer = vehicle.sprung_kg * vehicle.cg_height_m * deceleration / vehicle.wheelbase_m
    travel = [
        transfer * ((1 - vehicle.anti_dive) / axle.spring + 1 / axle.tyre) / 2
        for axle in vehicle.axles
    ]
    assert np.all(body[:, :1000] == 0.0)
    assert body[PITCH, -1] == pytest.approx(sum(travel) / vehicle.wheelbase_m, rel=1e-4)


@pytest.mark.slow
@pytest.mark.parametrize("hertz", [0.7, 1.3, 3.0, 10.0])
def test_response_to_a_sinusoidal_road_is_the_transfer_function(hertz: float) -> None:
    """Against M, C, K solved at one frequency, wheelbase delay and tyre envelope included."""
    vehicle, rate, speed = LOADED_VAN, 8000.0, 20.0
    wave = speed / hertz
    x = np.arange(-20.0, 820.0, 0.02)
    z = 0.01 * np.sin(2 * np.pi * x / wave)
    road = Road(-20.0, 0.02, {"left": z, "right": z}, {"left": 0.86, "right": -0.86})
    times = np.arange(int(40 * rate)) / rate
    response = Response.of(vehicle, road, 1 / rate, np.zeros(2))
    body = response.advance(speed * times, np.zeros((2, times.size)))
    omega = 2 * np.pi * hertz
    window = round((ENVELOPE_M / 0.02 - 1) / 2) * 2 + 1
    step = np.pi * 0.02 / wave
    envelope = np.sin(window * step) / (window * np.sin(step))
    under = [0.01 * envelope * np.exp(1j * omega * a.x_m / speed) for a, _ in vehicle.wheels()]
    dynamic = (
        vehicle.stiffness() + 1j * omega * vehicle.damping() - omega**2 * np.diag(vehicle.masses())
    )
    expected = np.linalg.solve(dynamic, vehicle.forcing() @ np.array([*under, 0, 0]))
    steady = times > 20.0
    for row, order in ((0, 0), (3, 1), (6, 2)):
        for freedom in (HEAVE, PITCH):
            wanted = np.imag(expected[freedom] * (1j * omega) ** order * np.exp(1j * omega * times))
            error = np.abs(body[row + freedom] - wanted)[steady].max()
            assert error < 2e-3 * np.abs(wanted[steady]).max()


def test_state_is_carried_from_stretch_to_stretch() -> None:
    rng = np.random.default_rng(3)
    z = np.cumsum(rng.standard_normal(4000)) * 1e-4
    road = Road(-10.0, 0.01, {"main": z}, {"main": 0.0})
    distance = np.linspace(0.0, 20.0, 6000)
    ground = rng.standard_normal((2, 6000))
    whole = Response.of(LOADED_VAN, road, 1 / 8000, ground[:, 0])
    parts = Response.of(LOADED_VAN, road, 1 / 8000, ground[:, 0])
    at_once = whole.advance(distance, ground)
    pieces = [
        parts.advance(distance[a:b], np.ascontiguousarray(ground[:, a:b]))
        for a, b in ((0, 1000), (1000, 1002), (1002, 6000))
    ]
    assert np.array_equal(at_once, np.hstack(pieces))


@pytest.mark.parametrize(("rate", "steps"), [(16000, 1), (8000, 1), (7999, 2), (1000, 8)])
def test_model_steps_at_8_khz_or_more(rate: float, steps: int) -> None:
    assert count_steps(rate) == steps


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"sprung_kg": -1.0}, "sprung_kg is -1.0"),
        ({"roll_inertia": float("nan")}, "roll_inertia is nan"),
        ({"front": replace(LOADED_VAN.front, damper=0.0)}, "front.damper is 0.0"),
        ({"rear": replace(LOADED_VAN.rear, x_m=0.1)}, "not between the axles"),
        ({"rear": replace(LOADED_VAN.rear, spring=5e3)}, "rear springs sag 1.48 m"),
        ({"anti_dive": 1.0}, "anti_dive"),
    ],
)
def test_parameters_that_no_vehicle_has_are_refused(change: dict, message: str) -> None:
    with pytest.raises(InputError, match=message):
        replace(LOADED_VAN, **change)


def test_unknown_vehicle_is_refused_with_a_hint() -> None:
    with pytest.raises(InputError, match="did you mean minivan"):
        find_vehicle("minivn")
