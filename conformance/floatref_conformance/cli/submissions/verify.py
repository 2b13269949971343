"""`conformance verify`: repeat what an archive of `conformance submit` rests on."""

import json
from dataclasses import asdict
from pathlib import Path
from typing import Any

import click

from floatref.errors import one_line
from floatref.files.sources import check_file, name_errors
from floatref_conformance.cli.options import env_option, limit_time, pass_variables
from floatref_conformance.plugins import load_registry
from floatref_conformance.render.text import printable
from floatref_conformance.submission.device_again import GivenDevice
from floatref_conformance.submission.findings import Verification
from floatref_conformance.submission.stored_zip import read_archive
from floatref_conformance.submission.verifying import Wanted
from floatref_conformance.submission.verifying import verify as verify_members

FORMAT = "conformance-verification/1"


@click.command()
@click.argument("archive", type=click.Path(path_type=Path))
@click.option(
    "--signers",
    metavar="FILE",
    type=click.Path(dir_okay=False, path_type=Path),
    help="Who may have signed: allowed signers of ssh-keygen, or a public key of minisign.",
)
@click.option(
    "--device",
    "spec",
    metavar="SPEC",
    help="The device itself, to run it again.  [default: a built-in's, from the archive]",
)
@click.option(
    "--device-file",
    "files",
    metavar="FILE",
    type=click.Path(dir_okay=False, path_type=Path),
    multiple=True,
    help="A file that was hashed with the device; may be repeated.",
)
@click.option(
    "--device-timeout",
    metavar="SECONDS",
    type=click.FloatRange(min=0, min_open=True),
    help="Time for one recording.  [default: 60 s and twice its length]",
)
@click.option(
    "--every-case", is_flag=True, help="Give the device every case again, not only what decides."
)
@click.option("--json", "as_json", is_flag=True, help="Print one JSON object.")
@env_option
@click.pass_context
def verify(
    context: click.Context,
    archive: Path,
    signers: Path | None,
    spec: str | None,
    files: tuple[Path, ...],
    device_timeout: float | None,
    every_case: bool,
    as_json: bool,
    variables: tuple[str, ...],
) -> None:
    """Repeat what ARCHIVE rests on, offline, and say what was repeated and what was not.

    Exit code 0: nothing contradicts; 1: something does; 2: wrong usage, no archive of
    `conformance submit`, or one that this version of hypothesis cannot repeat; 3: the suite itself
    is at fault.
    """
    for path in files if signers is None else (signers, *files):
        check_file(path)
    members, given = read_archive(archive), None
    if spec is not None:
        given = GivenDevice(spec, load_registry().device(spec), files)
        limit_time(given.device, device_timeout)
        pass_variables(given.device, variables)
    with name_errors(archive):
        found = verify_members(members, Wanted(signers, given, every_case), load_registry)
    click.echo(json.dumps(_document(found), indent=2) if as_json else _show(archive, found))
    context.exit(_exit_code(found))


def _exit_code(found: Verification) -> int:
    """Return 0 for a confirmed archive, 1 for a contradiction, 2 where more has to be at hand."""
    if found.findings:
        return 1
    return 2 if found.undecided else 0


def _conclude(found: Verification) -> str:
    if found.is_confirmed:
        return "confirmed: nothing contradicts"
    count = len(found.findings)
    return f"not confirmed: {count} found" if count else "not confirmed: it was not repeated"


def _document(found: Verification) -> dict[str, Any]:
    return {"format": FORMAT, "confirmed": found.is_confirmed, **asdict(found)}


def _show(archive: Path, found: Verification) -> str:
    """Return what was found as lines, the contradictions last, where the eye is."""
    lines = [f"{archive} states {found.claimed or 'no verdict'}; {found.signature}"]
    lines += [f"  {line}" for line in found.about]
    lines += ["Repeated:", *(f"  {line}" for line in found.repeated)]
    lines += ["Not repeated:", *(f"  {line}" for line in found.not_repeated)]
    lines += [f"Contradicted ({f.caught_by}): {f.where}: {f.what}" for f in found.findings]
    lines += [f"Undecided: {found.undecided}"] if found.undecided else []
    lines.append(_conclude(found))
    # A name in the archive with a line break would make a line that looks like one of ours.
    return "\n".join(one_line(printable(line)) for line in lines)
