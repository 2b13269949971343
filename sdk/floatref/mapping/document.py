"""Reading a channel map, `floatref-map/1`: a TOML file, checked before anything else is read."""

import math
import tomllib
from collections.abc import Mapping
from fractions import Fraction
from pathlib import Path
from typing import Any

from floatref.errors import InputError
from floatref.files.recording import setup_of
from floatref.files.schema import enforce
from floatref.files.sources import naming, opened
from floatref.mapping.entries import SOURCE, ChannelEntry, ChannelMap, ClockEntry, FileEntry
from floatref.mapping.quantities import quantity_of
from floatref.values.clock import rational

FORMAT = "floatref-map/1"
SCHEMA = "floatref-map-1"
LARGEST_BYTES = 1 << 20
DEEPEST = 16


def read_map(path: Path) -> ChannelMap:
    """Return the channel map in the TOML file ``path``.

    Raises InputError with one line naming the file, the entry and the value for text that is
    no TOML, keys and values that the format does not have, files outside the map's folder,
    two entries for one channel, and names of files that are not there.
    """
    document = _document(path)
    enforce(document, SCHEMA, path)
    with naming(path):
        files = _files(document, path)
        channels = tuple(_channel(entry, files) for entry in document["channels"])
        _check_channels(channels)
        return ChannelMap(
            channels=channels,
            files=files,
            clocks=_clocks(document, files),
            setup=setup_of(document.get("setup", {})),
            source=_file(document.get("source", {}), path),
            place=path,
            **document.get("device", {}),
        )


def _document(path: Path) -> dict[str, Any]:
    with opened(path) as stream:
        content = stream.read(LARGEST_BYTES + 1)
    if len(content) > LARGEST_BYTES:
        raise InputError(f"{path}: larger than 1 MiB; give a channel map in TOML")
    try:
        document = tomllib.loads(content.decode("utf-8-sig"))
    except UnicodeDecodeError as error:
        raise InputError(
            f"{path}: byte {error.start} is not UTF-8; save the map as UTF-8"
        ) from None
    except tomllib.TOMLDecodeError as error:
        raise InputError(f"{path}: not TOML: {error}; correct it there") from error
    except (RecursionError, ValueError) as error:
        # Nesting without end, or an integer of thousands of digits.
        raise InputError(f"{path}: no channel map ({type(error).__name__}); shorten it") from error
    with naming(path):
        _check_plain(document, "")
    return document


def _check_plain(value: Any, where: str, depth: int = 0) -> None:
    """Refuse numbers that are none, dates, and nesting that no map has."""
    if depth > DEEPEST:
        raise InputError(f"{where[:60]}: nested too deeply; a map has no such entry")
    if isinstance(value, dict):
        for key, item in value.items():
            _check_plain(item, f"{where}.{key}".lstrip("."), depth + 1)
    elif isinstance(value, list):
        for index, item in enumerate(value):
            _check_plain(item, f"{where}[{index}]", depth + 1)
    else:
        _check_value(value, where)


def _check_value(value: Any, where: str) -> None:
    if isinstance(value, float) and not math.isfinite(value):
        raise InputError(f"{where} is {value}; give a finite number")
    if isinstance(value, int) and abs(value) > 1 << 63:
        raise InputError(f"{where} is an integer beyond 64 bits; give a number")
    if not isinstance(value, str | int | float):
        raise InputError(f"{where} is a date or a time; give a number or a string")


def _files(document: Mapping[str, Any], place: Path) -> dict[str, FileEntry]:
    files: dict[str, FileEntry] = {}
    for entry in document.get("files", []):
        name = entry["name"]
        if name in files:
            raise InputError(f"files: {name} is given twice; name each file once")
        files[name] = _file(entry, place)
    return files


def _file(entry: Mapping[str, Any], place: Path) -> FileEntry:
    options = dict(entry.get("options", {}))
    if "dbc" in entry:
        options["dbc"] = str(_inside(entry["dbc"], place))
    path = _inside(entry["path"], place) if "path" in entry else Path()
    return FileEntry(path, entry.get("adapter"), options)


def _inside(name: str, place: Path) -> Path:
    """Return the file ``name`` beside the map ``place``; InputError if it leaves that folder."""
    folder = place.resolve().parent
    try:
        target = (folder / name).resolve()
    except (OSError, ValueError, RuntimeError) as error:
        raise InputError(f"path {name[:80]!r}: no possible file name; correct it") from error
    if Path(name).is_absolute() or not target.is_relative_to(folder):
        raise InputError(f"path {name[:80]!r}: leads out of the map's folder; copy the file there")
    return target


def _channel(entry: dict[str, Any], files: Mapping[str, FileEntry]) -> ChannelEntry:
    given = dict(entry)
    with naming(f"channel {entry['channel']} ({entry['native']})"):
        _check_file(given.get("file", SOURCE), files)
        given["channel"], sign = quantity_of(given["channel"], given.pop("axis", None))
        if given.get("scale") == 0:
            raise InputError("scale is 0; give by how much a native sample is multiplied")
        given["sign"] = sign * given.get("sign", 1)
        given["missing"] = tuple(map(float, given.get("missing", ())))
        return ChannelEntry(**given)


def _check_channels(channels: tuple[ChannelEntry, ...]) -> None:
    seen: set[tuple[str, str | None]] = set()
    for entry in channels:
        if (entry.channel, entry.track) in seen:
            track = "" if entry.track is None else f" of track {entry.track}"
            raise InputError(f"channel {entry.channel}{track}: mapped twice; keep one entry")
        seen.add((entry.channel, entry.track))


def _clocks(document: Mapping[str, Any], files: Mapping[str, FileEntry]) -> tuple[ClockEntry, ...]:
    found: dict[tuple[str, str | None], ClockEntry] = {}
    for entry in document.get("clocks", []):
        given = dict(entry)
        clock = ClockEntry(rate=_rate(given.pop("rate_hz", None)), **given)
        with naming(f"clock of {clock.file or 'the source'} {clock.stream or ''}".strip()):
            _check_file(clock.file, files)
            _check_alignment(clock)
            if (clock.file, clock.stream) in found:
                raise InputError("given twice; keep one entry")
        found[clock.file, clock.stream] = clock
    return tuple(found.values())


def _rate(given: float | str | None) -> Fraction | None:
    if given is None:
        return None
    try:
        rate = Fraction(given) if isinstance(given, str) else rational(given)
    except ZeroDivisionError:
        rate = Fraction(0)
    if not Fraction(1, 1000) <= rate <= 10**7:
        raise InputError(f"rate_hz is {given}; give the rate in Hz, between 0.001 and 10000000")
    return rate


def _check_file(name: str, files: Mapping[str, FileEntry]) -> None:
    if name != SOURCE and name not in files:
        there = ", ".join(files) or "none"
        raise InputError(f"file {name[:40]!r}: not in the map's files ({there}); add it there")


def _check_alignment(clock: ClockEntry) -> None:
    pulses = (clock.pulses is not None, clock.base_pulses is not None)
    if clock.align == "pulses" and not all(pulses):
        raise InputError(
            "align by pulses needs pulses and base_pulses, the channels that hold them"
        )
    if clock.align != "pulses" and any(pulses):
        raise InputError('pulses are given; write align = "pulses" as well, or leave them out')
    readings = [name for name in ("base_time", "base_pps") if getattr(clock, name) is not None]
    if clock.align != "gnss" and readings:
        raise InputError(f'{readings[0]} is given; write align = "gnss" as well, or leave it out')
    if len(readings) > 1:
        raise InputError("base_time and base_pps are given; keep one of them")
