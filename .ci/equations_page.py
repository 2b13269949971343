"""Write the page for readers of the dissertation: equation, reference, SDK, test.

    python .ci/equations_page.py [--check] [--rows FILE] [--page FILE]

The rows are those of `equations.toml`. Each has to lead to a function of the reference and to one
of the SDK or the proving ground whose docstrings cite it, and to tests of both that do; otherwise
one line per row says what is missing, and nothing is written. `--check` compares instead.
"""

import argparse
import re
import sys
import textwrap
import tomllib
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from typing import Any

from citations import ROOT, Test, cited, documentation, functions, paper_of, parted, tests

REFERENCE = "floatref_reference"
SHOWN = re.compile(r"^::: ([\w.]+)$", re.MULTILINE)
ANCHOR = re.compile(r"\{ ?#([\w-]+) ?\}$", re.MULTILINE)
Row = dict[str, Any]


class IncompleteRowError(Exception):
    """One line per row that lacks something."""


@cache
def documented() -> frozenset[str]:
    """Return the modules that the pages of the API show, and that can be linked."""
    pages = (p.read_text(encoding="utf-8") for p in (ROOT / "docs" / "api").glob("*.md"))
    return frozenset(module for page in pages for module in SHOWN.findall(page))


def shown(names: list[str]) -> str:
    """Return the modules and names of ``names`` as code, linked if the API shows them."""
    parts: list[str] = []
    for name in names:
        module, inner = parted(name)
        label = f"`{module.removeprefix(f'{REFERENCE}.')}`"
        if label not in parts:
            parts.append(label)
        if inner:
            parts.append(f"[`{inner}`][{name}]" if module in documented() else f"`{inner}`")
    return "<br>".join(parts)


def used(row: Row) -> list[str]:
    """Return the names in the column of the SDK and the proving ground."""
    return _listed(row.get("used", []))


def reference(row: Row) -> list[str]:
    """Return the names in the column of the reference."""
    return [f"{REFERENCE}.{name}" for name in _listed(row.get("reference", []))]


def _listed(names: str | list[str]) -> list[str]:
    return list(filter(None, [names] if isinstance(names, str) else names))


def faults(row: Row) -> Iterator[str]:
    """Yield what ``row`` of an equation or table lacks."""
    where = cited(row.get("cites", ""))
    if not where:
        yield "cites no equation, table or section"
    if not row.get("what"):
        yield "no title given in what"
    for column, names in {"reference function": reference(row), "function": used(row)}.items():
        if not names:
            yield f"no {column} given"
        for name in names:
            text = documentation(name)
            if text is None:
                yield f"{name} does not exist"
            elif not where <= cited(text, paper_of(name)):
                yield f"the docstring of {name} does not cite it"
    yield from untested(where, {REFERENCE, *(name.partition(".")[0] for name in used(row))})
    yield from no_such_slip(row)


def untested(where: set[str], packages: set[str]) -> Iterator[str]:
    """Yield each of ``packages`` that no test of all of ``where`` imports."""
    for package in sorted(packages):
        if any(not any(package in test.packages for test in tests().get(w, [])) for w in where):
            yield f"no test that imports {package} is marked with cites"


def no_such_slip(row: Row) -> Iterator[str]:
    """Yield the anchor of ``row`` if the page of slips lacks it."""
    slips = (ROOT / "docs" / "slips.md").read_text(encoding="utf-8")
    if row.get("slip") and row["slip"] not in ANCHOR.findall(slips):
        yield f"slips.md has no anchor {row['slip']}"


def pipeline_faults(row: Row) -> Iterator[str]:
    """Yield what ``row`` of a pipeline lacks."""
    from floatref.engine.plugins import plugins
    from floatref_conformance.table.published import published_table

    pipeline = plugins().pipelines().get(row["pipeline"])
    for name in reference(row):
        if documentation(name) is None:
            yield f"{name} does not exist"
    if pipeline is None:
        yield f"there is no pipeline {row['pipeline']}"
    elif row["cites"] not in cited(pipeline.summary):
        yield f"its summary does not cite {row['cites']}"
    table = published_table(row["pipeline"])
    if row["table"] != f"Table {table}":
        yield f"its figures are published in Table {table}"
    yield from untested({row["table"]}, {REFERENCE, "floatref"})


