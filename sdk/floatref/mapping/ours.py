"""The map of a file whose channels already have our names."""

import re
from collections.abc import Iterator

from floatref.errors import InputError
from floatref.mapping.entries import ChannelEntry, ChannelMap
from floatref.mapping.naming import full_name
from floatref.values.channels import CHANNELS
from floatref.values.native import Column, NativeFile

TRACK = re.compile(
    r"""[^./\\:*?"<>|\x00-\x1f\x7f\ud800-\udfff][^/\\:*?"<>|\x00-\x1f\x7f\ud800-\udfff]*"""
)
"""Names of wheel paths, which become parts of file names; the schemas have the same."""
LONGEST_TRACK = 48


def map_of_ours(native: NativeFile) -> ChannelMap:
    """Return the map of ``native``, whose columns are `<channel>` or `<track>.<channel>`.

    A column without a unit is in that of the channel. Raises InputError if none has such a
    name, and if two mean the same.
    """
    channels = tuple(_entries(native))
    if not channels:
        raise InputError(
            "none of its channels has one of our names; draft a channel map with "
            "`floatref channels FILE --draft-map`, complete it, and give it with --map"
        )
    seen: set[tuple[str, str | None]] = set()
    for entry in channels:
        if (entry.channel, entry.track) in seen:
            raise InputError(
                f"{entry.native}: its channel is there twice; say in a map which counts"
            )
        seen.add((entry.channel, entry.track))
    return ChannelMap(channels)


def channel_of(column: Column) -> tuple[str, str | None] | None:
    """Return the channel and the track that the name of ``column`` says, None if it says none."""
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
