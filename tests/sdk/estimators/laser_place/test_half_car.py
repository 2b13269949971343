"""The half car and its smoother are those of the reference, and lean as a rigid body on springs."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.estimators.laser_place import half_car
from floatref.estimators.laser_place.half_car import Gains, HalfCar
from floatref.estimators.laser_place.pitching import smooth_states
from floatref.values.axle_setup import AxleSetup
from floatref_reference.beyond import laser_place as literal

WHEELBASES, PLACES = st.floats(2.0, 8.0), st.floats(-6.0, 6.0)
laws = settings(deadline=None, max_examples=20)


def reference(axles: AxleSetup) -> literal.HalfCar:
    """Return the reference's half car with the usual numbers."""
    half = axles.wheelbase_m / 2
    numbers = half_car.SPRING**0.5, half_car.DAMPER, half_car.TYRE / half_car.WHEEL
    front, rear = (
        literal.Axle(x, 0.5, *numbers[:2], half_car.TYRE, half_car.WHEEL) for x in (half, -half)
    )
    corner = 2 * np.pi * half_car.DISTURBED_HZ
    noise = half_car.DISTURBANCE, corner, half_car.READING
    return literal.HalfCar(front, rear, half_car.DYNAMIC_INDEX, half_car.BRAKE_ARM_M, *noise)


@laws
@given(WHEELBASES, PLACES, PLACES)
def test_its_equations_are_the_literal_ones(length_m: float, front_m: float, at_m: float) -> None:
    axles = AxleSetup(length_m, front_m)
    ours, car = HalfCar.usual(axles, at_m), reference(axles)
    a, b = literal.equations(car)
    np.testing.assert_allclose(ours.dynamics, a, rtol=1e-12, atol=1e-9)
    np.testing.assert_allclose(ours.inputs, b, rtol=1e-12, atol=1e-9)
    h, d = literal.reading_of(car, at_m - front_m + length_m / 2)
    np.testing.assert_allclose(ours.reading, h, rtol=1e-11, atol=1e-8)
    np.testing.assert_allclose(ours.direct, d, rtol=1e-11, atol=1e-12)


@pytest.mark.slow
@settings(deadline=None, max_examples=5)
@given(WHEELBASES, PLACES, st.integers(0, 2**32 - 1), st.sampled_from([0.005, 0.01, 0.02]))
def test_its_smoother_is_the_literal_one(
    length_m: float, at_m: float, seed: int, step: float
) -> None:
    """Plain loops, a series in place of `expm`, and a covariance that settles in place of SciPy."""
    axles, rng, n = AxleSetup(length_m, length_m / 2), np.random.default_rng(seed), 400
    u = np.cumsum(0.002 * rng.normal(size=(3, n)), axis=1)
    force = 0.5 * rng.normal(size=n)
    car = HalfCar.usual(axles, at_m)
    ours = smooth_states(car, Gains.of(car, step), np.ascontiguousarray(u.T), force)
    theirs = literal.smoothed_states(reference(axles), at_m, u, force, step)
    np.testing.assert_allclose(ours[:, :2], theirs[:, :2], rtol=1e-4, atol=1e-6)


@laws
@given(WHEELBASES, PLACES, st.floats(-0.1, 0.1), st.floats(-3.0, 3.0))
def test_at_rest_it_leans_with_the_road_and_against_the_brake(
    length_m: float, at_m: float, slope: float, along: float
) -> None:
    """Static pitch: the road's slope, and h·a over the springs' stiffness k·(L/2)² about pitch."""
    car = HalfCar.usual(AxleSetup(length_m, length_m / 2), at_m)
    x = car.at_rest(np.array([slope * length_m / 2, -slope * length_m / 2, along]))
    brake = half_car.BRAKE_ARM_M * along * 4 / length_m**2
    soft = 1 / half_car.SPRING + 1 / half_car.TYRE
    assert x[half_car.PITCH] == pytest.approx(slope + brake * soft, abs=1e-9, rel=0.02)
    assert x[half_car.HEAVE] == pytest.approx(0.0, abs=1e-12)


@given(st.floats(-0.3, 0.3), st.floats(-1.0, 1.0), st.floats(0.1, 0.5))
def test_a_laser_ahead_of_its_accelerometer_rises_with_the_nose(
    pitch: float, lever: float, height: float
) -> None:
    raised = height - literal.height_under_accelerometer(height, pitch, lever)
    assert raised == pytest.approx(lever * np.sin(pitch), abs=1e-12)
