"""Plain English: words that stop a reader whose second language is English are not used."""

import ast
import re
from collections.abc import Iterable, Iterator
from functools import cache
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
ROOMS = ("sdk", "adapters", "conformance", "reference_impl")
PATTERNS = {
    "told": r"\btold\b",
    "vouched for": r"\bvouch\w* for\b",
    "so many times what speaks against": r"\bso many times\b",
    "a word": r"\ba word\b",
    "said": r"\bsaid\b",
    "none": r"\bnone\b",
    "injury": r"\binjur\w+",
    "spoiling": r"\bspoil\w*",
    "mistake": r"\bmistak\w+",
}
ALLOWED: dict[str, dict[str, str]] = {
    "adapters/floatref_adapters/formats/csv_table/table_fields.py": {
        "none": "text in a user's file"
    },
    "adapters/floatref_adapters/shared/time_columns.py": {"none": "the value of an option"},
    "conformance/floatref_conformance/certify/worksheet/worksheet_document.py": {
        "said": "a key of the worksheet's JSON"
    },
    "conformance/floatref_conformance/checks/case.py": {"none": "a value of a key"},
    "conformance/floatref_conformance/devices/containers/engine.py": {
        "none": "the value of an option of podman"
    },
    "conformance/floatref_conformance/matrix/templates/matrix.html.j2": {"list-style: none": "CSS"},
    "docs/build-servers.md": {"`--network none`": "the value of an option of podman"},
    "conformance/floatref_conformance/cli/certify/command.py": {"none:": "the value of an option"},
    "conformance/floatref_conformance/cli/certify/certify_options.py": {
        "none": "the value of an option"
    },
    "conformance/floatref_conformance/proving_ground/scenario.py": {"none": "a value of a key"},
    "conformance/floatref_conformance/render/junit.py": {"none": "a value that scripts read"},
    "conformance/floatref_conformance/render/templates/page.html.j2": {"'none'": "HTML"},
    "conformance/floatref_conformance/render/templates/parts.html.j2": {"is not none": "Jinja"},
    "docs/embedded.md": {"arm-none-eabi": "the name of a compiler"},
    "docs/certify.md": {"`none`": "the value of an option"},
    "docs/scenario.md": {"none": "a value of a key"},
    "docs/native-files.md": {"clock `none`": "a value in the output of `floatref channels`"},
    "docs/road-prior-limits.md": {"| none |": "a value of the table's data file"},
    "docs/your-format.md": {"status=none": "an option of dd"},
    "sdk/floatref/cli/channels.py": {"none": "a value in the output of `floatref channels`"},
    "sdk/floatref/live/monitor/page_server.py": {"'none'": "a value of a header"},
    "sdk/floatref/mapping/channel_map/units.py": {"none": "a unit as files write it"},
}
"""By file, a part of the line and why it may stand there."""
Line = tuple[str, int, str]


def lines_of_code() -> Iterator[Line]:
    """Yield every line of the docstrings and texts of our packages."""
    for path in (p for room in ROOMS for p in sorted((ROOT / room).rglob("*.py"))):
        name = path.relative_to(ROOT).as_posix()
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Constant) and isinstance(node.value, str):
                for k, line in enumerate(node.value.splitlines()):
                    yield name, node.lineno + k, line


def lines_of_pages() -> Iterator[Line]:
    """Yield every line of the pages, and of the templates and data that users read."""
    pages = [*(ROOT / "docs").rglob("*.md"), ROOT / "README.md", ROOT / "CONTRIBUTING.md"]
    texts = (*(ROOT / "conformance").rglob("*.j2"), *(ROOT / "conformance").rglob("*.toml"))
    # Decisions are not edited once they are superseded.
    for path in sorted(p for p in (*pages, *texts) if p.parent.name != "decisions"):
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
            yield path.relative_to(ROOT).as_posix(), number, line


@cache
def every_line() -> tuple[Line, ...]:
    """Return all lines of code and pages, read once."""
    return (*lines_of_code(), *lines_of_pages())


def hits(lines: Iterable[Line], pattern: str) -> list[str]:
    """Return the lines with ``pattern`` that are not allowed."""
    return [
        f"{name}:{number}: {line.strip()}"
        for name, number, line in lines
        if re.search(pattern, line) and not any(part in line for part in ALLOWED.get(name, ()))
    ]


@pytest.mark.parametrize("word", PATTERNS)
def test_no_text_has_the_word(word: str) -> None:
    found = hits(every_line(), PATTERNS[word])
    assert not found, "\n".join(found)


def test_what_is_allowed_is_still_there() -> None:
    there = dict.fromkeys(ALLOWED, "")
    for name, _, line in every_line():
        if name in there:
            there[name] += f"{line}\n"
    lost = [(n, part) for n, parts in ALLOWED.items() for part in parts if part not in there[n]]
    assert not lost


@pytest.mark.parametrize("word", PATTERNS)
def test_a_planted_word_is_found(word: str) -> None:
    planted = [("a.md", 1, f"Here is {word} to be found.")]
    assert hits(planted, PATTERNS[word])
