"""`conformance list`: the checks and the devices."""

import json
from typing import Any

import click

from floatref_conformance import EDITION
from floatref_conformance.checks.catalogue import IDS, not_built
from floatref_conformance.plugins import load_registry
from floatref_conformance.registry import Registry


@click.command("list")
@click.option("--json", "as_json", is_flag=True, help="Print one JSON object.")
def list_(as_json: bool) -> None:
    """List the checks and the devices."""
    registry = load_registry()
    for line in registry.broken:
        click.echo(f"Warning: {line}", err=True)
    listing = {"edition": EDITION, "checks": _checks(registry), "devices": _devices(registry)}
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
    lines = ["Checks"]
    for check in listing["checks"]:
        state = f" [{check['clause']}]" if check["built"] else " (not built yet)"
        lines.append(f"  {check['id']:<16} {check['title']}{state}")
    lines.append("Devices")
    for device in listing["devices"]:
        fails = f" (must fail {', '.join(device['fails'])})" if device["fails"] else ""
        lines.append(f"  {device['spec']:<32} {device['summary']}{fails}")
    return "\n".join(lines)
