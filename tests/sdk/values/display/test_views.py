"""Every view that a value asks for has a place, and its maker takes that value."""

import ast
import inspect
from importlib import import_module
from pathlib import Path

import pytest

import floatref
from floatref.values.display.views import placed_views, view

VALUES = Path(floatref.__file__).parent / "values"


def asked_for() -> dict[str, str]:
    """Return the class of values that asks for each view, by the view's name."""
    found = {}
    for path in VALUES.glob("*.py"):
        for kind in (
            n for n in ast.parse(path.read_text("utf-8")).body if isinstance(n, ast.ClassDef)
        ):
            for node in ast.walk(kind):
                if isinstance(node, ast.Call) and ast.unparse(node.func) == "view":
                    found[ast.literal_eval(node.args[0])] = kind.name
    return found


def test_every_view_that_is_asked_for_has_a_place_and_no_other() -> None:
    assert set(asked_for()) == set(placed_views())
    assert set(asked_for().values()) == {"Profile", "Recording"}


@pytest.mark.parametrize("name", placed_views())
def test_the_maker_takes_the_value_that_asks_alone(name: str) -> None:
    made = view(name)
    first, *others = inspect.signature(made).parameters.values()
    assert asked_for()[name] in str(first.annotation)
    assert all(other.default is not inspect.Parameter.empty for other in others)
    assert made.__module__ == placed_views()[name][0]
    assert import_module(made.__module__).__doc__


def test_an_unknown_view_has_no_place() -> None:
    with pytest.raises(KeyError, match="nothing"):
        view("nothing")
