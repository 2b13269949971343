"""`floatref convert`: a profile or a recording of any format, written in another."""

from pathlib import Path

import click

from floatref.cli.format_option import FormatName
from floatref.cli.printing import number, print_table
from floatref.engine.formats import format_of, profile_of, write_as
from floatref.engine.plugins import plugins
from floatref.engine.recordings.recording_formats import (
    is_recording,
    recording_format_of,
    write_recording_as,
)
from floatref.errors import InputError
from floatref.files.atomic import check_target
from floatref.files.sources import name_errors
from floatref.interfaces.recording_format import RecordingFolder, RecordingFormat
from floatref.values.profile import Profile
from floatref.values.recording import Recording


@click.command("convert")
@click.argument("source", type=click.Path(path_type=Path))
@click.option("--out", required=True, type=click.Path(path_type=Path), help="Where to write.")
@click.option(
    "--format",
    "form",
    type=FormatName(recordings=True),
    help="By default, from the suffix of --out.",
)
@click.option("--adapter", metavar="NAME", help="Read a recording with this adapter.")
@click.option(
    "--map",
    "channel_map",
    type=click.Path(path_type=Path),
    metavar="FILE.toml",
    help="Channel map of a recording that is a native file.",
)
@click.option("--overwrite", is_flag=True, help="Replace an existing target.")
def convert(
    source: Path,
    out: Path,
    form: str | None,
    adapter: str | None,
    channel_map: Path | None,
    overwrite: bool,
) -> None:
    """Write SOURCE, a profile or a recording, in another format.

    The suffix of OUT selects the format; without a suffix it is a profile directory, or the
    directory of a recording. Points, elevations and validity of a profile are unchanged, to the
    digits that the format holds; samples and times of a recording are unchanged.
    """
    given = adapter is not None or channel_map is not None
    written = _recording_format(source, out, form, given)
    if written is None:
        _convert_profile(source, out, form, overwrite)
        return
    from floatref.mapping.sources import recording_of

    check_target(out, overwrite)
    _check_apart(source, out)
    read = recording_of(source, adapter, channel_map)
    with name_errors(source), read.name_errors_natively():
        write_recording_as(written, read.recording, out, overwrite)
    for line in read.warnings:
        click.echo(f"Warning: {line}", err=True)
    _print_channels(read.recording, out)


def _recording_format(
    source: Path, out: Path, form: str | None, given: bool
) -> RecordingFormat | None:
    """Return the format in which ``source`` is written if it is a recording, None for a profile.

    ``given`` says that the command has an option of recordings. Raises InputError for a recording
    whose target holds profiles.
    """
    written = recording_format_of(out, form)
    if written is not None:
        return written
    if not (given or is_recording(source)):
        return None
    if form is None and not out.suffix[1:].isalpha():
        return RecordingFolder()
    suffixes = ", ".join(f.suffix for f in plugins().recording_formats().values() if f.suffix)
    what = "--adapter and --map read a recording" if given else f"{source}: a recording"
    raise InputError(
        f"{what}, and {form or out.suffix} holds profiles; make one of it with floatref process, "
        f"or write {suffixes} or a name without a suffix"
    )


def _convert_profile(source: Path, out: Path, form: str | None, overwrite: bool) -> None:
    written = format_of(out, form)
    check_target(out, overwrite)
    _check_apart(source, out)
    read = profile_of(source)
    with name_errors(source):
        write_as(written, read, out, overwrite)
    _print_tracks(read, out)


def _check_apart(source: Path, out: Path) -> None:
    """Raise InputError for a target that is the source itself, its folder, or inside it."""
    origin, target = source.resolve(), out.resolve()
    if target in (origin, origin.parent) or origin in target.parents:
        raise InputError(f"{out}: is, holds, or lies in, the source itself; choose another place")


def _print_tracks(profile: Profile, out: Path) -> None:
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


def _print_channels(recording: Recording, out: Path) -> None:
    rows = []
    for channel in recording.channels:
        begin, end = channel.span_s
        numbers = map("{:.6g}".format, (channel.mean_rate_hz, begin, end))
        rows.append([str(channel.id), channel.unit, str(channel.values.size), *numbers])
    print_table(str(out), ("channel", "unit", "samples", "Hz", "from s", "to s"), rows)
