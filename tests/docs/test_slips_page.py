"""The page on slips in print: every slip has a check that exists, and every check its slip."""

import ast
import re
from pathlib import Path

import pytest

TESTS = Path(__file__).parent / "slips"
PAGE = (Path(__file__).parents[2] / "docs" / "slips.md").read_text(encoding="utf-8")
ENTRIES = re.findall(r"^### (.+?) \{ #[\w-]+ \}\n\n(.+?)(?=^##|\Z)", PAGE, re.M | re.S)
FIELDS = ("Printed", "Meant", "Evidence")


def checks(text: str) -> set[str]:
    return set(re.findall(r"`(test_\w+\.py::test_\w+)`", text))


def test_every_check_is_on_the_page_and_there() -> None:
    found = {
        f"{path.name}::{node.name}"
        for path in TESTS.glob("test_*.py")
        for node in ast.parse(path.read_text(encoding="utf-8")).body
        if isinstance(node, ast.FunctionDef) and node.name.startswith("test_")
    }
    assert checks(PAGE) == found


def test_every_slip_is_an_entry() -> None:
    assert len(ENTRIES) == PAGE.count("\n### ")


@pytest.mark.parametrize(("title", "text"), ENTRIES, ids=[title for title, _ in ENTRIES])
def test_a_slip_says_what_is_printed_meant_and_checked(title: str, text: str) -> None:
    for field in FIELDS:
        assert f"- **{field}:** " in text, title
    assert checks(text), title
