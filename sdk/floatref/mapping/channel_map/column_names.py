"""Which column of a native file an entry of a map means."""

import re
from collections.abc import Iterator, Sequence
from pathlib import Path
from shlex import quote

from floatref.errors import InputError, one_line
from floatref.mapping.channel_map.entries import ChannelEntry, ChannelMap
from floatref.values.channels import CHANNELS
from floatref.values.display.similar_names import did_you_mean
from floatref.values.native import Column, NativeFile, Stream

Place = tuple[Stream, Column]
MOST = 4096
"""Most names that are compared with a missing one, to bound the time."""


def full_name(stream: Stream, column: Column) -> str:
    """Return the name by which a map means ``column`` without ambiguity."""
    return f"{stream.name}/{column.name}" if stream.name else column.name


def find(native: NativeFile, name: str) -> Place:
    """Return the stream and the column that ``name`` means.

    ``name`` is "stream/column", or the column's own name if one stream alone has it. Raises
    InputError if no stream or several have it, and for a column that holds no numbers.
    """
    places = [(stream, column) for stream in native.streams for column in stream.columns]
    found = [place for place in places if full_name(*place) == name]
    found = found or [place for place in places if place[1].name == name]
    if not found:
        raise InputError(
            f"{name[:80]!r} is not in the file; {_hint(name, places)}{_faults(native)}"
        )
    if len(found) > 1:
        both = list(dict.fromkeys(full_name(*place) for place in found[:4]))
        advice = f"write one of {', '.join(both)}" if len(both) > 1 else "rename one of them"
        raise InputError(f"{name[:80]!r} is in {len(found)} streams; {advice}")
    stream, column = found[0]
    if not column.numeric:
        raise InputError(f"{name[:80]!r} holds no numbers ({column.note or 'text'}); map another")
    return stream, column


def similar(name: str, names: Sequence[str], more: Sequence[str] = ()) -> str:
    """Return a name of ``names``, or ``more``, that is like ``name``, else a list or ""."""
    for known in (names, more):
        hint = did_you_mean(name, known[:MOST])
        if hint:
            return hint
    rest = f" and {len(names) - 8} more" if len(names) > 8 else ""
    return f"there are {', '.join(names[:8])}{rest}" if names else ""


def _hint(name: str, places: Sequence[Place]) -> str:
    names = [full_name(*place) for place in places]
    own = [column.name for _, column in places]
    return similar(name, names, own) or "it has no columns"


def _faults(native: NativeFile) -> str:
    """Return the warnings of the file, which may explain a missing name."""
    return (
        f" (of the file: {'; '.join(map(one_line, native.warnings[:3]))})"
        if native.warnings
        else ""
    )


TRACK = re.compile(
    r"""[^./\\:*?"<>|\x00-\x1f\x7f\ud800-\udfff][^/\\:*?"<>|\x00-\x1f\x7f\ud800-\udfff]*"""
)
"""Names of wheel paths, which become parts of file names; the schemas have the same."""
LONGEST_TRACK = 48


def map_of_ours(native: NativeFile, source: Path) -> ChannelMap:
    """Return the map of ``native``, whose columns are `<channel>` or `<track>.<channel>`.

    A column without a unit is in that of the channel. Raises InputError if no column has such a
    name, with the command that drafts a map of the file ``source``, and if two mean the same.
    """
    channels = tuple(_entries(native))
    if not channels:
        raise InputError(
            "no channel of it has a name of floatref's; draft a channel map with "
            f"`floatref channels {quote(str(source))} --draft-map`, complete it, and give it with "
            "--map"
        )
    seen: set[tuple[str, str | None]] = set()
    for entry in channels:
        if (entry.channel, entry.track) in seen:
            raise InputError(
                f"{entry.native}: its channel is there twice; choose one of them in a map"
            )
        seen.add((entry.channel, entry.track))
    return ChannelMap(channels)


def channel_of(column: Column) -> tuple[str, str | None] | None:
    """Return channel and track from the name of ``column``, None for any other name."""
    track, _, channel = column.name.rpartition(".")
    if channel not in CHANNELS or not column.numeric or column.name.startswith("."):
        return None
    if track and not (len(track) <= LONGEST_TRACK and TRACK.fullmatch(track)):
        return None
    return channel, track or None


def _entries(native: NativeFile) -> Iterator[ChannelEntry]:
    for stream in native.streams:
        for column in stream.columns:
            named = channel_of(column)
            if named is not None:
                unit = column.unit or CHANNELS[named[0]].unit
                yield ChannelEntry(full_name(stream, column), named[0], track=named[1], unit=unit)
