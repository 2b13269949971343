"""Mistakes about the vehicle change what is known of it, and nothing that was measured."""

import pytest

from floatref.values.clock import UniformClock
from floatref.values.recording import Channel, Recording, Setup
from floatref.values.vehicle_setup import VehicleSetup
from floatref_conformance.devices.builtin import BuiltinDevice
from floatref_conformance.devices.interface import Description
from floatref_conformance.mutants.in_processing import IN_RESPONSE

VEHICLE = VehicleSetup("quarter-car", {"unsprung_kg": 40.0, "tyre_n_per_m": 2e5}, 1.5)
CHANGED = {
    "tyre-forgotten": ("tyre_n_per_m", 100.0),
    "wheel-place-forgotten": ("x_m", 0.0),
    "wheel-mass-halved": ("unsprung_kg", 0.5),
}


def recording(vehicle):
    wheel = Channel.of("unsprung_specific_force", [9.0, 10.0], UniformClock.of(1.0), "left")
    return Recording((wheel,), Setup(vehicle=vehicle))


@pytest.mark.parametrize("mutation", IN_RESPONSE, ids=lambda mutation: mutation.name)
def test_one_number_of_the_vehicle_is_wrong_and_all_else_is_as_it_was(mutation):
    name, factor = CHANGED[mutation.name]
    before = recording(VEHICLE)
    after = mutation.before(before)
    known = {**VEHICLE.parameters, "x_m": VEHICLE.x_m}
    wrong = {**after.setup.vehicle.parameters, "x_m": after.setup.vehicle.x_m}
    assert wrong == {**known, name: factor * known[name]}
    assert after.channels is before.channels
    assert after.setup.tracks == before.setup.tracks


@pytest.mark.parametrize("mutation", IN_RESPONSE, ids=lambda mutation: mutation.name)
def test_where_nothing_is_known_nothing_can_be_wrong(mutation):
    unknown = recording(None)
    assert mutation.before(unknown) is unknown


@pytest.mark.parametrize("mutation", IN_RESPONSE, ids=lambda mutation: mutation.name)
def test_the_device_has_no_height_sensor(mutation):
    said = Description.of(BuiltinDevice(mutation.pipeline).describe())
    assert (said.architecture, said.capabilities) == ("response", ("response",))
