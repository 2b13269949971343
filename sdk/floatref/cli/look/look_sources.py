"""What `view` and `plot` are given: profiles, or one recording, each found by its content."""

from collections.abc import Callable, Sequence
from pathlib import Path

import click

from floatref.cli.recordings.recording_options import READING, RecordingReader, add_options
from floatref.engine.formats import is_profile, profile_of
from floatref.engine.recordings.readers import find_readers
from floatref.errors import InputError
from floatref.files.atomic import check_target
from floatref.files.sources import real_path
from floatref.interfaces.adapter import RecordingDirectory
from floatref.values.parts.shown_units import SYSTEMS
from floatref.values.profile import Profile

Command = Callable[..., None]
OPTIONS = (
    click.option("--from", "begin", type=float, metavar="M|S", help="Where the part begins."),
    click.option("--to", "end", type=float, metavar="M|S", help="Where it ends."),
    click.option(
        "--units", type=click.Choice(SYSTEMS), default="si", help="Metric (si) or US (us)."
    ),
    click.option("--title", default="", metavar="TEXT", help="Title, by default the names."),
    click.option(
        "--channel",
        "channels",
        multiple=True,
        metavar="NAME",
        help="Channel of a recording, such as height or left.height; repeat it for more.",
    ),
    *READING,
)


def look_options(command: Command) -> Command:
    """Give ``command`` the options that `view` and `plot` have in common."""
    return add_options(command, OPTIONS)


def refuse_without_recording(reading: RecordingReader) -> None:
    """Raise InputError if an adapter or a map is given where all sources are profiles."""
    if reading.is_stated:
        raise InputError("--adapter and --map are for a recording; leave them out for profiles")


def is_recording(path: Path, reading: RecordingReader) -> bool:
    """Return whether ``path`` holds a recording; InputError if it is missing or neither."""
    if not path.exists():
        raise InputError(f"{path}: not found; give a profile or a recording")
    if reading.is_stated or RecordingDirectory().recognises(path):
        return True
    if is_profile(path):
        return False
    if path.is_file() and find_readers(path):
        return True
    raise InputError(
        f"{path}: neither a profile nor a recording; give a profile directory or file, "
        "a recording directory, or a native file with --adapter or --map"
    )


def read_profiles(paths: Sequence[Path]) -> dict[str, Profile]:
    """Return the profiles at ``paths`` by the shortest ends of their paths that differ.

    Raises InputError for a path given twice, for one that holds a recording, and for a profile that
    cannot be used.
    """
    names = short_names(paths)
    for path in paths:
        if is_recording(path, RecordingReader()):
            raise InputError(
                f"{path}: a recording among profiles; give it alone, or with --recording"
            )
    return {name: profile_of(path) for name, path in zip(names, paths, strict=True)}


def refuse_channels(channels: Sequence[str]) -> None:
    """Raise InputError if channels are chosen of what is a profile."""
    if channels:
        raise InputError(f"--channel {channels[0]}: a profile has no channels; leave it out")


def short_names(paths: Sequence[Path]) -> list[str]:
    """Return a name for every path: its last part, or as many parts as make all of them differ."""
    parts = [real_path(path).parts for path in paths]
    for number, path in enumerate(paths):
        if parts[number] in parts[:number]:
            raise InputError(f"{path}: given twice; give each profile once")
    count = 1
    while len({part[-count:] for part in parts}) < len(parts):
        count += 1
    return ["/".join(part[-count:]) for part in parts]


def check_out(out: Path, sources: Sequence[Path], overwrite: bool) -> None:
    """Raise InputError for a target that exists, cannot be written, or lies in a source."""
    check_target(out, overwrite)
    for source in sources:
        if real_path(out) == real_path(source) or real_path(source) in real_path(out).parents:
            raise InputError(f"{out}: is, or is inside, a source; choose another place")
