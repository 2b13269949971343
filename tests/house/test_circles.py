"""No circle of imports in the four packages, those inside functions included."""

import ast
from collections.abc import Iterator, Mapping
from graphlib import CycleError, TopologicalSorter
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
PACKAGES = {
    "sdk": "floatref",
    "adapters": "floatref_adapters",
    "reference_impl": "floatref_reference",
    "conformance": "floatref_conformance",
}
FALL_BACK = "floatref.builtin_pipelines.plugin"
PROCESSING = "floatref.engine.run"


def sources() -> dict[str, str]:
    """Return the code of all modules by name; a package's ends in ``.__init__``."""
    return {
        ".".join(path.relative_to(ROOT / folder).with_suffix("").parts): path.read_text("utf-8")
        for folder, package in PACKAGES.items()
        for path in (ROOT / folder / package).rglob("*.py")
    }


def imported(node: ast.AST, is_package: bool) -> Iterator[str]:
    """Yield what ``node`` imports.

    Imports for type checkers count in a package's own module alone: there they name what is
    imported on first use.
    """
    if isinstance(node, ast.If) and "TYPE_CHECKING" in ast.unparse(node.test) and not is_package:
        return
    if isinstance(node, ast.Import):
        yield from (alias.name for alias in node.names)
    if isinstance(node, ast.ImportFrom):
        yield from (f"{node.module}.{alias.name}" for alias in node.names)
    for child in ast.iter_child_nodes(node):
        yield from imported(child, is_package)


def module_of(name: str, known: Mapping[str, str]) -> str:
    """Return the module of ``known`` called ``name``, or that holds it; "" if there is none."""
    holder = name.rpartition(".")[0]
    candidates = (name, f"{name}.__init__", holder, f"{holder}.__init__")
    return next((module for module in candidates if module in known), "")


def imports(known: Mapping[str, str]) -> dict[str, set[str]]:
    """Return which of ``known``, code by module, every module imports."""
    found = {}
    for name, code in known.items():
        names = imported(ast.parse(code), name.endswith(".__init__"))
        found[name] = {module_of(each, known) for each in names} - {"", name}
    return found


def circle(known: Mapping[str, str]) -> list[str]:
    """Return a circle of imports, from a module back to itself; empty if there is none."""
    try:
        TopologicalSorter(imports(known)).prepare()
    except CycleError as error:
        return list(error.args[1])
    return []


@pytest.mark.slow
def test_no_module_imports_itself_by_way_of_others() -> None:
    assert circle(sources()) == []


def test_imports_inside_functions_are_among_those_that_count() -> None:
    code = {"a": "def f():\n    from b import g\n", "b": ""}
    assert imports(code) == {"a": {"b"}, "b": set()}


@pytest.mark.slow
@pytest.mark.parametrize(
    "planted",
    [
        f"import {PROCESSING}",
        f"def f():\n    from {PROCESSING} import run",
        "def f():\n    from floatref import process",
        "from floatref.engine import run",
    ],
)
def test_a_planted_circle_is_found(planted: str) -> None:
    known = sources()
    known[FALL_BACK] += f"\n{planted}\n"
    assert FALL_BACK in circle(known)
