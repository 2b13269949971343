"""`conformance submit`: judge a device, and pack all that the verdict rests on."""

from pathlib import Path
from typing import Any

import click

from floatref.errors import InputError
from floatref.files import read_bytes
from floatref.files.atomic import check_target
from floatref_conformance.cli.edition_option import edition_option
from floatref_conformance.cli.following import end_with, follow
from floatref_conformance.cli.judging_options import (
    Asked,
    completing,
    judging_options,
    make_plan,
)
from floatref_conformance.cli.options import env_option
from floatref_conformance.judge.exercise import close_on_error
from floatref_conformance.judge.waivers import NO_REASON, check_used
from floatref_conformance.plugins import load_registry
from floatref_conformance.render.terminal import TerminalRenderer, make_console
from floatref_conformance.submission.case_collector import CaseCollector
from floatref_conformance.submission.checksums import SUMS
from floatref_conformance.submission.document import LARGEST_SEED
from floatref_conformance.submission.packing import describe_plan, make_members
from floatref_conformance.submission.signatures import UNSIGNED, sign
from floatref_conformance.submission.stored_zip import write_archive

MOST_BYTES = 1 << 20
FILE = click.Path(dir_okay=False, path_type=Path)


@click.command()
@click.option("-o", "--out", type=FILE, required=True, help="Archive to write.")
@judging_options
@click.option(
    "--device-file",
    "files",
    metavar="FILE",
    type=FILE,
    multiple=True,
    help="Hash this file with the device, too; may be repeated.",
)
@click.option("--statement", metavar="FILE", type=FILE, help="What you state, as UTF-8 text.")
@click.option(
    "--sign",
    "key",
    metavar="KEY",
    type=FILE,
    help="Sign with this secret key, of ssh-keygen or minisign.",
)
@click.option("--overwrite", is_flag=True, help="Replace the archive if it exists.")
@edition_option
@env_option
@click.pass_context
def submit(
    context: click.Context,
    /,
    out: Path,
    files: tuple[Path, ...],
    statement: Path | None,
    key: Path | None,
    overwrite: bool,
    **options: Any,
) -> None:
    """Judge a device, and write an archive that `conformance verify` checks.

    It is written with any verdict; the same input gives the same archive.

    Exit code 0: PASS; 1: FAIL; 2: wrong usage; 3: the suite itself is at fault, no archive;
    4: INCOMPLETE, since checks were left out, skipped or waived.
    """
    asked = Asked(**options)
    if asked.seed > LARGEST_SEED:
        raise InputError(f"--seed: {asked.seed} is more than {LARGEST_SEED}; give a smaller one")
    check_target(out, overwrite)
    stated = "" if statement is None else _read_statement(statement)
    if key is not None:
        # A key that cannot sign is refused before the run, not after it.
        sign(b"", key)
    registry = load_registry(asked.edition)
    device = registry.device(asked.spec)
    with close_on_error(device):
        plan = make_plan(asked, registry, device)
        _refuse_bare(plan.waivers, asked.waive)
        known = describe_plan(plan, files, stated)
    collected = CaseCollector(plan.device_class)
    terminal = TerminalRenderer(make_console(stderr=True), False)
    complete = completing(asked, device)
    finished = follow(plan, terminal, [collected], complete=complete)
    if asked.waive is not None:
        check_used(plan.waivers, finished, asked.waive)
    members = make_members(plan, collected, known)
    signed = UNSIGNED
    if key is not None:
        name, signature = sign(members[SUMS], key)
        members, signed = {**members, name: signature}, f"signed with {key}"
    write_archive(members, out, overwrite)
    click.echo(f"{finished.verdict}: {len(members)} files in {out}, {signed}")
    end_with(context, finished)


def _read_statement(path: Path) -> str:
    try:
        return read_bytes(path, MOST_BYTES, "statement").decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise InputError(f"{path}: not UTF-8; write the statement as plain text") from error


def _refuse_bare(waivers: Any, path: Path | None) -> None:
    """Raise InputError for a waiver without a reason: others have to judge it."""
    for id_, reason in waivers.items():
        if reason == NO_REASON:
            raise InputError(f"{path}: {id_}: no reason; write why it may fail behind the id")
