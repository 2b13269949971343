"""Parameters in another unit, and wheels sampled too slowly, are refused in one line."""

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from floatref.engine.run import run
from floatref.errors import InputError
from floatref.values.clock import UniformClock
from floatref.values.recording import Channel, VehicleSetup
from floatref.vehicle_response import model_of
from floatref.vehicle_response.needs import check_sink, fastest_mode_hz

JOINT, OBSERVER = "response-joint-input-state", "response-observer"
TON_AND_NEWTON = (("sprung_kg", "unsprung_kg"), 1e-3), (("tyre_n_per_m",), 1e-3)
laws = settings(deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])


@pytest.mark.parametrize("pipeline", [JOINT, OBSERVER])
@pytest.mark.parametrize(("names", "unit"), TON_AND_NEWTON)
def test_another_unit_is_refused(drive, quarter_car, pipeline, names, unit):
    stated = quarter_car | {name: unit * quarter_car[name] for name in names}
    with pytest.raises(InputError, match="masses in kg and stiffnesses in N/m") as caught:
        run(drive(length_m=60.0, stated=stated).recording(), pipeline)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("name", ["half-car-with-equipment", "two-wheel-trailer"])
def test_the_vehicles_of_the_papers_are_vehicles(name):
    check_sink(model_of(VehicleSetup(name, {})))


@laws
@given(off=st.floats(0.2, 5.0), name=st.sampled_from(["sprung_kg", "unsprung_kg", "tyre_n_per_m"]))
def test_a_poor_guess_is_still_a_vehicle(quarter_car, off, name):
    stated = quarter_car | {name: off * quarter_car[name]}
    check_sink(model_of(VehicleSetup("quarter-car", stated)))


def test_the_fastest_mode_is_the_wheel_between_its_springs(quarter_car):
    light = quarter_car | {"suspension_ns_per_m": 1e-6, "sprung_kg": 1e5}
    stiffness = light["suspension_n_per_m"] + light["tyre_n_per_m"]
    known = np.sqrt(stiffness / light["unsprung_kg"]) / (2.0 * np.pi)
    found = fastest_mode_hz(model_of(VehicleSetup("quarter-car", light)))
    assert found == pytest.approx(known, rel=1e-3)


@pytest.mark.parametrize("pipeline", [JOINT, OBSERVER])
def test_a_wheel_that_is_sampled_too_slowly_is_refused(drive, pipeline):
    known = drive(length_m=100.0)
    force = known.recording().channel("unsprung_specific_force", "left")
    slow = Channel.of("unsprung_specific_force", force.values[::25], UniformClock.of(40.0), "left")
    with pytest.raises(InputError, match=r"40 samples per second.* needs 8") as caught:
        run(known.recording(unsprung_specific_force=slow), pipeline)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(("name", "most"), [("contact_m", 2), ("denoise_window_s", 5)])
def test_lengths_beyond_reason_are_refused(drive, name, most):
    wanted = {"denoise_components": 3.0, name: 1e6}
    with pytest.raises(InputError, match=f"setting {name} is 1e.06; .* up to {most}"):
        run(drive(length_m=20.0).recording(), JOINT, wanted)