def complete(groups: list[Row]) -> None:
    """Raise IncompleteRowError unless every row has all its columns."""
    lines = [
        f"{row.get('cites')}, {row.get('what') or row.get('pipeline')}: {fault}"
        for group in groups
        for row in group["rows"]
        for fault in (pipeline_faults(row) if "pipeline" in row else faults(row))
    ]
    if lines:
        raise IncompleteRowError("\n".join(lines))


def tested(where: set[str]) -> str:
    """Return the tests that cite ``where``, each file named once."""
    by_file: dict[str, list[Test]] = {}
    for test in dict.fromkeys(t for w in sorted(where) for t in tests()[w]):
        by_file.setdefault(test.path.removeprefix("tests/"), []).append(test)
    return "<br>".join(
        "<br>".join(f"`{text}`" for text in (path, *(test.name for test in found)))
        for path, found in sorted(by_file.items())
    )


def line(row: Row) -> str:
    """Return ``row`` as one of the page's tables."""
    left = shown(reference(row))
    if "pipeline" in row:
        first, names = f"{row['cites']}, {row['table']}", f"`{row['pipeline']}`"
        return f"| {first} | {left} | {names} | {tested({row['table']})} |"
    slip = f"<br>[slip](slips.md#{row['slip']})" if row.get("slip") else ""
    where = tested(cited(row["cites"]))
    return f"| **{row['cites']}** {row['what']}{slip} | {left} | {shown(used(row))} | {where} |"


def alone(groups: list[Row]) -> str:
    """Return the equations that the reference has and no row lists."""
    listed = set().union(*(cited(row["cites"]) for group in groups for row in group["rows"]))
    found = {
        where
        for name, text in functions(REFERENCE)
        for where in cited(_first_of_equation(text), paper_of(name))
        if where.startswith("(")
    }
    return ", ".join(sorted(found - listed, key=in_print))


def _first_of_equation(text: str) -> str:
    return text.partition("Equation:")[2].strip().partition("\n")[0]


def in_print(where: str) -> tuple[str, str, int]:
    """Return what sorts equations as they are printed: the appendices late, the papers last."""
    number, _, paper = where.partition(" of ")
    chapter, _, last = number.strip("()").rpartition(".")
    return paper, chapter, int(last) if last.isdigit() else 1000 + ord(last)


def page(rows: Row) -> str:
    """Return the page of ``rows``; raise IncompleteRowError if one lacks a column."""
    complete(rows["groups"])
    parts = [rows["intro"].strip()]
    for group in rows["groups"]:
        head = f"| {group.get('first', 'in print')} | reference | {group.get('third', 'used in')} |"
        parts.append(f"## {group['title']}\n\n{group.get('text', '')}".strip())
        table = [f"{head} tests |", "|---|---|---|---|", *map(line, group["rows"])]
        parts.append("\n".join(table))
    outro = rows["outro"].strip().replace("ALONE", alone(rows["groups"]))
    parts.extend(textwrap.fill(part, 100) for part in outro.split("\n\n"))
    return "\n\n".join(parts) + "\n"


def main() -> int:
    """Write the page or compare it; return 1 if it cannot be or is another."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--check", action="store_true", help="compare, do not write")
    parser.add_argument("--rows", type=Path, default=Path(__file__).with_name("equations.toml"))
    parser.add_argument("--page", type=Path, default=ROOT / "docs" / "equations.md")
    options = parser.parse_args()
    try:
        text = page(tomllib.loads(options.rows.read_text(encoding="utf-8")))
    except IncompleteRowError as error:
        print(error, file=sys.stderr)
        return 1
    if options.check and options.page.read_text(encoding="utf-8") != text:
        print(f"{options.page} is out of date: python .ci/equations_page.py", file=sys.stderr)
        return 1
    if not options.check:
        options.page.write_text(text, encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
