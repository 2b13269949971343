"""Laws of friction and progressive springs at the corners, against closed forms."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.optimize import brentq
from scipy.special import ellipk

from floatref.values.arrays import FloatArray
from floatref_conformance.proving_ground.roads.road import Road, flat_road
from floatref_conformance.proving_ground.vehicles.axle import Axle
from floatref_conformance.proving_ground.vehicles.corner_forces import SLIDE_M
from floatref_conformance.proving_ground.vehicles.full_car import HEAVE, PITCH, Vehicle
from floatref_conformance.proving_ground.vehicles.parameter_sets import (
    LOADED_VAN,
    VEHICLES,
    with_springs,
)
from floatref_conformance.proving_ground.vehicles.response import Response, equilibrium

RATE_HZ = 8000.0
SPRING, UNDAMPED = 20e3, 1e-9
EQUAL = Axle(1.5, 0.8, 10.0, SPRING, UNDAMPED, 1e9)
"""An axle whose wheels stand still; two of them make a body that heaves alone."""
HEAVING = Vehicle("heaving", 1000.0, 2000.0, 500.0, 0.7, EQUAL, replace(EQUAL, x_m=-1.5), 0, 0, 0.0)
FLAT = flat_road(10.0)


def released(vehicle: Vehicle, height_m: float, seconds: float) -> FloatArray:
    """Return the heave of a body that was pushed up and is let go, in m."""
    response = Response.of(vehicle, FLAT, 1 / RATE_HZ, np.zeros(2))
    response.vector[HEAVE] = height_m
    steps = int(seconds * RATE_HZ)
    return response.advance(np.zeros(steps), np.zeros((2, steps)))[HEAVE]


def braked(vehicle: Vehicle, along: FloatArray) -> FloatArray:
    """Return the pitch under a longitudinal specific force at every step, in rad."""
    response = Response.of(vehicle, FLAT, 1 / RATE_HZ, np.array([along[0], 0.0]))
    ground = np.vstack([along, np.zeros(along.size)])
    return response.advance(np.zeros(along.size), ground)[PITCH]


def slowly(last: float, seconds: float) -> FloatArray:
    """Return a rise from 0 to ``last`` without a kink at its ends."""
    return last * np.sin(np.linspace(0.0, np.pi / 2, int(seconds * RATE_HZ))) ** 2


def kept_travel(axle: Axle, load: float) -> float:
    """Return the travel left of a corner that a load strained and then let go, in m.

    k·d + f is the load on the way there, and 0 on the way back; f nears ±F by exp(−|Δd|/s).
    """
    spring, limit = axle.spring, axle.friction

    def there(d: float) -> float:
        return spring * d + limit * (1 - np.exp(-d / SLIDE_M)) - load

    far = brentq(there, 0.0, load / spring, xtol=1e-15)

    def back(d: float) -> float:
        rubs = load - spring * far
        return spring * d - limit + (rubs + limit) * np.exp((d - far) / SLIDE_M)

    return float(brentq(back, 0.0, far, xtol=1e-15))


def calm(vehicle: Vehicle) -> Vehicle:
    """Return ``vehicle`` with dampers that let nothing swing: travel has one direction."""
    front, rear = (replace(axle, damper=8 * axle.damper) for axle in vehicle.axles)
    return replace(vehicle, front=front, rear=rear)


def corner_load(vehicle: Vehicle, along: float) -> float:
    """Return what a corner's spring and friction bear of the load transfer, in N."""
    moment = vehicle.sprung_kg * vehicle.cg_height_m * along * (1 - vehicle.anti_dive)
    return moment / (2 * vehicle.wheelbase_m)


@pytest.mark.slow
@settings(deadline=None, max_examples=8)
@given(limit=st.floats(40.0, 150.0), height_m=st.floats(0.03, 0.08))
def test_each_half_cycle_loses_coulombs_share_of_the_amplitude(
    limit: float, height_m: float
) -> None:
    """2·F/k from peak to peak, less the 2·F·s per reversal that the leaves spring back."""
    vehicle = with_springs(HEAVING, limit * 2 * HEAVING.wheelbase_m, 0.0)
    heave = released(vehicle, height_m, 6.0)
    turns = np.flatnonzero(np.diff(np.sign(np.diff(heave)))) + 1
    peaks = np.abs(np.array([height_m, *heave[turns]]))
    peaks = peaks[peaks >= 5 * SLIDE_M]
    assert peaks.size >= 2
    lost = 2 * limit / SPRING * (1 - 2 * SLIDE_M / (peaks[:-1] + peaks[1:]))
    assert -np.diff(peaks) == pytest.approx(lost, rel=4e-3)


