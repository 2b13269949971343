"""What the fields of a scenario may hold: types, limits and names."""

import re
from dataclasses import Field, field
from functools import cache
from reprlib import repr as shortened
from typing import Any, TypeVar

from floatref.errors import InputError
from floatref.files import read_schema
from floatref.values.display.similar_names import suggest

T = TypeVar("T")


def value(default: T, meaning: str) -> T:
    """Return a field of a scenario that is no number, with its meaning."""
    found: T = field(default=default, metadata={"meaning": meaning})
    return found


def number(default: T, lowest: float, highest: float, meaning: str) -> T:
    """Return a field of a scenario between two limits."""
    metadata = {"lowest": lowest, "highest": highest, "meaning": meaning}
    found: T = field(default=default, metadata=metadata)
    return found


def refuse_unknown(name: str, value: str, known: tuple[str, ...]) -> None:
    """Raise InputError unless ``value`` is among ``known``."""
    if value not in known:
        hint = suggest(value, known, "choose from")
        raise InputError(f"{name} {shortened(value)}: unknown; {hint}")


def in_type_of(described: Field[Any], value: Any) -> Any:
    """Return ``value`` in the type of the field's default; InputError names the field."""
    name, default = described.name, described.default
    if isinstance(default, tuple):
        return _track_names(value)
    if isinstance(default, bool | str):
        if type(value) is not type(default):
            raise InputError(f"{name} is {shortened(value)}; give {_kind(default)}")
        return value
    if isinstance(value, bool) or not isinstance(value, int | float) or value != value:
        raise InputError(f"{name} is {shortened(value)}; give a number")
    low, high = described.metadata["lowest"], described.metadata["highest"]
    if not low <= value <= high:
        found = shortened(value)
        raise InputError(f"{name} is {found}; it must lie between {low:g} and {high:g}")
    if isinstance(default, int):
        if value != int(value):
            raise InputError(f"{name} is {value}; give a whole number")
        return int(value)
    return float(value)


def _track_names(value: Any) -> tuple[str, ...]:
    """Return distinct names of wheel paths that can be part of a file name."""
    names = tuple(value) if isinstance(value, list | tuple) else ()
    named = all(isinstance(name, str) for name in names)
    if not (names and named and len(set(names)) == len(names)):
        raise InputError(
            f"tracks is {shortened(value)}; give a list of different names of wheel paths"
        )
    longest, pattern = _track_rule()
    for name in names:
        if len(name) > longest or not pattern.search(name):
            raise InputError(
                f"tracks has {shortened(name)}; a name has at most {longest} characters "
                "that can be part of a file name"
            )
    return names


@cache
def _track_rule() -> tuple[int, re.Pattern[str]]:
    """Return greatest length and pattern of a track's name in a recording directory."""
    rule = read_schema("floatref-recording-1")["$defs"]["track"]
    return rule["maxLength"], re.compile(rule["pattern"])


def _kind(default: bool | str) -> str:
    return "true or false" if isinstance(default, bool) else "a name in quotes"
