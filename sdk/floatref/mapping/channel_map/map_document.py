"""Reading a channel map, `floatref-map/1`: a TOML file, checked before anything else is read."""

import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from floatref.errors import InputError
from floatref.files.document import show
from floatref.files.recording_directory import setup_of
from floatref.files.schema import enforce
from floatref.files.sources import name_errors, open_bytes, real_path
from floatref.files.toml_document import read_toml
from floatref.mapping.channel_map.clock_entries import clocks_of
from floatref.mapping.channel_map.entries import SOURCE, ChannelEntry, ChannelMap, FileEntry
from floatref.mapping.channel_map.unit_limits import TOLERANCES
from floatref.values.channels import channel_spec

ON_AXES = {
    "specific_force": {
        "x": "longitudinal_specific_force",
        "y": "lateral_specific_force",
        "z": "vertical_specific_force",
    },
    "angular_rate": {"x": "roll_rate", "y": "pitch_rate", "z": "yaw_rate"},
}
"""Channels of a sensor by the body axis that it points along."""
AXES = {name: axis for axes in ON_AXES.values() for axis, name in axes.items()}
AXES |= dict.fromkeys(TOLERANCES, "z")
"""The axis of every channel that has one; wheels and body are measured along Z alone."""


def quantity_of(channel: str, axis: str | None) -> tuple[str, int]:
    """Return the channel that ``channel`` along ``axis`` is, and its sign.

    ``channel`` is one of ours, `specific_force` or `angular_rate`; ``axis`` such as "z" or "-z"
    is the body axis (X forward, Y left, Z up) that the sensor's own axis points along. Raises
    InputError for unknown names, an axis that is missing, and an axis that is not the channel's.
    """
    sign = -1 if axis is not None and axis.startswith("-") else 1
    along = None if axis is None else axis.lstrip("+-")
    if channel in ON_AXES:
        if along is None:
            raise InputError(f'{channel} needs an axis; write axis = "z" or another of +-x, y, z')
        return ON_AXES[channel][along], sign
    channel_spec(channel)
    if along is None:
        return channel, sign
    if channel not in AXES:
        raise InputError(f"axis is {axis}, but {channel} has no axis; remove it")
    if AXES[channel] != along:
        raise InputError(f"axis is {axis}, but {channel} is along {AXES[channel]}; correct one")
    return channel, sign


COMMENTED = re.compile(rb"^[ \t]*#[ \t]*\[\[[ \t]*channels[ \t]*\]\]", re.MULTILINE)
"""Head of the entry of a channel, as a comment."""
FORMAT = "floatref-map/1"
SCHEMA = "floatref-map-1"


def read_map(path: Path) -> ChannelMap:
    """Return the channel map in the TOML file ``path``.

    Raises InputError with one line naming the file, the entry and the value for text that is not
    TOML, keys and values that the format does not have, files outside the map's folder, two entries
    for one channel, and names of files that are not there.
    """
    path = Path(path)
    document = read_toml(path, "channel map")
    if "channels" not in document:
        _check_for_comments(path)
    enforce(document, SCHEMA, path)
    with name_errors(path):
        files = _files(document, path)
        channels = tuple(_channel(entry, files) for entry in document["channels"])
        _check_channels(channels)
        clocks = clocks_of(document.get("clocks", []))
        for clock in clocks:
            with name_errors("clocks"):
                _check_file(clock.file, files)
        return ChannelMap(
            channels=channels,
            files=files,
            clocks=clocks,
            setup=setup_of(document.get("setup", {})),
            source=_file(document.get("source", {}), path),
            place=path,
            **document.get("device", {}),
        )


def _check_for_comments(path: Path) -> None:
    """Raise InputError for a map without a channel in which there are some as comments."""
    with open_bytes(path) as stream:
        count = len(COMMENTED.findall(stream.read()))
    if count:
        raise InputError(
            f"{path}: its channels, {count}, are all comments, as in a draft from names that say "
            "too little; take away the # before every line of those that you have, and complete "
            "them"
        )


def _files(document: Mapping[str, Any], place: Path) -> dict[str, FileEntry]:
    files: dict[str, FileEntry] = {}
    for entry in document.get("files", []):
        name = entry["name"]
        if name in files:
            raise InputError(f"files: {_plain(name)} is given twice; name each file once")
        files[name] = _file(entry, place)
    return files


def _file(entry: Mapping[str, Any], place: Path) -> FileEntry:
    options = dict(entry.get("options", {}))
    if "dbc" in options:
        raise InputError("options: dbc is not an option; write it beside options")
    if "dbc" in entry:
        options["dbc"] = str(_resolve_inside(entry["dbc"], place))
    path = _resolve_inside(entry["path"], place) if "path" in entry else Path()
    return FileEntry(path, entry.get("adapter"), options)


def _resolve_inside(name: str, place: Path) -> Path:
    """Return the file ``name`` beside the map ``place``; InputError if it leaves that folder."""
    prefix = f"path {show(name)}"
    # A map has the same meaning and the same errors on every system.
    if "\\" in name or re.match(r"/|[A-Za-z]:", name):
        raise InputError(f"{prefix}: give it relative to the map's folder, with / in between")
    try:
        folder = real_path(place).parent
        target = real_path(folder / name)
        target.is_file()
        if target.is_symlink():
            raise OSError("its links go round")
    except (OSError, ValueError, RuntimeError) as error:
        raise InputError(f"{prefix}: no possible file name; correct it") from error
    if not target.is_relative_to(folder):
        raise InputError(f"{prefix}: leads out of the map's folder; copy the file there")
    return target


def _channel(entry: dict[str, Any], files: Mapping[str, FileEntry]) -> ChannelEntry:
    given = dict(entry)
    with name_errors(f"channel {_plain(entry['channel'])} ({_plain(entry['native'])})"):
        _check_file(given.get("file", SOURCE), files)
        given["channel"], sign = quantity_of(given["channel"], given.pop("axis", None))
        if given.get("scale") == 0:
            raise InputError("scale is 0; give by how much a native sample is multiplied")
        given["sign"] = sign * given.get("sign", 1)
        given["missing"] = tuple(map(float, given.get("missing", ())))
        return ChannelEntry(**given)


def _plain(text: str) -> str:
    return show(text)[1:-1]


def _check_channels(channels: tuple[ChannelEntry, ...]) -> None:
    seen: set[tuple[str, str | None]] = set()
    for entry in channels:
        if (entry.channel, entry.track) in seen:
            track = "" if entry.track is None else f" of track {entry.track}"
            raise InputError(f"channel {entry.channel}{track}: mapped twice; keep one entry")
        seen.add((entry.channel, entry.track))


def _check_file(name: str, files: Mapping[str, FileEntry]) -> None:
    if name != SOURCE and name not in files:
        there = ", ".join(map(_plain, files)) or "it has no files"
        raise InputError(f"file {show(name)}: not in the map's files ({there}); add it there")
