"""What sources and tests cite of the dissertation and of two papers, read without importing them.

A docstring cites "(2.9)", "(2.12) to (2.16)" or "Tables 2.4 to 2.6"; a test cites the same in
`@pytest.mark.cites("(2.9)")`, or for its whole file in `pytestmark`. Of the papers it cites
"(7) of Zhu", "step (a) of Zhu", "Table 1 of Zhu" or "section 4.3 of Zhu"; their own packages in the
reference leave out the "of Zhu".
"""

import ast
import re
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from typing import NamedTuple

ROOT = Path(__file__).parents[1]
ROOMS = {
    "floatref": "sdk",
    "floatref_reference": "reference_impl",
    "floatref_conformance": "conformance",
}
EQUATION = re.compile(r"\(([\dAC])\.(\d+)\)(?:(?: to |[-–])\([\dAC]\.(\d+)\))?")
TABLE = re.compile(r"Tables? ([\dA])\.(\d+)(?:( to | and )[\dA]\.(\d+))?")
SECTION = re.compile(r"[Ss]ection (\d(?:\.\d+)+)\b(?!\.\d| of (?:Zhu|Imine))")
PAPERS = {"floatref_reference.zhu_2021": "Zhu", "floatref_reference.imine": "Imine"}
NUMBERED = re.compile(r"\((\d+|[a-c])\)(?: to \((\d+)\))?")
NUMBERED_OF = re.compile(
    r"((?:\((?:\d+|[a-c])\)(?:,\s| and | to )?)+)\s+of\s+(Zhu|Imine)(?: and of (Zhu|Imine))?"
)
PART = re.compile(r"([Ss]ection|Table) (\d(?:\.\d+)*)\b")
PART_OF = re.compile(r"((?:[Ss]ection|Table) \d(?:\.\d+)*)\s+of\s+(Zhu|Imine)")


class Test(NamedTuple):
    """A test that cites: its file, its name and the packages that its file imports."""

    path: str
    name: str
    packages: frozenset[str]


def cited(text: str, paper: str = "") -> set[str]:
    """Return all that ``text`` cites, ranges filled in: "(2.9)", "Table 2.4", "section 5.4".

    What a text of ``paper`` cites without saying of whom is of that paper: "(7) of Zhu".
    """
    if paper:
        return _cited_of(text, paper)
    found = {f"section {number}" for number in SECTION.findall(text)}
    for chapter, first, last in EQUATION.findall(text):
        found |= {f"({chapter}.{n})" for n in range(int(first), int(last or first) + 1)}
    for chapter, first, joint, last in TABLE.findall(text):
        numbers = {int(first), int(last or first)}
        if joint == " to ":
            numbers = set(range(int(first), int(last) + 1))
        found |= {f"Table {chapter}.{n}" for n in numbers}
    for listed, *papers in [*NUMBERED_OF.findall(text), *PART_OF.findall(text)]:
        for of in filter(None, papers):
            found |= _cited_of(listed, of)
    return found


def paper_of(name: str) -> str:
    """Return the paper whose package in the reference holds ``name``; "" if none does."""
    homes = (paper for home, paper in PAPERS.items() if f"{name}.".startswith(f"{home}."))
    return next(homes, "")


def _cited_of(text: str, paper: str) -> set[str]:
    found = {f"{part.lower()} {n} of {paper}" for part, n in PART.findall(text)}
    for first, last in NUMBERED.findall(text):
        whole = range(int(first), int(last or first) + 1) if first.isdigit() else [first]
        found |= {f"({n}) of {paper}" for n in whole}
    return {where.replace("table", "Table") for where in found}


def parted(name: str) -> tuple[str, str]:
    """Return the module of ``name`` and what it is called there, which may be nothing."""
    names = name.split(".")
    depth = next((n for n in range(len(names), 0, -1) if _source(names[:n])), 0)
    return ".".join(names[:depth]), ".".join(names[depth:])


def documentation(name: str) -> str | None:
    """Return the docstring of the module or the thing in it ``name``; None if there is none."""
    module, inner = parted(name)
    path = _source(module.split("."))
    if path is None:
        return None
    tree = _parsed(path)
    return _docstring(tree.body, inner.split(".")) if inner else ast.get_docstring(tree) or ""


def functions(package: str) -> Iterator[tuple[str, str]]:
    """Yield the name and the docstring of every public function and class of ``package``."""
    room = ROOT / ROOMS[package]
    for path in sorted((room / package).rglob("*.py")):
        module = ".".join(path.relative_to(room).with_suffix("").parts)
        for node in _parsed(path).body:
            if isinstance(node, ast.FunctionDef | ast.ClassDef) and not node.name.startswith("_"):
                yield f"{module}.{node.name}", ast.get_docstring(node) or ""


@cache
def tests() -> dict[str, list[Test]]:
    """Return the tests of the project by what they cite."""
    found: dict[str, list[Test]] = {}
    for path in sorted((ROOT / "tests").rglob("test_*.py")):
        tree = _parsed(path)
        packages = frozenset(_packages(tree))
        shared = [text for node in tree.body for text in _marks_of_all(node)]
        for node in tree.body:
            if isinstance(node, ast.FunctionDef) and node.name.startswith("test_"):
                test = Test(path.relative_to(ROOT).as_posix(), node.name, packages)
                for where in sorted(cited(" ".join([*shared, *_marks(node)]))):
                    found.setdefault(where, []).append(test)
    return found


def _source(names: list[str]) -> Path | None:
    if names[0] not in ROOMS:
        return None
    path = ROOT.joinpath(ROOMS[names[0]], *names)
    candidates = (path.with_suffix(".py"), path / "__init__.py")
    return next((candidate for candidate in candidates if candidate.is_file()), None)


@cache
def _parsed(path: Path) -> ast.Module:
    return ast.parse(path.read_text(encoding="utf-8"))


def _docstring(body: list[ast.stmt], names: list[str]) -> str | None:
    for node, after in zip(body, [*body[1:], ast.Pass()], strict=True):
        if isinstance(node, ast.FunctionDef | ast.ClassDef) and node.name == names[0]:
            if names[1:]:
                return _docstring(node.body, names[1:])
            return ast.get_docstring(node) or ""
        if isinstance(node, ast.Assign | ast.AnnAssign) and names == [_target(node)]:
            return _text(after.value) if isinstance(after, ast.Expr) else ""
    return None


def _target(node: ast.Assign | ast.AnnAssign) -> str:
    return ast.unparse(node.targets[0] if isinstance(node, ast.Assign) else node.target)


def _text(node: ast.expr) -> str:
    return node.value if isinstance(node, ast.Constant) and isinstance(node.value, str) else ""


def _marks(node: ast.FunctionDef) -> Iterator[str]:
    for mark in node.decorator_list:
        yield from _cites(mark)


def _marks_of_all(node: ast.stmt) -> Iterator[str]:
    """Yield what ``node`` cites for every test of its module, if it is `pytestmark`."""
    if isinstance(node, ast.Assign | ast.AnnAssign) and _target(node) == "pytestmark":
        marks = node.value.elts if isinstance(node.value, ast.List | ast.Tuple) else [node.value]
        for mark in filter(None, marks):
            yield from _cites(mark)


def _cites(mark: ast.expr) -> Iterator[str]:
    if isinstance(mark, ast.Call) and ast.unparse(mark.func) == "pytest.mark.cites":
        yield from map(_text, mark.args)


def _packages(tree: ast.Module) -> Iterator[str]:
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            yield from (alias.name.partition(".")[0] for alias in node.names)
        elif isinstance(node, ast.ImportFrom) and node.module:
            yield node.module.partition(".")[0]
