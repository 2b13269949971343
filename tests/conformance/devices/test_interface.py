"""What a device is given and owes follows from its architecture and its capabilities alone."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from floatref.values.channels import CHANNELS
from floatref.values.clock import UniformClock
from floatref.values.recording import Channel, Recording, Setup
from floatref.values.vehicle_setup import VehicleSetup
from floatref_conformance.devices.interface import (
    ARCHITECTURES,
    CAPABILITIES,
    NEEDS,
    NOMINAL_CHANNELS,
    Description,
    visible,
)
from floatref_conformance.errors import DeviceError

SAID = st.fixed_dictionaries(
    {
        "name": st.just("one"),
        "version": st.just("1"),
        "architecture": st.sampled_from(ARCHITECTURES),
        "capabilities": st.lists(st.sampled_from(list(CAPABILITIES)), unique=True),
    }
)
SOUND = SAID.filter(
    lambda said: said["architecture"] != "response" or "response" in said["capabilities"]
)
EVERYTHING = Recording(
    tuple(Channel.of(name, [1.0, 2.0], UniformClock.of(1.0)) for name in CHANNELS),
    Setup(vehicle=VehicleSetup("quarter-car", {"sprung_kg": 500.0})),
    "telling",
    "names",
)


def test_every_channel_is_nominal_or_of_one_capability():
    given_by = [NOMINAL_CHANNELS, *CAPABILITIES.values()]
    assert sorted(name for names in given_by for name in names) == sorted(CHANNELS)


@given(said=SOUND)
def test_without_a_height_sensor_there_is_no_height_and_all_else_is_the_same(said):
    described, without = Description.of(said), said["architecture"] == "response"
    seen = {c.id.name for c in visible(EVERYTHING, described.channels).channels}
    declared = NOMINAL_CHANNELS.union(*(CAPABILITIES[c] for c in said["capabilities"]))
    assert seen == declared - ({"height"} if without else set())
    assert ("height" in described.meets) != without
    assert described.meets - {"height"} == set(said["capabilities"])
    assert described.owes in seen
    assert described.owes == ("unsprung_specific_force" if without else "height")


@given(said=SOUND)
def test_the_vehicle_is_told_to_those_alone_who_see_its_response(said):
    seen = visible(EVERYTHING, Description.of(said).channels)
    vehicle = EVERYTHING.setup.vehicle
    assert seen.setup.vehicle == (vehicle if "response" in said["capabilities"] else None)
    assert seen.setup.profile_interval_m == EVERYTHING.setup.profile_interval_m
    assert (seen.vendor, seen.model) == ("", "")


@given(said=SAID)
def test_the_architecture_response_needs_the_capability_and_one_line_says_so(said):
    if said["architecture"] == "response" and "response" not in said["capabilities"]:
        with pytest.raises(DeviceError, match="without capability response; declare it") as caught:
            Description.of(said)
        assert "\n" not in str(caught.value)
    else:
        assert Description.of(said).capabilities == tuple(said["capabilities"])


def test_whatever_can_be_needed_is_a_capability_or_the_height_sensor():
    assert set(NEEDS) == {"height", *CAPABILITIES}
