"""Built-in devices: what they say of themselves is what floatref says of its pipelines."""

import pytest

import floatref
from floatref.errors import InputError
from floatref_conformance.classes import DeviceClass
from floatref_conformance.devices.builtin import CLAIMS, entries, make
from floatref_conformance.devices.interface import Description
from floatref_conformance.mutants.device import MUTANT

SMOOTHER = "kalman-smoother-reflection"


@pytest.mark.parametrize("entry", entries(), ids=lambda entry: entry.name)
def test_a_pipeline_declares_the_sensors_that_it_needs(entry):
    said = Description.of(make(entry.name).describe())
    assert said.capabilities == floatref.pipeline_capabilities(entry.name)
    kalman = entry.name.startswith("kalman")
    augmented = kalman or entry.name.endswith("-imu")
    assert ("imu" in said.capabilities) == augmented
    assert ("gnss" in said.capabilities) == (kalman and "constant-height" not in entry.name)
    assert ("roll_rate" in said.channels) == augmented


def test_the_smoother_with_reflection_alone_claims_to_be_adequate():
    claimed = {name for name, level in CLAIMS.items() if level is DeviceClass.ADEQUATE}
    assert claimed == {SMOOTHER}
    assert make(SMOOTHER).claims is DeviceClass.ADEQUATE
    assert make("kalman-smoother").claims is DeviceClass.NOMINAL


def test_a_mutant_has_the_sensors_of_the_pipeline_that_it_spoils():
    for name, capabilities in (("pitch-sign", ("imu", "gnss")), ("all-zeros", ())):
        said = Description.of(MUTANT.make(name).describe())
        assert (said.name, said.capabilities) == (name, capabilities)


def test_a_pipeline_that_there_is_not_has_no_capabilities():
    with pytest.raises(InputError, match="kalman"):
        floatref.pipeline_capabilities("kalman")
