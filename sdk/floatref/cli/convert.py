"""`floatref convert`: a profile of any format, written in another."""

from pathlib import Path

import click

from floatref.cli.format_option import FormatName
from floatref.cli.printing import number, print_table
from floatref.engine.formats import format_of, profile_of, write_as
from floatref.errors import InputError
from floatref.files.atomic import check_target
from floatref.files.sources import name_errors
from floatref.values.profile import Profile


@click.command("convert")
@click.argument("profile", type=click.Path(path_type=Path))
@click.option("--out", required=True, type=click.Path(path_type=Path), help="Where to write.")
@click.option("--format", "form", type=FormatName(), help="By default, from the suffix of --out.")
@click.option("--overwrite", is_flag=True, help="Replace an existing target.")
def convert(profile: Path, out: Path, form: str | None, overwrite: bool) -> None:
    """Write PROFILE, a profile directory or a profile file of any format, in another format.

    The suffix of OUT selects the format; without a suffix it is a profile directory. Points,
    elevations and validity are unchanged, to the digits that the format holds.
    """
    written = format_of(out, form)
    check_target(out, overwrite)
    _check_apart(profile, out)
    read = profile_of(profile)
    with name_errors(profile):
        write_as(written, read, out, overwrite)
    _print_table(read, out)


def _check_apart(profile: Path, out: Path) -> None:
    """Raise InputError for a target that is the profile itself, its folder, or inside it."""
    source, target = profile.resolve(), out.resolve()
    if target in (source, source.parent) or source in target.parents:
        raise InputError(f"{out}: is, holds, or lies in, the profile itself; choose another place")


def _print_table(profile: Profile, out: Path) -> None:
    rows = [
        [
            track.name,
            f"{profile.start_m:.10g}",
            number(profile.length_m, 2),
            f"{profile.interval_m:.10g}",
            number(float((~track.valid).sum()) * profile.interval_m, 2),
        ]
        for track in profile.tracks
    ]
    print_table(str(out), ("track", "start m", "length m", "interval m", "invalid m"), rows)
