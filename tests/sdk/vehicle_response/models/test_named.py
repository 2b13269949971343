"""Models by the name and the parameters of a recording's setup."""

import numpy as np
import pytest

from floatref.errors import InputError
from floatref.values.vehicle_setup import VehicleSetup
from floatref.vehicle_response import IMINE_TRAILER, MODELS, ZHU_HALF_CAR, model_of, parameters_of


def test_a_setup_gives_the_model_that_its_parameters_give(drawn_parameters):
    for parameters in drawn_parameters(1):
        name = next(n for n, kind in MODELS.items() if kind is type(parameters))
        setup = VehicleSetup(name, vars(parameters))
        assert parameters_of(setup) == parameters
        made = model_of(setup)
        assert made.name == name
        np.testing.assert_array_equal(made.stiffness, parameters.model().stiffness)


def test_without_parameters_it_is_the_vehicle_of_the_paper():
    assert parameters_of(VehicleSetup("half-car-with-equipment", {})) == ZHU_HALF_CAR
    assert parameters_of(VehicleSetup("two-wheel-trailer", {})) == IMINE_TRAILER


@pytest.mark.parametrize(
    ("name", "parameters", "message"),
    [
        ("quarter_car", {}, "'quarter_car' is unknown; did you mean quarter-car"),
        ("bicycle", {}, "'bicycle' is unknown; known: quarter-car, half-car"),
        ("quarter-car", {"sprung": 1.0}, "no parameter 'sprung'; did you mean sprung_kg"),
        ("quarter-car", {"zzz": 1.0}, "no parameter 'zzz'; known: sprung_kg, unsprung_kg"),
        ("quarter-car", {"sprung_kg": 700.0}, "unsprung_kg, .*tyre_n_per_m missing; give every"),
        ("half-car-with-equipment", {"body_kg": 900.0}, "equipment_kg, .* missing"),
        ("two-wheel-trailer", {**vars(IMINE_TRAILER), "chassis_kg": 0.0}, "chassis_kg is 0 kg"),
    ],
)
def test_what_is_unknown_or_missing_is_named(name, parameters, message):
    with pytest.raises(InputError, match=message) as found:
        model_of(VehicleSetup(name, parameters))
    assert "\n" not in str(found.value)


def test_a_tyre_without_damping_need_not_say_so():
    names = "sprung_kg", "unsprung_kg", "suspension_n_per_m", "suspension_ns_per_m", "tyre_n_per_m"
    setup = VehicleSetup("quarter-car", dict.fromkeys(names, 100.0))
    assert model_of(setup).tyres[0].damping == 0.0
