"""The plug-in mechanism: the suite's own plug-in, others, and broken ones."""

import inspect
import sys
from dataclasses import replace
from importlib.metadata import EntryPoint, EntryPoints
from types import ModuleType, SimpleNamespace

import pytest

from floatref_conformance import hookspecs, plugins
from floatref_conformance.checks.catalogue import IDS
from floatref_conformance.devices.interface import DeviceEntry, DeviceKind
from floatref_conformance.editions.edition import find_edition
from floatref_conformance.hookspecs import hookimpl
from floatref_conformance.own_plugin import OwnPlugin
from floatref_conformance.proving_ground.scenario import Scenario

OWN = OwnPlugin(find_edition())


def plugin(devices=None, checks=None):
    hooks = {}
    if devices:
        hooks["conformance_register_devices"] = hookimpl(devices)
    if checks:
        hooks["conformance_register_checks"] = hookimpl(checks)
    return SimpleNamespace(**hooks)


def collected(**others):
    loaders = {plugins.OWN: OWN, **others}
    return plugins.collect({name: lambda p=p: p for name, p in loaders.items()})


@pytest.fixture
def kind(fake_device):
    entries = (DeviceEntry("one", "a fake", ("bounce",)),)
    return DeviceKind("fake", "NAME", lambda name: fake_device(), lambda: entries)


def test_the_suites_own_devices_and_checks_come_from_a_plugin():
    registry = collected()
    assert set(registry.kinds) == {"builtin", "python", "exec", "container", "files", "mutant"}
    assert list(registry.checks) == [id_ for id_ in IDS if id_ in registry.checks]
    assert {"quiescent", "bounce"} <= set(registry.checks)
    assert registry.broken == ()


def test_a_plugin_adds_devices_and_checks(kind, toy_check, fake_device):
    def devices(register):
        register(kind)

    def checks(register):
        register(toy_check())

    registry = collected(vendor=plugin(devices, checks))
    assert isinstance(registry.device("fake:one"), fake_device)
    assert "toy" in registry.checks
    assert "fake:one" in registry.killers("bounce")


def test_a_plugin_that_raises_is_left_out_wholly_and_reported(kind, toy_check):
    def devices(register):
        register(kind)
        raise RuntimeError("no\nlicence")

    def checks(register):
        register(toy_check())

    registry = collected(bad=plugin(devices), good=plugin(None, checks))
    assert registry.broken == ("plug-in bad: RuntimeError: no licence; it is left out",)
    assert "fake" not in registry.kinds
    assert "toy" in registry.checks


def test_a_name_that_is_taken_leaves_the_second_plugin_out_and_names_both(toy_check):
    def checks(register):
        register(toy_check(id="bounce"))

    registry = collected(vendor=plugin(None, checks))
    assert registry.checks["bounce"].clause != "Toy 1.2"
    assert "vendor" in registry.broken[0]
    assert plugins.OWN in registry.broken[0]


def test_a_plugin_that_takes_a_name_twice_is_left_out(kind):
    def devices(register):
        register(kind)
        register(kind)

    registry = collected(vendor=plugin(devices))
    assert registry.broken == ("plug-in vendor: ValueError: registers fake twice; it is left out",)


def test_what_is_no_check_or_kind_is_reported(kind):
    registry = collected(vendor=plugin(lambda register: register("a device")))
    assert len(registry.broken) == 1


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"title": None}, "check toy: title is None"),
        ({"clause": ""}, "check toy: clause is ''"),
        ({"derivation": 5}, "derivation is 5"),
        ({"floor": None}, "floor is None"),
        ({"id": None}, "id is None"),
        ({"needs": ("imu",)}, "needs is ('imu',), not a set"),
        ({"needs": frozenset({"radar"})}, "not a set of height, imu, gnss"),
        ({"limits": None}, "limits has no text"),
        ({"limits": {"IRI": {"nominal": "1"}}}, "limits has no text"),
    ],
)
def test_a_check_with_an_unusable_member_is_left_out_and_reported(toy_check, changes, words):
    check = toy_check(**changes)
    registry = collected(vendor=plugin(None, lambda register: register(check)))
    assert set(registry.checks) == set(collected().checks)
    assert registry.broken[0].startswith("plug-in vendor: TypeError: ")
    assert words in registry.broken[0]


