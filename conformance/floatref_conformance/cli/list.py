"""`conformance list`: the checks and the devices."""

import json
from collections.abc import Sequence
from itertools import groupby
from shutil import get_terminal_size
from textwrap import wrap
from typing import Any

import click

from floatref_conformance.checks.catalogue import IDS, not_built
from floatref_conformance.checks.streams.stream_catalogue import STREAM_CHECKS
from floatref_conformance.cli.edition_option import edition_option
from floatref_conformance.devices.interface import NEEDS
from floatref_conformance.plugins import load_registry
from floatref_conformance.registry import Registry

PLAIN_WIDTH = 100
"""Columns where the width of the output is unknown."""
NARROWEST = 30
"""Columns for the text of an entry in the narrowest terminal."""
MOST_SPARED = 3
"""Checks named that a device may pass, in place of those that must fail it."""


@click.command("list")
@edition_option
@click.option("--json", "as_json", is_flag=True, help="Print one JSON object.")
def list_(edition: str, as_json: bool) -> None:
    """List the checks and the devices."""
    registry = load_registry(edition)
    for line in registry.broken:
        click.echo(f"Warning: {line}", err=True)
    listing = {
        "edition": edition,
        "checks": _checks(registry),
        "stream_checks": _stream_checks(),
        "devices": _devices(registry),
    }
    click.echo(json.dumps(listing, indent=2) if as_json else _in_words(listing))


def _checks(registry: Registry) -> list[dict[str, Any]]:
    built = [
        {
            "id": check.id,
            "built": True,
            "title": check.title,
            "clause": check.clause,
            "needs": sorted(check.needs),
        }
        for check in registry.checks.values()
    ]
    return built + [
        {"id": left.id, "built": False, "title": IDS[left.id], "clause": None, "needs": []}
        for left in not_built(registry.checks)
    ]


def _stream_checks() -> list[dict[str, Any]]:
    return [
        {"id": check.id, "title": check.title, "clause": check.clause}
        for check in STREAM_CHECKS.values()
    ]


def _devices(registry: Registry) -> list[dict[str, Any]]:
    return [
        {
            "spec": f"{kind.prefix}:{entry.name}",
            "summary": entry.summary,
            "fails": list(entry.fails),
        }
        for kind in registry.kinds.values()
        for entry in kind.entries()
    ]


def _in_words(listing: dict[str, Any]) -> str:
    checks, devices = listing["checks"], listing["devices"]
    built = [check["id"] for check in checks if check["built"]]
    rows = [(c["id"], c["title"], _details(c)) for c in checks]
    needs = "needs a device that streams"
    rows += [(c["id"], c["title"], f"{c['clause']}; {needs}") for c in listing["stream_checks"]]
    lines = ["Checks", *_align(rows)]
    for kind, ours in groupby(devices, lambda device: device["spec"].partition(":")[0]):
        rows = [(d["spec"], d["summary"], _fails(d["fails"], built)) for d in ours]
        lines += ["", f"Devices, {kind}", *_align(rows)]
    return "\n".join(lines)


def _details(check: dict[str, Any]) -> str:
    """Return the clause of a check, and what a device needs for it, if not every one has it."""
    if not check["built"]:
        return "not built yet"
    needs = ", ".join(NEEDS[need] for need in check["needs"])
    return f"{check['clause']}; needs {needs}" if needs else str(check["clause"])


def _fails(fails: Sequence[str], built: Sequence[str]) -> str:
    """Return which of the ``built`` checks must fail a device, the shorter way round."""
    spared = [id_ for id_ in built if id_ not in fails]
    if not fails or len(spared) > min(MOST_SPARED, len(fails)):
        return f"must fail {', '.join(fails)}" if fails else ""
    return "must fail every check" + (f" but {', '.join(spared)}" if spared else "")


def _align(rows: Sequence[tuple[str, str, str]]) -> list[str]:
    """Return a line or more for each row: its name, what it is, and below that the details."""
    indent = 4 + max((len(name) for name, _, _ in rows), default=0)
    width = max(get_terminal_size((PLAIN_WIDTH, 0)).columns, indent + NARROWEST)
    lines: list[str] = []
    for name, what, details in rows:
        texts = [part for text in (what, details) for part in _wrap(text, width - indent)]
        lines.append(f"  {name:<{indent - 2}}{texts[0]}")
        lines += [f"{'':{indent}}{text}" for text in texts[1:]]
    return lines


def _wrap(text: str, width: int) -> list[str]:
    return wrap(text, width, break_on_hyphens=False, break_long_words=False)
