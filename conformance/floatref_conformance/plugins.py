"""Finding the plug-ins: one at a time, so that a broken one is reported and left out."""

from collections.abc import Callable, Mapping
from importlib.metadata import entry_points
from typing import TypeVar

import pluggy

from floatref_conformance import hookspecs
from floatref_conformance.checks.interface import Check
from floatref_conformance.devices.interface import DeviceKind
from floatref_conformance.registration import sound_check, sound_kind
from floatref_conformance.registry import Registry

Named = TypeVar("Named")
OWN = "floatref_conformance.defaults"
"""Name of the plug-in that holds the suite's own devices and checks."""


def load_registry() -> Registry:
    """Return everything that the suite itself and the installed plug-ins register."""
    from floatref_conformance import defaults

    plugins: dict[str, Callable[[], object]] = {OWN: lambda: defaults}
    for point in sorted(entry_points(group=hookspecs.GROUP), key=lambda p: p.name):
        plugins[point.name] = point.load
    return collect(plugins)


def collect(plugins: Mapping[str, Callable[[], object]]) -> Registry:
    """Return what each of ``plugins`` registers, wholly or not at all.

    Each is given as the function that loads it. One that raises or ends the process, registers
    something incomplete, or takes a name that an earlier one has, is left out and reported.
    """
    kinds: dict[str, DeviceKind] = {}
    checks: dict[str, Check] = {}
    owners: dict[str, str] = {}
    broken: list[str] = []
    for name, load in plugins.items():
        try:
            new_kinds, new_checks = _registered(name, load())
            _refuse_taken(owners, (*new_kinds, *new_checks))
        except (Exception, SystemExit) as error:
            text = " ".join(str(error).split())
            broken.append(f"plug-in {name}: {type(error).__name__}: {text}; it is left out")
            continue
        kinds |= new_kinds
        checks |= new_checks
        owners |= dict.fromkeys((*new_kinds, *new_checks), name)
    return Registry(kinds, checks, tuple(broken))


def _registered(name: str, plugin: object) -> tuple[dict[str, DeviceKind], dict[str, Check]]:
    """Return what ``plugin`` registers; it has a manager of its own, so it breaks alone."""
    manager = pluggy.PluginManager(hookspecs.GROUP)
    manager.add_hookspecs(hookspecs)
    manager.register(plugin, name)
    kinds: list[DeviceKind] = []
    checks: list[Check] = []
    manager.hook.conformance_register_devices(register=lambda kind: kinds.append(sound_kind(kind)))
    manager.hook.conformance_register_checks(
        register=lambda check: checks.append(sound_check(check))
    )
    _refuse_repeated([*(kind.prefix for kind in kinds), *(check.id for check in checks)])
    return {kind.prefix: kind for kind in kinds}, {check.id: check for check in checks}


def _refuse_repeated(names: list[str]) -> None:
    for name in names:
        if names.count(name) > 1:
            raise ValueError(f"registers {name} twice")


def _refuse_taken(owners: Mapping[str, str], names: tuple[str, ...]) -> None:
    for name in names:
        if name in owners:
            raise ValueError(f"registers {name} again, which {owners[name]} registered")
