"""The half car with equipment: its constants, and the signs of its channels."""

import numpy as np
import pytest

from floatref.errors import InputError
from floatref.vehicle_response import ZHU_HALF_CAR, HalfCar


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
