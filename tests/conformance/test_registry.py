"""Devices and checks by name: what is unknown, not built, or cannot be made is refused."""

import pytest

from floatref.errors import InputError
from floatref_conformance.checks.catalogue import IDS
from floatref_conformance.devices.interface import DeviceEntry, DeviceKind
from floatref_conformance.plugins import load_registry
from floatref_conformance.registry import Registry


@pytest.mark.parametrize("error", [KeyError("x"), SystemExit(0), OSError("no\nlink")])
def test_a_kind_that_cannot_make_a_device_is_an_input_error(error):
    def make(name):
        raise error

    registry = Registry({"fake": DeviceKind("fake", "NAME", make)}, {})
    with pytest.raises(InputError, match=f"device fake:one: {type(error).__name__}: "):
        registry.device("fake:one")


def test_the_killers_of_a_check_are_the_devices_that_name_it():
    entries = (DeviceEntry("one", "a fake", ("stop",)), DeviceEntry("two", "a fake", ("bounce",)))
    kind = DeviceKind("fake", "NAME", str, lambda: entries)
    registry = Registry({"fake": kind}, {})
    assert registry.killers("bounce") == ("fake:two",)
    assert registry.killers("waveband") == ()


@pytest.mark.parametrize("spec", ["serial:COM1", "exec", "mutant", "", "builtin:"])
def test_a_kind_that_does_not_work_is_refused_with_those_that_do(spec):
    others = "exec:COMMAND LINE, container:IMAGE, files:DIR, mutant:NAME"
    with pytest.raises(InputError, match=f"builtin:PIPELINE, .* {others}"):
        load_registry().device(spec)


def test_an_unknown_mutant_or_check_is_refused_with_the_known_ones():
    with pytest.raises(
        InputError, match=r"mutant:nobody: unknown mutant; known: accelerometer-sign"
    ):
        load_registry().device("mutant:nobody")
    with pytest.raises(InputError, match=r"jumping: unknown check; .* quiescent, bounce"):
        load_registry().check("jumping")


@pytest.fixture
def few(toy_check):
    """A registry of three checks, one of them a plug-in's own."""
    checks = {id_: toy_check(id=id_) for id_ in ("quiescent", "bounce", "mine")}
    return Registry({}, checks)


def test_a_check_that_is_not_built_is_told_from_one_that_is_unknown(few):
    with pytest.raises(InputError, match=r"stop: not built yet; .* quiescent, bounce, mine"):
        few.check("stop")


def test_a_selection_keeps_the_suites_order_and_names_every_check_left_out(few):
    chosen, left_out = few.select(["bounce", "quiescent", "bounce"])
    assert [check.id for check in chosen] == ["quiescent", "bounce"]
    reasons = {left.id: left.reason for left in left_out}
    assert reasons.pop("mine") == "not selected"
    assert reasons == dict.fromkeys({*IDS} - {"quiescent", "bounce"}, "not built yet")
    chosen, left_out = few.select([])
    assert [check.id for check in chosen] == ["quiescent", "bounce", "mine"]
    assert {left.reason for left in left_out} == {"not built yet"}
