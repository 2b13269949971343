"""What is known of the vehicle are finite numbers that nobody changes; all else is refused."""

import math
import re

import pytest
from hypothesis import given
from hypothesis import strategies as st

from floatref import VehicleSetup
from floatref.errors import InputError
from floatref.values.vehicle_setup import FARTHEST_M

NUMBERS = st.one_of(st.floats(allow_nan=False, allow_infinity=False), st.integers(-(2**53), 2**53))


@given(
    st.text(min_size=1, max_size=20),
    st.dictionaries(st.text(max_size=12), NUMBERS, max_size=5),
    st.floats(-FARTHEST_M, FARTHEST_M),
)
def test_a_vehicle_is_what_was_stated(model: str, parameters: dict, x_m: float) -> None:
    vehicle = VehicleSetup(model, parameters, x_m)
    assert (vehicle.model, dict(vehicle.parameters), vehicle.x_m) == (model, parameters, x_m)
    assert all(isinstance(value, float) for value in vehicle.parameters.values())
    assert vehicle == VehicleSetup(model, dict(parameters), x_m)


def test_parameters_are_a_copy_that_cannot_be_changed() -> None:
    given_ones = {"sprung_kg": 400.0}
    vehicle = VehicleSetup("quarter-car", given_ones)
    given_ones["sprung_kg"] = 1.0
    assert vehicle.parameters["sprung_kg"] == 400.0
    with pytest.raises(TypeError):
        vehicle.parameters["sprung_kg"] = 2.0  # type: ignore[index]  # It is refused.


@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf, True, "400", None, [1.0]])
@pytest.mark.parametrize("name", ["sprung_kg", "x_m"])
def test_what_is_no_finite_number_is_told_by_name_and_value(name: str, value: object) -> None:
    given_ones = {"unsprung_kg": 40.0, "sprung_kg": 400.0}
    x_m = value if name == "x_m" else 0.0
    if name == "sprung_kg":
        given_ones[name] = value  # type: ignore[assignment]  # Wrong on purpose.
    said = re.escape(f"setup.vehicle: {name} is {value!r}; give a finite number")
    with pytest.raises(InputError, match=said):
        VehicleSetup("quarter-car", given_ones, x_m)  # type: ignore[arg-type]  # Wrong on purpose.


def test_a_vehicle_without_a_model_is_refused() -> None:
    with pytest.raises(InputError, match=r"setup\.vehicle\.model is empty; name the model"):
        VehicleSetup("", {})


@given(st.floats(FARTHEST_M, 1e9, exclude_min=True), st.sampled_from([-1, 1]))
def test_a_point_outside_all_vehicles_is_refused(far: float, side: int) -> None:
    with pytest.raises(InputError, match=r"x_m is .*; give it in m, within 100 m"):
        VehicleSetup("quarter-car", {}, side * far)
