"""What `view` and `plot` are given: profiles, or one recording, each found by its content."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import reduce
from pathlib import Path

import click

from floatref.engine.formats import is_profile, profile_of
from floatref.engine.recordings.readers import find_readers
from floatref.errors import InputError
from floatref.files.atomic import check_target
from floatref.interfaces.adapter import RecordingDirectory
from floatref.mapping.sources import recording_of
from floatref.values.parts.shown_units import SYSTEMS
from floatref.values.profile import Profile
from floatref.values.recording import Recording

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
    click.option("--adapter", metavar="NAME", help="Read the recording with this adapter."),
    click.option(
        "--map",
        "channel_map",
        type=click.Path(path_type=Path),
        metavar="FILE.toml",
        help="Channel map of a native file.",
    ),
    click.option("--overwrite", is_flag=True, help="Replace an existing target."),
)


def look_options(command: Command) -> Command:
    """Give ``command`` the options that `view` and `plot` have in common."""
    return reduce(lambda found, option: option(found), reversed(OPTIONS), command)


@dataclass(frozen=True)
class Reading:
    """How a recording is read: by a named adapter, by a channel map, or as it is recognised."""

    adapter: str | None = None
    channel_map: Path | None = None

    @property
    def is_stated(self) -> bool:
        """Whether an adapter or a map is given, so that the source is a recording."""
        return self.adapter is not None or self.channel_map is not None

    def recording_at(self, path: Path) -> Recording:
        """Return the recording at ``path``; its warnings go to stderr, one line each."""
        source = recording_of(path, self.adapter, self.channel_map)
        for line in source.warnings:
            click.echo(f"Warning: {line}", err=True)
        return source.recording

    def refuse_without_recording(self) -> None:
        """Raise InputError if an adapter or a map is given where all sources are profiles."""
        if self.is_stated:
            raise InputError("--adapter and --map are for a recording; leave them out for profiles")


def is_recording(path: Path, reading: Reading) -> bool:
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
        if is_recording(path, Reading()):
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
    parts = [path.resolve().parts for path in paths]
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
        if out.resolve() == source.resolve() or source.resolve() in out.resolve().parents:
            raise InputError(f"{out}: is, or is inside, a source; choose another place")
