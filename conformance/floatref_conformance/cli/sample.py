"""`conformance sample`: data to try a command on, drawn by the proving ground."""

import shlex
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import click

from floatref.files.atomic import replace_directory

Writer = Callable[[Path, int, Callable[[str], None]], None]


@dataclass(frozen=True)
class Kind:
    """A kind of sample: what it holds, and the command that it is for."""

    holds: str
    command: str


KINDS = {
    "certification": Kind(
        "a section, its reference, ten runs, both parked tests, plan.toml",
        "conformance certify --plan {plan} --report {report}",
    ),
    "network": Kind(
        "five recordings in two folders, with a stop and a damaged file",
        "floatref batch {out} --out {profiles} --segment 100",
    ),
}


@click.command()
@click.argument("kind", type=click.Choice(tuple(KINDS)))
@click.option(
    "-o", "--out", required=True, type=click.Path(path_type=Path), help="New folder to write."
)
@click.option(
    "--seed", type=click.IntRange(min=0), default=0, show_default=True, help="Draws everything."
)
def sample(kind: str, out: Path, seed: int) -> None:
    """Write sample data of KIND, and print the command that it is for.

    `certification` is a section with its reference, ten runs over it, both parked tests and the
    plan of `conformance certify`. `network` is five recordings for `floatref batch`, one of them
    damaged. All of it is drawn by the proving ground.
    """
    with replace_directory(out, False, "") as beside:
        _writer_of(kind)(beside, seed, lambda part: click.echo(f"simulating {part} …", err=True))
    click.echo(f"{out}: {KINDS[kind].holds}")
    click.echo(f"Next: {_command(kind, out)}")


def _writer_of(kind: str) -> Writer:
    """Return what writes a sample of ``kind``."""
    if kind == "certification":
        from floatref_conformance.samples.certification import write_certification

        return write_certification
    from floatref_conformance.samples.network import write_network

    return write_network


def _command(kind: str, out: Path) -> str:
    """Return the command for the sample in ``out``; what it writes lies beside that."""
    places = {
        "out": out,
        "plan": out / "plan.toml",
        "report": out.with_name(f"{out.name}-report"),
        "profiles": out.with_name(f"{out.name}-profiles"),
    }
    quoted = {name: shlex.quote(str(place)) for name, place in places.items()}
    return KINDS[kind].command.format(**quoted)
