"""Find the plug-ins, load them one by one, and verify what they register."""

from collections.abc import Callable, Mapping
from collections.abc import Set as AbstractSet
from importlib.metadata import entry_points
from typing import Any, TypeVar

import pluggy

from floatref_conformance import hookspecs
from floatref_conformance.checks.case import Case
from floatref_conformance.checks.interface import Check
from floatref_conformance.classes import DeviceClass
from floatref_conformance.devices.interface import NEEDS, DeviceEntry, DeviceKind
from floatref_conformance.editions import EDITION
from floatref_conformance.registry import Registry


def verify_check(check: Check) -> Check:
    """Return ``check``; TypeError with the name of the first missing or unusable member."""
    what = f"check {_text(check, 'id', 'a check')}"
    for name in ("title", "clause", "derivation", "floor"):
        _text(check, name, what)
    for name in ("cases", "strategy", "list_scored", "judge"):
        _function(check, name, what)
    if not isinstance(_member(check, "simplest", what), Case):
        raise TypeError(f"{what}: simplest is {check.simplest!r}, not a Case")
    needs = _member(check, "needs", what)
    if not isinstance(needs, AbstractSet) or not needs <= set(NEEDS):
        raise TypeError(f"{what}: needs is {needs!r}, not a set of {', '.join(NEEDS)}")
    limits = _member(check, "limits", what)
    if not isinstance(limits, Mapping) or not all(map(_is_per_class, limits.values())):
        raise TypeError(f"{what}: limits has no text for some class of some quantity")
    return check


def verify_kind(kind: DeviceKind) -> DeviceKind:
    """Return ``kind``; TypeError with the name of the first missing or unusable member."""
    what = f"device kind {_text(kind, 'prefix', 'a device kind')}"
    if ":" in kind.prefix:
        raise TypeError(f"{what}: a prefix may not contain a colon")
    for name in ("argument", "usage"):
        _text(kind, name, what)
    for name in ("make", "entries"):
        _function(kind, name, what)
    for entry in kind.entries():
        if not isinstance(entry, DeviceEntry):
            raise TypeError(
                f"{what}: entries() returns a {type(entry).__name__}, not a DeviceEntry"
            )
    return kind


def _member(thing: object, name: str, what: str) -> Any:
    if not hasattr(thing, name):
        raise TypeError(f"{what}: a {type(thing).__name__} without {name}")
    return getattr(thing, name)


def _text(thing: object, name: str, what: str) -> str:
    value = _member(thing, name, what)
    if not isinstance(value, str) or not value:
        raise TypeError(f"{what}: {name} is {value!r}, not a text")
    return value


def _function(thing: object, name: str, what: str) -> None:
    value = _member(thing, name, what)
    if isinstance(thing, type) or not callable(value):
        raise TypeError(f"{what}: {name} cannot be called; register an object that has it")


def _is_per_class(limits: object) -> bool:
    return isinstance(limits, Mapping) and all(isinstance(limits.get(c), str) for c in DeviceClass)


Named = TypeVar("Named")
OWN = "floatref_conformance.own_plugin"
"""Name of the plug-in that holds the suite's own devices and checks."""


def load_registry(edition: str = EDITION) -> Registry:
    """Return everything that the suite itself, as ``edition`` has it, and plug-ins register.

    Raises InputError for an unknown edition.
    """
    from floatref_conformance.editions.edition import find_edition
    from floatref_conformance.own_plugin import OwnPlugin

    own = OwnPlugin(find_edition(edition))
    plugins: dict[str, Callable[[], object]] = {OWN: lambda: own}
    for point in sorted(entry_points(group=hookspecs.GROUP), key=lambda p: p.name):
        plugins[point.name] = point.load
    return collect(plugins)


def collect(plugins: Mapping[str, Callable[[], object]]) -> Registry:
    """Return what the ``plugins`` register, given by name as the function that loads each.

    A plug-in is left out as a whole, and reported, if it raises or exits, registers something
    incomplete, or uses a name that an earlier plug-in has registered.
    """
    kinds: dict[str, DeviceKind] = {}
    checks: dict[str, Check] = {}
    owners: dict[str, str] = {}
    broken: list[str] = []
    for name, load in plugins.items():
        try:
            new_kinds, new_checks = _call_hooks(name, load())
            _refuse_taken(owners, (*new_kinds, *new_checks))
        except KeyboardInterrupt:
            raise
        except BaseException as error:
            text = " ".join(str(error).split())
            broken.append(f"plug-in {name}: {type(error).__name__}: {text}; it is left out")
            continue
        kinds |= new_kinds
        checks |= new_checks
        owners |= dict.fromkeys((*new_kinds, *new_checks), name)
    return Registry(kinds, checks, tuple(broken))


def _call_hooks(name: str, plugin: object) -> tuple[dict[str, DeviceKind], dict[str, Check]]:
    """Return what ``plugin`` registers; its own manager isolates it from the other plug-ins."""
    manager = pluggy.PluginManager(hookspecs.GROUP)
    manager.add_hookspecs(hookspecs)
    manager.register(plugin, name)
    kinds: list[DeviceKind] = []
    checks: list[Check] = []
    manager.hook.conformance_register_devices(register=lambda kind: kinds.append(verify_kind(kind)))
    manager.hook.conformance_register_checks(
        register=lambda check: checks.append(verify_check(check))
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
