"""`conformance explain`: what a check asks, how much is allowed, and why."""

import textwrap

import click

from floatref_conformance.checks.interface import Check
from floatref_conformance.checks.streams.stream_catalogue import STREAM_CHECKS
from floatref_conformance.checks.streams.stream_check import StreamCheck
from floatref_conformance.classes import DeviceClass, Effort
from floatref_conformance.cli.edition_option import edition_option
from floatref_conformance.devices.interface import NEEDS
from floatref_conformance.judge.judging import find_scored
from floatref_conformance.plugins import load_registry
from floatref_conformance.render.drawing import draw


@click.command()
@click.argument("id_", metavar="ID")
@edition_option
def explain(id_: str, edition: str) -> None:
    """Explain what check ID asks, what it allows, and why."""
    registry = load_registry(edition)
    if id_ in STREAM_CHECKS:
        click.echo("\n".join(explain_stream(STREAM_CHECKS[id_], registry.killers(id_))))
        return
    check = registry.check(id_)
    click.echo("\n".join(explanation(check, registry.killers(id_))))


def explanation(check: Check, killers: tuple[str, ...]) -> list[str]:
    """Return the lines that explain ``check``; ``killers`` are the devices it must fail."""
    lines = [f"{check.id}: {check.title}", "", f"Clause: {check.clause}", "", "Limits"]
    for quantity, limits in check.limits.items():
        row = ", ".join(f"{c.value} {limits[c]}" for c in DeviceClass)
        lines.append(f"  {quantity}: {row}")
    lines += ["", "Derivation", *_wrap(check.derivation), "", "Floor", *_wrap(check.floor)]
    lines += ["", *_draw_case(check)]
    cases = ", ".join(f"{len(check.cases(0, effort))} at effort {effort}" for effort in Effort)
    lines += ["", f"Cases: {cases}"]
    if check.needs:
        lines.append(f"Needs: {', '.join(NEEDS[need] for need in sorted(check.needs))}")
    return [*lines, f"Must fail: {', '.join(killers) or 'no device yet'}"]


def explain_stream(check: StreamCheck, killers: tuple[str, ...]) -> list[str]:
    """Return the lines that explain a check of streams, whose limits hold for every class."""
    lines = [f"{check.id}: {check.title}", "", f"Clause: {check.clause}", "", "Limits"]
    lines += [f"  {quantity}: {limit}" for quantity, limit in check.limits.items()]
    lines += ["", "Derivation", *_wrap(check.derivation), "", "Floor", *_wrap(check.floor)]
    return [*lines, "", "Needs: a device that streams", f"Must fail: {', '.join(killers)}"]


def _draw_case(check: Check) -> list[str]:
    """Return the drawing of the first case; empty for a check without cases."""
    cases = check.cases(0, Effort.QUICK)
    if not cases:
        return []
    drawn = draw(cases[0].scenario, find_scored(check, cases[0]))
    return [f"Drawing of {cases[0].name}", *drawn]


def _wrap(text: str) -> list[str]:
    return textwrap.wrap(text, 88, initial_indent="  ", subsequent_indent="  ")
