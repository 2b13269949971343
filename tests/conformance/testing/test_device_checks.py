"""The checks as a vendor's tests: a device that fails one fails its test, and says how."""

import pytest

from floatref_conformance.checks.catalogue import IDS
from floatref_conformance.testing import DeviceChecks


def ids_of(cls):
    mark = next(m for m in cls.test_the_device_passes.pytestmark if m.name == "parametrize")
    return tuple(mark.args[1])


def test_every_check_is_a_test():
    assert ids_of(DeviceChecks) == tuple(IDS)


def test_a_sound_device_passes():
    class Sound(DeviceChecks):
        checks = ("quiescent",)

    Sound().test_the_device_passes("quiescent")


def test_a_wrong_device_fails_with_the_command_that_shows_it_again():
    class Wrong(DeviceChecks):
        device = "mutant:scaled"

    with pytest.raises(pytest.fail.Exception, match=r"quiescent: .*conformance run --device"):
        Wrong().test_the_device_passes("quiescent")


def test_what_is_not_selected_is_skipped_not_passed():
    class Few(DeviceChecks):
        checks = ("bounce",)

    with pytest.raises(pytest.skip.Exception, match="not selected"):
        Few().test_the_device_passes("quiescent")


def test_a_device_may_be_an_object():
    class Broken:
        def describe(self):
            return {"name": "b", "version": "1", "architecture": "temporal", "capabilities": []}

        def run(self, recording, profile):
            raise RuntimeError("no power")

    class Ours(DeviceChecks):
        device = Broken()

    with pytest.raises(pytest.fail.Exception, match="no power"):
        Ours().test_the_device_passes("quiescent")
