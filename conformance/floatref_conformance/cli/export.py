"""`conformance export`: write the recordings that a `files:` device has to process."""

import json
import shlex
from pathlib import Path

import click

from floatref.errors import InputError
from floatref.files.atomic import replace_directory
from floatref_conformance.classes import Effort
from floatref_conformance.cli.edition_option import edition_option
from floatref_conformance.devices.interface import (
    ARCHITECTURES,
    CAPABILITIES,
    RESPONSE,
    Description,
)
from floatref_conformance.editions import EDITION
from floatref_conformance.plugins import load_registry

DESCRIPTION = "device.json"


@click.command()
@click.option(
    "-o", "--out", type=click.Path(path_type=Path), required=True, help="New folder to write."
)
@click.option(
    "--effort",
    type=click.Choice([e.value for e in Effort]),
    default=Effort.QUICK.value,
    show_default=True,
    help="How many cases each check draws.",
)
@click.option(
    "--check", "ids", metavar="ID", multiple=True, help="For this check alone; may be repeated."
)
@click.option("--seed", type=click.IntRange(min=0), default=0, show_default=True)
@click.option(
    "--architecture",
    type=click.Choice(ARCHITECTURES),
    default=ARCHITECTURES[0],
    show_default=True,
    help="Of the device that will process them.",
)
@click.option(
    "--capability",
    "capabilities",
    type=click.Choice(list(CAPABILITIES)),
    multiple=True,
    help="Record the channels of this capability, too; may be repeated.",
)
@edition_option
def export(
    out: Path,
    effort: str,
    ids: tuple[str, ...],
    seed: int,
    architecture: str,
    capabilities: tuple[str, ...],
    edition: str,
) -> None:
    """Write the recordings of all checks; the truth stays here.

    Process OUT/<case>/recording.json into OUT/<case>/profile.json and its files, then run
    `conformance run --device files:OUT` with the same seed and effort. OUT/golden holds input
    and output of single stages. Quick effort takes several GB.
    """
    if architecture == RESPONSE and RESPONSE not in capabilities:
        raise InputError(f"--architecture {RESPONSE}: add --capability {RESPONSE}")
    from floatref_conformance import golden
    from floatref_conformance.exporting import export as write

    registry = load_registry(edition)
    checks, _ = registry.select(ids)
    description = Description(out.name, "unknown", architecture, tuple(capabilities))
    document = {
        "name": description.name,
        "version": description.version,
        "architecture": architecture,
        "capabilities": list(capabilities),
    }
    text = json.dumps(document, indent=2) + "\n"
    with replace_directory(out, False, DESCRIPTION) as beside:
        count = write(checks, beside, description, seed, Effort(effort), _tell)
        golden.copy_to(beside / "golden")
        (beside / DESCRIPTION).write_text(text, encoding="utf-8")
    words = ["conformance", "run", "--device", f"files:{out}", "--seed", str(seed)]
    words += ["--edition", edition] if edition != EDITION else []
    words += ["--effort", effort, *(word for id_ in ids for word in ("--check", id_))]
    click.echo(f"{count} recordings in {out}; after processing: {shlex.join(words)}")


def _tell(id_: str, count: int) -> None:
    click.echo(f"{id_}: {count} recordings so far")
