"""Finding the plug-ins: one at a time, so that a broken one is reported and left out."""

from importlib.metadata import entry_points
from typing import Any, TypeVar

import pluggy

from floatref_conformance import hookspecs
from floatref_conformance.checks.interface import Check
from floatref_conformance.devices.interface import DeviceKind
from floatref_conformance.registry import Registry

Named = TypeVar("Named")
OWN = "floatref_conformance.defaults"
"""Name of the plug-in that holds the suite's own devices and checks."""


def load_registry() -> Registry:
    """Return everything that the suite itself and the installed plug-ins register."""
    from floatref_conformance import defaults

    manager = pluggy.PluginManager(hookspecs.GROUP)
    manager.add_hookspecs(hookspecs)
    manager.register(defaults, OWN)
    broken = _load_entry_points(manager)
    return collect(manager, broken)


def collect(manager: pluggy.PluginManager, broken: tuple[str, ...] = ()) -> Registry:
    """Return what the plug-ins of ``manager`` register, each either wholly or not at all."""
    kinds: dict[str, DeviceKind] = {}
    checks: dict[str, Check] = {}
    owners: dict[str, str] = {}
    for name, plugin in manager.list_name_plugin():
        new_kinds: list[DeviceKind] = []
        new_checks: list[Check] = []
        try:
            _call(manager, plugin, "conformance_register_devices", new_kinds)
            _call(manager, plugin, "conformance_register_checks", new_checks)
            added_kinds = _added(name, owners, kinds, {k.prefix: k for k in new_kinds})
            added_checks = _added(name, owners, checks, {c.id: c for c in new_checks})
        except Exception as error:
            broken += (_report(name, error),)
            continue
        kinds, checks = added_kinds, added_checks
        owners |= dict.fromkeys([k.prefix for k in new_kinds] + [c.id for c in new_checks], name)
    return Registry(kinds, checks, broken)


def _load_entry_points(manager: pluggy.PluginManager) -> tuple[str, ...]:
    broken: tuple[str, ...] = ()
    for point in sorted(entry_points(group=hookspecs.GROUP), key=lambda p: p.name):
        try:
            manager.register(point.load(), point.name)
        except Exception as error:
            broken += (_report(point.name, error),)
    return broken


def _call(manager: pluggy.PluginManager, plugin: Any, hook: str, into: list[Any]) -> None:
    others = [other for other in manager.get_plugins() if other is not plugin]
    manager.subset_hook_caller(hook, others)(register=into.append)


def _added(
    plugin: str, owners: dict[str, str], old: dict[str, Named], new: dict[str, Named]
) -> dict[str, Named]:
    for name in new.keys() & old.keys():
        raise ValueError(f"registers {name} again, which {owners[name]} registered")
    return {**old, **new}


def _report(plugin: str, error: Exception) -> str:
    text = " ".join(str(error).split())
    return f"plug-in {plugin}: {type(error).__name__}: {text}; it is left out"
