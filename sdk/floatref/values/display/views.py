"""Views of a value that a room above makes: drawings, measures, tables of other libraries.

`values` is the lowest room and does not import a room above it, so a value asks for a view by name.
The package itself, which knows all rooms, states where each is made; it is imported on first use.
"""

from collections.abc import Callable, Mapping
from importlib import import_module
from typing import Any, NamedTuple


class Place(NamedTuple):
    """Where a view is made: ``function``, called with the value alone, of ``module``."""

    module: str
    function: str


_places: dict[str, Place] = {}


def place_views(places: Mapping[str, Place]) -> None:
    """State where views are made, by name; one that is stated again has its new place."""
    _places.update(places)


def placed_views() -> Mapping[str, Place]:
    """Return where every view is made, by name."""
    return dict(_places)


def view(name: str) -> Callable[[Any], Any]:
    """Return the function that makes the view called ``name``; KeyError if it has no place."""
    place = _places[name]
    made: Callable[[Any], Any] = getattr(import_module(place.module), place.function)
    return made
