"""The half car with equipment against springs written out, and the signs of its channels."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref.vehicle_response import ZHU_HALF_CAR, HalfCar


@pytest.mark.cites("(2) to (6) of Zhu")
@settings(deadline=None, max_examples=25)
@given(seed=st.integers(0, 2**32 - 1))
def test_the_forces_are_those_of_springs_between_moving_ends(seed, drawn_parameters):
    car = drawn_parameters(seed)[1]
    y1, y2, y3, y4, pitch = q = np.random.default_rng(seed).normal(size=5)
    on_equipment = car.equipment_n_per_m * (y2 + car.eccentricity_m * pitch - y1)
    rear = 2 * car.suspension_n_per_m * (y2 - car.rear_axle_m * pitch - y3)
    front = 2 * car.suspension_n_per_m * (y2 + car.front_axle_m * pitch - y4)
    turning = car.eccentricity_m * on_equipment - car.rear_axle_m * rear + car.front_axle_m * front
    forces = [
        -on_equipment,
        on_equipment + rear + front,
        car.tyre_n_per_m * y3 - rear,
        car.tyre_n_per_m * y4 - front,
        turning,
    ]
    np.testing.assert_allclose(car.model().stiffness @ q, forces, rtol=1e-9, atol=1e-3)


@pytest.mark.cites("Table 1 of Zhu")
def test_the_constants_are_those_of_table_1_with_a_readable_damping():
    model = ZHU_HALF_CAR.model()
    np.testing.assert_array_equal(np.diag(model.mass), [1000, 13000, 170, 170, 124566])
    assert model.damping[2, 2] == 2 * 1200.0
    assert model.damping[0, 1] == -790.0
    assert model.stiffness[2, 2] == 2 * 2.5e6 + 1.434e6
    assert ZHU_HALF_CAR.wheelbase_m == pytest.approx(9.38)


def test_the_rear_tyre_comes_first_and_its_pitch_is_nose_up():
    model = ZHU_HALF_CAR.model()
    assert [(t.freedom, t.x_m) for t in model.tyres] == [
        ("rear wheel", -3.19),
        ("front wheel", 6.19),
    ]
    # With the front wheel higher the nose is up: θ > 0, and the channel's pitch below zero.
    rest = np.linalg.solve(model.stiffness, model.selection @ [0.0, 1.434e6 * 0.1])
    pitch = model.index("pitch")
    assert rest[pitch] == pytest.approx(0.1 / 9.38)
    assert model.freedoms[pitch].sign * rest[pitch] < 0


@pytest.mark.parametrize(
    ("changed", "message"),
    [
        ({"body_kg": -1.0}, "body_kg is -1 kg"),
        ({"front_axle_m": 0.0}, "front_axle_m is 0 m"),
        ({"eccentricity_m": float("nan")}, "eccentricity_m is nan m; give it in m, a finite num"),
        ({"pitch_kg_m2": 124566e3}, r"pitch_kg_m2 is 1.24566e\+08 kg·m², above the 1.1438e\+06"),
    ],
)
def test_what_no_body_can_have_is_refused(changed, message):
    with pytest.raises(InputError, match=f"^model half-car-with-equipment: {message}"):
        HalfCar(**changed)


def test_equipment_may_be_behind_the_centre():
    assert HalfCar(eccentricity_m=-2.0).model().stiffness[0, 4] == 2.0 * 1e6