def test_a_check_without_a_member_is_left_out_and_the_member_named():
    check = SimpleNamespace(id="bad")
    registry = collected(vendor=plugin(None, lambda register: register(check)))
    assert registry.broken == (
        "plug-in vendor: TypeError: check bad: a SimpleNamespace without title; it is left out",
    )


@pytest.mark.parametrize(
    ("name", "value", "words"),
    [
        ("strategy", None, "check toy: strategy cannot be called"),
        ("list_scored", None, "check toy: list_scored cannot be called"),
        ("judge", "by eye", "check toy: judge cannot be called"),
        ("simplest", Scenario(), "check toy: simplest is Scenario("),
        ("simplest", None, "check toy: simplest is None, not a Case"),
    ],
)
def test_a_check_that_could_not_be_searched_or_made_simpler_is_left_out(
    toy_check, name, value, words
):
    check = type("Unsearchable", (toy_check,), {name: value})()
    registry = collected(vendor=plugin(None, lambda register: register(check)))
    assert "toy" not in registry.checks
    assert words in registry.broken[0]


def test_a_class_in_place_of_a_check_is_left_out(toy_check):
    registry = collected(vendor=plugin(None, lambda register: register(toy_check)))
    assert len(registry.broken) == 1


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"prefix": ""}, "prefix is ''"),
        ({"prefix": "a:b"}, "a colon"),
        ({"argument": None}, "argument is None"),
        ({"make": None}, "make cannot be called"),
        ({"entries": ()}, "entries cannot be called"),
        ({"entries": lambda: ("one",)}, "returns a str, not a DeviceEntry"),
        ({"entries": lambda: 1 / 0}, "ZeroDivisionError"),
    ],
)
def test_a_kind_with_an_unusable_member_is_left_out_and_reported(kind, changes, words):
    changed = replace(kind, **changes)
    registry = collected(vendor=plugin(lambda register: register(changed)))
    assert set(registry.kinds) == set(collected().kinds)
    assert words in registry.broken[0]


def test_a_plugin_that_ends_the_process_is_left_out_and_reported():
    def leaving():
        sys.exit(7)

    registry = plugins.collect({plugins.OWN: lambda: OWN, "vendor": leaving})
    assert registry.broken == ("plug-in vendor: SystemExit: 7; it is left out",)
    assert "bounce" in registry.checks


def test_entry_points_are_loaded_one_at_a_time(monkeypatch, toy_check):
    good = ModuleType("good_conformance_plugin")

    def checks(register):
        register(toy_check())

    good.conformance_register_checks = hookimpl(checks)
    monkeypatch.setitem(sys.modules, "good_conformance_plugin", good)
    points = EntryPoints(
        EntryPoint(name, module, hookspecs.GROUP)
        for name, module in (("a-bad", "no_such_module_here"), ("z", "good_conformance_plugin"))
    )
    monkeypatch.setattr(plugins, "entry_points", lambda group: points.select(group=group))
    registry = plugins.load_registry()
    assert "toy" in registry.checks
    assert len(registry.broken) == 1
    assert "plug-in a-bad: ModuleNotFoundError" in registry.broken[0]


def test_every_hook_is_documented_fits_one_screen_and_is_never_firstresult():
    hooks = [f for n, f in vars(hookspecs).items() if n.startswith("conformance_register_")]
    assert len(hooks) == 2
    assert all("register" in hook.__doc__ for hook in hooks)
    assert "firstresult" not in inspect.getsource(hookspecs)
    assert len(inspect.getsource(hookspecs).splitlines()) <= 50
