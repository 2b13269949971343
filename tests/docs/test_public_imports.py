"""Pages, examples and adapters import from `floatref` alone, and names that it has."""

import ast
import re
from pathlib import Path
from textwrap import dedent

import pytest

import floatref
import floatref_conformance

ROOT = Path(__file__).parents[2]
PAGES = sorted([ROOT / "README.md", *(ROOT / "docs").rglob("*.md")])
CODE = sorted([*(ROOT / "docs" / "examples").rglob("*.py"), *(ROOT / "adapters").rglob("*.py")])
OF_THE_JUDGE = {
    "floatref_conformance",
    "floatref_conformance.golden",
    "floatref_conformance.testing",
}


def breaches(source: str) -> list[str]:
    """Return the imports of ``source`` that are not public."""
    found = []
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.Import):
            found += [alias.name for alias in node.names if alias.name.startswith("floatref.")]
        elif isinstance(node, ast.ImportFrom) and node.module:
            names = [alias.name for alias in node.names]
            if node.module == "floatref":
                found += [f"floatref.{name}" for name in names if name not in floatref.__all__]
            elif node.module.startswith("floatref."):
                found.append(node.module)
            elif node.module.startswith("floatref_conformance"):
                found += [] if node.module in OF_THE_JUDGE else [node.module]
    return found


@pytest.mark.parametrize("path", [*PAGES, *CODE], ids=lambda path: str(path.relative_to(ROOT)))
def test_every_import_is_public(path: Path) -> None:
    text = path.read_text(encoding="utf-8")
    if path.suffix == ".py":
        assert breaches(text) == []
        return
    for block in re.findall(r"^ *```python\n(.*?)^ *```", text, re.M | re.S):
        assert breaches(dedent(block)) == []


@pytest.mark.parametrize(
    "line",
    [
        "import floatref.files",
        "from floatref.stages.protocol import Stage",
        "from floatref import stages",
        "from floatref_conformance.checks.interface import Check",
    ],
)
def test_a_deep_import_is_found(line: str) -> None:
    assert breaches(line)


def test_the_names_of_the_judge_are_there() -> None:
    for name in floatref_conformance.__all__:
        assert getattr(floatref_conformance, name) is not None
