"""`conformance practices`: which practices a certification can be held to, and their limits."""

import json
from typing import Any

import click

from floatref.errors import one_line
from floatref_conformance.certify.practice.practice_document import find_practice, list_names
from floatref_conformance.certify.practice.requirements import UNITS, Practice, Requirement
from floatref_conformance.render.text import printable


@click.command()
@click.argument("name", metavar="[NAME|FILE.json]", required=False)
@click.option("--json", "as_json", is_flag=True, help="Print one JSON object.")
def practices(name: str | None, as_json: bool) -> None:
    """List the practices of certification, or show the limits of one and where each is from.

    NAME is one of ours, FILE.json a practice that an agency wrote. A limit that is sold, or that we
    could not open, is shown as such, and `certify` reports its quantity without a verdict.
    """
    shown = list_names() if name is None else (name,)
    found = [find_practice(one) for one in shown]
    if as_json:
        key, value = ("practices", [_summary(one) for one in found])
        document = {key: value} if name is None else _document(found[0])
        click.echo(json.dumps(document, indent=2, ensure_ascii=False))
    elif name is None:
        _print_list(found)
    else:
        _print_practice(found[0])


def _summary(practice: Practice) -> dict[str, Any]:
    return {
        "name": practice.name,
        "title": practice.title,
        "version": practice.version,
        "status": practice.status,
        "sha256": practice.sha256,
        "limits": len(practice.requirements),
        "not_judged": len(practice.open_requirements()),
    }


def _document(practice: Practice) -> dict[str, Any]:
    limits = [
        {
            "quantity": one.quantity,
            "class": one.device_class,
            "limit": one.word if one.limit is None else one.limit,
            "unit": UNITS[one.quantity],
            "clause": one.clause,
            "basis": one.basis,
            "judged": not one.is_open and one.limit is not None,
            "source": str(one.source),
            "missing": one.missing,
        }
        for one in practice.requirements
    ]
    return {**_summary(practice), "notes": list(practice.notes), "limits": limits}


def _print_list(found: list[Practice]) -> None:
    from rich.table import Table

    table = _empty(Table)
    for head in ("practice", "version", "limits", "not judged"):
        table.add_column(head, overflow="fold")
    for one in found:
        counts = str(len(one.requirements)), str(len(one.open_requirements()))
        table.add_row(one.name, _shown(one.version), *counts)
    _show(table)
    click.echo("conformance practices NAME shows the limits, the clauses and the sources of one.")


def _print_practice(practice: Practice) -> None:
    from rich.table import Table

    for line in (practice.title, practice.version, practice.status, f"SHA-256 {practice.sha256}"):
        if line:
            click.echo(_shown(line))
    sources = tuple(dict.fromkeys(_source(one) for one in practice.requirements))
    table = _empty(Table)
    for head in ("quantity", "class", "limit", "basis", "clause", "source"):
        table.add_column(head, overflow="fold")
    for one in practice.requirements:
        number = str(1 + sources.index(_source(one)))
        basis = one.basis if one.limit is not None else ""
        table.add_row(
            one.quantity, one.device_class or "all", _limit(one), basis, _shown(one.clause), number
        )
    _show(table)
    for index, source in enumerate(sources, 1):
        click.echo(f"Source {index}: {_shown(source)}")
    for note in practice.notes:
        click.echo(_shown(note))


def _source(one: Requirement) -> str:
    """Return the source of a limit, and what of it could not be had."""
    return f"{one.source}; not had: {one.missing}" if one.missing else str(one.source)


def _shown(text: str) -> str:
    """Return ``text`` on one line, without anything that moves the cursor."""
    return one_line(printable(text))


def _limit(one: Requirement) -> str:
    if one.limit is None:
        return one.word
    shown = f"{one.limit:.6g} {UNITS[one.quantity]}".strip()
    return shown if not one.is_open else f"{shown}, not judged"


def _empty(kind: Any) -> Any:
    from rich.box import SIMPLE_HEAD

    return kind(box=SIMPLE_HEAD, pad_edge=False, show_edge=False)


def _show(table: Any) -> None:
    from floatref_conformance.render.terminal import PipedConsole

    console = PipedConsole(emoji=False, markup=False, highlight=False)
    console.width = max(console.width, 100)
    console.print(table)
