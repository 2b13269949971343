"""The quarter car against its two equations of motion."""

import numpy as np
import pytest

from floatref.errors import InputError
from floatref.vehicle_response import QuarterCar

CORNER = QuarterCar(700.0, 75.0, 45e3, 3300.0, 320e3, 150.0)


def test_the_forces_are_those_of_suspension_and_tyre():
    model, q, rate = CORNER.model(), np.array([0.02, -0.01]), np.array([0.3, 0.5])
    suspension = 45e3 * 0.03 + 3300.0 * -0.2
    tyre = 320e3 * -0.01 + 150.0 * 0.5
    found = model.stiffness @ q + model.damping @ rate
    np.testing.assert_allclose(found, [suspension, tyre - suspension], rtol=1e-12)
    np.testing.assert_array_equal(model.mass, np.diag([700.0, 75.0]))


def test_its_channels_and_its_tyre_belong_to_a_wheel_path():
    model = CORNER.model("left")
    assert [(f.quantity, f.track) for f in model.freedoms] == [
        ("sprung", "left"),
        ("unsprung", "left"),
    ]
    assert [(t.freedom, t.track, t.x_m) for t in model.tyres] == [("wheel", "left", 0.0)]


@pytest.mark.parametrize(
    ("name", "value", "message"),
    [
        ("sprung_kg", 0.0, "sprung_kg is 0 kg; give it in kg, a finite number above zero"),
        ("suspension_n_per_m", float("nan"), "suspension_n_per_m is nan N/m"),
        ("suspension_ns_per_m", -5.0, "suspension_ns_per_m is -5 N·s/m"),
        ("tyre_ns_per_m", -1.0, "tyre_ns_per_m is -1 N·s/m; .* zero or above"),
        ("tyre_n_per_m", float("inf"), "tyre_n_per_m is inf N/m"),
    ],
)
def test_no_parameter_is_beyond_a_vehicle(name, value, message):
    with pytest.raises(InputError, match=f"^model quarter-car: {message}"):
        QuarterCar(**{**vars(CORNER), name: value})
