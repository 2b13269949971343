"""`floatref convert`: a profile or a recording of any format, written in another."""

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING

import click

from floatref.cli.format_option import FormatName
from floatref.cli.printing import number, print_table
from floatref.cli.recordings.guessed_units import read_guessing
from floatref.engine.formats import format_of, profile_of, write_as
from floatref.engine.plugins import plugins
from floatref.engine.recordings.readers import find_readers
from floatref.engine.recordings.recording_formats import (
    holds_setup,
    is_native_file,
    is_profile_only,
    is_recording,
    recording_format_of,
    write_recording_as,
)
from floatref.errors import InputError
from floatref.files.atomic import check_target
from floatref.files.sources import name_errors, real_path
from floatref.files.withheld_formats import WITHHELD
from floatref.interfaces.profile_format import ProfileFormat
from floatref.interfaces.recording_format import RecordingFolder, RecordingFormat
from floatref.values.display.similar_names import hint_at
from floatref.values.installation import Setup
from floatref.values.profile import Profile
from floatref.values.recording import Recording

if TYPE_CHECKING:
    from floatref.mapping.sources import Source


@click.command("convert")
@click.argument("source", type=click.Path(path_type=Path))
@click.option("-o", "--out", required=True, type=click.Path(path_type=Path), help="Where to write.")
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
@click.option(
    "--guess-units", is_flag=True, help="Guess the unit of heights where a profile states no unit."
)
@click.option("--overwrite", is_flag=True, help="Replace an existing target.")
def convert(
    source: Path,
    out: Path,
    form: str | None,
    adapter: str | None,
    channel_map: Path | None,
    guess_units: bool,
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
        _convert_profile(source, out, form, overwrite, guess_units)
        return
    check_target(out, overwrite)
    _check_apart(source, out)
    read = _read_recording(source, adapter, channel_map)
    with name_errors(source), read.name_errors_natively():
        write_recording_as(written, read.recording, out, overwrite)
    for line in (*read.warnings, *_setup_warnings(written, read.recording, out)):
        click.echo(f"Warning: {line}", err=True)
    _print_channels(read.recording, out)


def _recording_format(
    source: Path, out: Path, form: str | None, given: bool
) -> RecordingFormat | None:
    """Return the format in which ``source`` is written if it is a recording, None for a profile.

    ``given`` says that the command has an option of recordings. Raises InputError for a recording
    whose target holds profiles or is of no format, and for a profile whose target holds recordings.
    """
    written = recording_format_of(out, form)
    if written is not None:
        if not given and is_profile_only(source):
            raise _refusal_of_profile(source, f"format {form}" if form else out.suffix)
        return written
    folder = form is None and not out.suffix[1:].isalpha()
    profiles = [*_suffixes(plugins().profile_formats()), *WITHHELD]
    known = form is not None or out.suffix.lower() in profiles
    # Where the target holds profiles, a table of text is read as one: it says what is missing.
    if not (given or is_recording(source) or (not known and is_native_file(source))):
        return None
    if folder:
        return RecordingFolder()
    raise _refusal_of_recording("" if given else f"{source}: ", out, form, known)


def _refusal_of_profile(source: Path, target: str) -> InputError:
    suffixes = ", ".join(_suffixes(plugins().profile_formats()))
    return InputError(
        f"{source}: is a profile, and {target} holds recordings; write {suffixes} or a name "
        "without a suffix"
    )


def _refusal_of_recording(where: str, out: Path, form: str | None, known: bool) -> InputError:
    """Return the error for a target that holds no recordings; ``known`` if it holds profiles."""
    suffixes = _suffixes(plugins().recording_formats())
    instead = f"{', '.join(suffixes)} or a name without a suffix"
    if not known:
        hint = hint_at(out.suffix.lower(), suffixes)
        return InputError(
            f"{out}: suffix {out.suffix} is no format; a recording is written as {instead}{hint}"
        )
    what = f"{where}a recording" if where else "--adapter and --map read a recording"
    return InputError(
        f"{what}, and {form or out.suffix} holds profiles; make one of it with floatref process, "
        f"or write {instead}"
    )


def _suffixes(formats: Mapping[str, ProfileFormat] | Mapping[str, RecordingFormat]) -> list[str]:
    return [form.suffix for form in formats.values() if form.suffix]


def _setup_warnings(form: RecordingFormat, recording: Recording, out: Path) -> list[str]:
    """Return the warning that ``out`` does not hold the setup, if the recording has one."""
    if holds_setup(form) or recording.setup == Setup():
        return []
    return [
        f"{out}: the setup (offsets of sensors, profile interval) is not in the file; when it is "
        "processed, give it in [setup] of a channel map, with --map"
    ]


def _read_recording(source: Path, adapter: str | None, channel_map: Path | None) -> "Source":
    """Return the recording; of a table of text the error says why it is no profile as well."""
    from floatref.mapping.sources import recording_of

    try:
        return recording_of(source, adapter, channel_map)
    except InputError as error:
        names = [reader.name for reader in find_readers(source)]
        if adapter is not None or channel_map is not None or names != ["csv"]:
            raise
        reason = _why_no_profile(source)
        raise InputError(
            f"{error}; or, as a profile: {reason}" if reason else str(error)
        ) from error


def _why_no_profile(source: Path) -> str:
    try:
        profile_of(source)
    except InputError as error:
        return "; or, as a profile: " + str(error).removeprefix(f"{source}: ")
    return ""


def _convert_profile(
    source: Path, out: Path, form: str | None, overwrite: bool, guess_units: bool
) -> None:
    written = format_of(out, form)
    check_target(out, overwrite)
    _check_apart(source, out)
    read, note = read_guessing(source) if guess_units else (profile_of(source), "")
    with name_errors(source):
        write_as(written, read, out, overwrite)
    if note:
        click.echo(f"Warning: {source}: {note}", err=True)
    _print_tracks(read, out)


def _check_apart(source: Path, out: Path) -> None:
    """Raise InputError for a target that is the source itself, its folder, or inside it."""
    origin, target = real_path(source), real_path(out)
    if target in (origin, origin.parent) or origin in target.parents:
        raise InputError(f"{out}: is, holds, or lies in, the source itself; choose another place")


def _print_tracks(profile: Profile, out: Path) -> None:
    rows = [
        [
            track.name,
            f"{profile.start_m:.10g}",
            number(profile.length_m, 2),
            f"{profile.interval_m:.10g}",
            number(float(track.valid.size - track.valid.sum()) * profile.interval_m, 2),
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
