"""The page for readers of the dissertation: all that it names exists and cites its equation."""

import re
import sys
from pathlib import Path
from pkgutil import resolve_name

import pytest

import floatref

PAGE = (Path(__file__).parents[2] / "docs" / "equations.md").read_text(encoding="utf-8")
ROWS = re.findall(r"^\| \(([\dA]\.\d+)\) \| [^|]+ \| `([\w.]+)` \| `([\w.]+)` \|$", PAGE, re.M)
PIPELINES = re.findall(r"^\| \d\.\d \| `([\w-]+)` \| `([\w.]+)` \|$", PAGE, re.M)


def cited(text: str) -> set[tuple[str, int]]:
    """Return chapter and number of every equation in ``text``, ranges filled in."""
    found: set[tuple[str, int]] = set()
    for chapter, first, last in re.findall(
        r"\(([\dA])\.(\d+)\)(?:(?: to |[-–])\([\dA]\.(\d+)\))?", text
    ):
        found |= {(chapter, n) for n in range(int(first), int(last or first) + 1)}
    return found


@pytest.mark.parametrize(("equation", "reference", "used"), ROWS)
def test_what_is_named_exists_and_cites_the_equation(
    equation: str, reference: str, used: str
) -> None:
    chapter, number = equation.split(".")
    for name in (f"floatref_reference.{reference}", used):
        target = resolve_name(name)
        module = sys.modules[getattr(target, "__module__", name)]
        text = f"{target.__doc__} {module.__doc__}"
        assert (chapter, int(number)) in cited(text), name


def test_the_page_has_its_rows() -> None:
    assert len(ROWS) == len(re.findall(r"^\| \([\dA]\.\d+\)", PAGE, re.M)) > 20


def test_every_pipeline_has_its_reference() -> None:
    assert {name for name, _ in PIPELINES} == set(floatref.pipelines())
    for _, reference in PIPELINES:
        assert callable(resolve_name(f"floatref_reference.{reference}"))