@settings(deadline=None, max_examples=8)
@given(
    name=st.sampled_from(sorted(VEHICLES)),
    friction_nm=st.floats(0.0, 10000.0),
    progression=st.floats(1.0, 1000.0),
    heaving=st.floats(-0.5, 0.5),
    pitching=st.floats(-0.4, 0.4),
)
def test_the_body_loses_what_the_corners_take(
    name: str, friction_nm: float, progression: float, heaving: float, pitching: float
) -> None:
    """Kinetic and elastic energy and the corners' work are constant; friction takes for good."""
    vehicle = with_springs(VEHICLES[name], friction_nm, progression)
    axles = [replace(axle, damper=UNDAMPED) for axle in vehicle.axles]
    vehicle = replace(vehicle, front=axles[0], rear=axles[1])
    found = vehicle.corner_forces()
    response = Response.of(vehicle, FLAT, 1 / RATE_HZ, np.zeros(2))
    assert found is not None
    assert response.corners is not None
    response.vector[7 + HEAVE], response.vector[7 + PITCH] = heaving, pitching

    def energy() -> float:
        q, v = response.vector[:7], response.vector[7:14]
        return float(v @ (vehicle.masses() * v) + q @ vehicle.stiffness() @ q) / 2

    start, work, force, travel = energy(), 0.0, np.zeros(4), np.zeros(4)
    rubbed = 0.0
    for _ in range(800):
        response.advance(np.zeros(1), np.zeros((2, 1)))
        now = found.rows @ response.vector[:7]
        work += (force + response.corners.force) @ (now - travel) / 2
        force, travel = response.corners.force.copy(), now
        rubbed = work - float(np.sum(found.cubic * travel**4)) / 4
    assert energy() + work == pytest.approx(start, rel=1e-9, abs=1e-12)
    assert rubbed >= -1e-6 * start


@pytest.mark.parametrize("name", list(VEHICLES))
@pytest.mark.parametrize("friction_nm", [1000.0, 2500.0])
def test_pitch_stays_after_a_slow_push_and_release(name: str, friction_nm: float) -> None:
    vehicle, along = with_springs(calm(VEHICLES[name]), friction_nm, 0.0), 6.0
    ramp, held_s = slowly(along, 8.0), np.ones(int(10 * RATE_HZ))
    pitch = braked(vehicle, -np.hstack([ramp, along * held_s, ramp[::-1], 0 * held_s]))
    kept = [kept_travel(axle, corner_load(vehicle, along)) for axle in vehicle.axles]
    wanted = sum(kept) / vehicle.wheelbase_m
    assert pitch[-1] == pytest.approx(wanted, rel=5e-3)
    assert np.ptp(pitch[-int(2 * RATE_HZ) :]) < 1e-4 * wanted
    assert wanted > 0.5 * friction_nm / 1.2e6


@pytest.mark.parametrize("name", list(VEHICLES))
def test_all_corners_slide_at_the_moment_of_the_friction(name: str) -> None:
    """Beyond it the pitch is of the rest of the moment on the linear springs."""
    vehicle, along, friction_nm = VEHICLES[name], 7.0, 1200.0
    pitch = braked(with_springs(vehicle, friction_nm, 0.0), -slowly(along, 12.0))[-1]
    moment = corner_load(vehicle, along) * 2 * vehicle.wheelbase_m
    soft = sum(1 / axle.spring for axle in vehicle.axles) / (2 * vehicle.wheelbase_m**2)
    tyres = vehicle.sprung_kg * vehicle.cg_height_m * along / (2 * vehicle.wheelbase_m**2)
    wheels = tyres * sum(1 / axle.tyre for axle in vehicle.axles)
    assert pitch == pytest.approx((moment - friction_nm) * soft + wheels, rel=2e-3)


