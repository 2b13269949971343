"""Views of a value that a room above makes: drawings, measures, tables of other libraries.

`values` is the lowest room and does not import a room above it, so a value asks for a view by name.
The package itself, which knows all rooms, states where each is made; it is imported on first use.
"""

from importlib import import_module

# As in typing, whose import takes as long as all of `import floatref`.
TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Mapping
    from typing import Any

Place = tuple[str, str]
"""Where a view is made: a module, and the function of it that is called with the value alone."""

_places: dict[str, Place] = {}


def place_views(places: "Mapping[str, Place]") -> None:
    """State where views are made, by name; one that is stated again has its new place."""
    _places.update(places)


def placed_views() -> "Mapping[str, Place]":
    """Return where every view is made, by name."""
    return dict(_places)


def view(name: str) -> "Callable[[Any], Any]":
    """Return the function that makes the view called ``name``; KeyError if it has no place."""
    module, function = _places[name]
    made: Callable[[Any], Any] = getattr(import_module(module), function)
    return made
