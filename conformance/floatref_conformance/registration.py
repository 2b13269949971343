"""What a plug-in may register: checks and kinds of devices with every member that is used."""

from collections.abc import Mapping
from collections.abc import Set as AbstractSet
from typing import Any

from floatref_conformance.checks.case import Case
from floatref_conformance.checks.interface import Check
from floatref_conformance.classes import DeviceClass
from floatref_conformance.devices.interface import NEEDS, DeviceEntry, DeviceKind


def sound_check(check: Check) -> Check:
    """Return ``check``; TypeError that names the first member that is missing or unusable."""
    what = f"check {_text(check, 'id', 'a check')}"
    for name in ("title", "clause", "derivation", "floor"):
        _text(check, name, what)
    for name in ("cases", "strategy", "scored", "judge"):
        _function(check, name, what)
    if not isinstance(_member(check, "simplest", what), Case):
        raise TypeError(f"{what}: simplest is {check.simplest!r}, not a Case")
    needs = _member(check, "needs", what)
    if not isinstance(needs, AbstractSet) or not needs <= set(NEEDS):
        raise TypeError(f"{what}: needs is {needs!r}, not a set of {', '.join(NEEDS)}")
    limits = _member(check, "limits", what)
    if not isinstance(limits, Mapping) or not all(map(_is_per_class, limits.values())):
        raise TypeError(f"{what}: limits do not give a text for each class of each quantity")
    return check


def sound_kind(kind: DeviceKind) -> DeviceKind:
    """Return ``kind``; TypeError that names the first member that is missing or unusable."""
    what = f"device kind {_text(kind, 'prefix', 'a device kind')}"
    if ":" in kind.prefix:
        raise TypeError(f"{what}: a prefix holds no colon")
    for name in ("argument", "usage"):
        _text(kind, name, what)
    for name in ("make", "entries"):
        _function(kind, name, what)
    for entry in kind.entries():
        if not isinstance(entry, DeviceEntry):
            raise TypeError(f"{what}: entries() gives a {type(entry).__name__}, not a DeviceEntry")
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