@settings(deadline=None, max_examples=8)
@given(progression=st.floats(1.0, 300.0), height_m=st.floats(0.01, 0.08))
def test_a_free_heave_keeps_duffings_time(progression: float, height_m: float) -> None:
    """ω² rises by 3/4·p·A² for small p·A²; its period is an elliptic integral for any."""
    heave = released(with_springs(HEAVING, 0.0, progression), height_m, 6.0)
    before = np.flatnonzero((heave[:-1] > 0) & (heave[1:] <= 0))
    crossings = before + heave[before] / (heave[before] - heave[before + 1])
    found = 2 * np.pi * RATE_HZ / np.diff(crossings).mean()
    linear = np.sqrt(4 * SPRING / HEAVING.sprung_kg)
    bend = progression * height_m**2
    exact = linear * np.sqrt(1 + bend) * np.pi / 2 / ellipk(bend / (2 + 2 * bend))
    assert found == pytest.approx(exact, rel=1e-3)
    assert (found / linear) ** 2 - 1 == pytest.approx(0.75 * bend, rel=0.05 + 0.2 * bend, abs=1e-3)


@settings(deadline=None, max_examples=30)
@given(
    name=st.sampled_from(sorted(VEHICLES)),
    progression=st.floats(0.1, 1000.0),
    along=st.floats(-9.0, 9.0),
)
def test_static_travel_solves_the_cubic(name: str, progression: float, along: float) -> None:
    vehicle = with_springs(VEHICLES[name], 0.0, progression)
    found = vehicle.corner_forces()
    assert found is not None
    travel = found.rows @ equilibrium(vehicle, np.array([0, 0, 0, 0, along, 0.0]))
    load = corner_load(vehicle, along)
    for (axle, _), d, wanted in zip(
        vehicle.wheels(), travel, (load, load, -load, -load), strict=True
    ):
        assert axle.spring * d * (1 + progression * d**2) == pytest.approx(wanted, abs=1e-6)


def test_a_vehicle_on_progressive_springs_starts_at_rest() -> None:
    x = np.arange(-10.0, 10.0, 0.05)
    z = 0.08 * np.sin(x)
    road = Road(-10.0, 0.05, {"left": z, "right": -z}, {"left": 0.8, "right": -0.8})
    vehicle, still = with_springs(LOADED_VAN, 2500.0, 1000.0), np.array([-4.0, 2.0])
    response = Response.of(vehicle, road, 1 / RATE_HZ, still)
    body = response.advance(np.zeros(8000), np.tile(still[:, None], 8000))
    assert np.abs(body[:3, 0]).min() > 5e-4
    assert np.ptp(body[:3], axis=1).max() < 1e-11
    assert np.abs(body[6:]).max() < 1e-8


def test_without_friction_and_progression_every_bit_is_the_linear_models() -> None:
    assert with_springs(LOADED_VAN, 0.0, 0.0) is LOADED_VAN
    assert Response.of(LOADED_VAN, FLAT, 1 / RATE_HZ, np.zeros(2)).corners is None
    barely = with_springs(LOADED_VAN, 1e-290, 1e-290)
    along = 3.0 * np.sin(np.arange(4000) / 500.0)
    assert np.array_equal(braked(LOADED_VAN, along), braked(barely, along))


def test_halving_the_step_quarters_the_error() -> None:
    """The rule's own second order, through every reversal of the friction."""
    vehicle = with_springs(LOADED_VAN, 1500.0, 300.0)

    def pose(rate_hz: float) -> FloatArray:
        times = np.arange(int(3 * rate_hz)) / rate_hz
        ground = np.vstack([-4 * np.sin(9 * times), 2 * np.sin(7 * times)])
        response = Response.of(vehicle, FLAT, 1 / rate_hz, np.zeros(2))
        return response.advance(np.zeros(times.size), ground)[:3, :: round(rate_hz / 1000)]

    fine = pose(128e3)
    errors = [np.abs(pose(rate_hz) - fine).max() for rate_hz in (4e3, 8e3, 16e3)]
    assert errors[1] < 1e-7
    assert 3.4 < errors[0] / errors[1] < 4.6
    assert 3.4 < errors[1] / errors[2] < 4.6


def test_second_derivatives_hold_the_corners_forces() -> None:
    """The gain of a rate over a step is the mean of its derivative before and after."""
    rng = np.random.default_rng(5)
    ground = np.cumsum(rng.standard_normal((2, 4000)), axis=1) * 0.02
    response = Response.of(with_springs(LOADED_VAN, 2500.0, 500.0), FLAT, 1 / RATE_HZ, ground[:, 0])
    body = response.advance(np.zeros(4000), ground)
    gain = (body[6:, 1:] + body[6:, :-1]) / (2 * RATE_HZ)
    assert np.abs(body[6:]).max() > 0.1
    assert np.diff(body[3:6]) == pytest.approx(gain, abs=1e-12)
