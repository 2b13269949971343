"""ERD, the text format of UMTRI that ProVAL and RoadRuf open: profiles out and in."""

from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from floatref import InputError, Profile, ProfileTrack, open_bytes, read_start
from floatref_adapters.formats.erd.erd_header import (
    BYTE_ORDER_MARK,
    LONGEST_HEADER,
    MARK,
    ErdChannel,
    ErdHeader,
    parse_header,
)
from floatref_adapters.formats.erd.erd_numbers import read_numbers
from floatref_adapters.formats.erd.erd_writing import (
    ELEVATION,
    FORMAT,
    HIGHEST_M,
    PIPELINE,
    VALID,
    write_erd,
)
from floatref_adapters.shared.length_units import (
    WHEEL_PATHS,
    Ratio,
    find_length_unit,
    to_metres,
)
from floatref_adapters.shared.numbered_names import number_repeats
from floatref_adapters.shared.refusals import prefix_errors

NO_ELEVATIONS = ("distance", "station", "chainage", "milepost")
"""What a channel in a unit of length may be and is no elevation."""


class Elevation(NamedTuple):
    """A channel that is an elevation, its unit, and the channel that says where to trust it."""

    track: str
    channel: int
    unit: Ratio
    valid: int | None = None


class Erd:
    """The format of ERD files."""

    name = "erd"
    suffix = ".erd"
    summary = "ERD of UMTRI as text, for ProVAL: elevations in m, and their validity"

    def recognises(self, path: Path) -> bool:
        """Tell whether the first line of ``path`` is that of an ERD file."""
        start = read_start(path, len(BYTE_ORDER_MARK) + len(MARK))
        return start.removeprefix(BYTE_ORDER_MARK).startswith(MARK)

    def read(self, path: Path) -> Profile:
        """Return the profile in ``path``, in m; every channel that is an elevation is a track.

        Text is read, and 4-byte reals in the .bin file beside ``path``. Raises InputError in one
        line naming the file for anything else than an ERD file of elevations over distance.
        """
        if not path.is_file():
            raise InputError(f"{path}: not a file; give an ERD file")
        with prefix_errors(path), open_bytes(path) as stream:
            header = parse_header(stream.read(LONGEST_HEADER))
            unit = _step_unit(header)
            found, left_out = _elevations(header)
            wanted = [i for e in found for i in (e.channel, e.valid) if i is not None]
            numbers = read_numbers(header, path, stream, wanted)
            columns = dict(zip(wanted, numbers.T, strict=True))
            return Profile(
                interval_m=to_metres(header.step, unit),
                tracks=tuple(_track(elevation, columns) for elevation in found),
                start_m=to_metres(header.start, unit),
                pipeline=_pipeline(header),
                provenance=_provenance(header, left_out),
            )

    def write(self, profile: Profile, path: Path) -> None:
        """Write ``profile`` as text; InputError if a track has no elevation, or one too high."""
        try:
            write_erd(profile, path)
        except InputError as error:
            raise InputError(f"{path}: {error}") from error


def _step_unit(header: ErdHeader) -> Ratio:
    unit = find_length_unit(header.x_unit)
    if unit is None:
        what = f"XUNITS is {header.x_unit[:20]!r}" if header.x_unit else "no line XUNITS"
        raise InputError(f"{what}; a profile needs the unit of its step: m, mm, in, ft, km or mi")
    return unit


def _elevations(header: ErdHeader) -> tuple[list[Elevation], list[str]]:
    """Return the channels that are elevations, and the names of the others."""
    if _is_ours(header):
        return _our_elevations(header), []
    named = [i for i, c in enumerate(header.channels) if "elev" in f"{c.short} {c.long}".lower()]
    chosen = named or [
        i for i, c in enumerate(header.channels) if find_length_unit(c.unit) and not _is_place(c)
    ]
    if not chosen:
        there = ", ".join(f"{c.title} ({c.unit or 'no unit'})" for c in header.channels[:8])
        raise InputError(f"no channel is an elevation in a unit of length: {there}")
    tracks = number_repeats([_wheel_path(header.channels[i], i) for i in chosen])
    units = [_unit(header.channels[i]) for i in chosen]
    found = [Elevation(*parts) for parts in zip(tracks, chosen, units, strict=True)]
    return found, [c.title for i, c in enumerate(header.channels) if i not in chosen]


def _our_elevations(header: ErdHeader) -> list[Elevation]:
    places = {channel.long: index for index, channel in enumerate(header.channels)}
    found = []
    for index, channel in enumerate(header.channels):
        if channel.long.endswith(ELEVATION):
            track = channel.long.removesuffix(ELEVATION)
            found.append(Elevation(track, index, _unit(channel), places.get(f"{track}{VALID}")))
    if not found:
        raise InputError(f"no channel has a long name that ends with{ELEVATION}; export it again")
    return found


def _is_ours(header: ErdHeader) -> bool:
    versions = [line.split(",")[0] for line in header.history if line.startswith("floatref-erd/")]
    if versions and versions[0] != FORMAT:
        raise InputError(f"format is {versions[0][:40]}; this version reads {FORMAT}")
    return bool(versions)


def _is_place(channel: ErdChannel) -> bool:
    return any(word in f"{channel.short} {channel.long}".lower() for word in NO_ELEVATIONS)


def _unit(channel: ErdChannel) -> Ratio:
    unit = find_length_unit(channel.unit)
    if unit is None:
        what = f"unit {channel.unit}" if channel.unit else "no unit"
        raise InputError(
            f"channel {channel.title} has {what}; write m, mm, in or ft into the line UNITSNAM"
        )
    return unit


def _wheel_path(channel: ErdChannel, index: int) -> str:
    name = channel.short.rstrip(".") or channel.long or f"channel {index + 1}"
    return WHEEL_PATHS.get(name.lower(), name)


def _track(elevation: Elevation, columns: dict[int, NDArray[np.float64]]) -> ProfileTrack:
    values = to_metres(columns[elevation.channel], elevation.unit)
    highest = float(np.nanmax(np.abs(values), initial=0.0))
    if highest > HIGHEST_M:
        raise InputError(
            f"track {elevation.track}: an elevation of {highest:g} m; a road has at most "
            f"{HIGHEST_M:g} m, correct the unit or the value"
        )
    valid = None if elevation.valid is None else columns[elevation.valid]
    if valid is not None and not np.isin(valid, (0.0, 1.0)).all():
        bad = valid[~np.isin(valid, (0.0, 1.0))][0]
        raise InputError(f"validity of track {elevation.track} is {bad:g}; it must be 0 or 1")
    return ProfileTrack.of(elevation.track, values, None if valid is None else valid != 0.0)


def _pipeline(header: ErdHeader) -> str:
    if not _is_ours(header):
        return ""
    lines = [line.removeprefix(PIPELINE) for line in header.history if line.startswith(PIPELINE)]
    return lines[0] if lines else ""


def _provenance(header: ErdHeader, left_out: list[str]) -> dict[str, Any]:
    if _is_ours(header):
        return {}
    found = {"title": header.title, "history": list(header.history), "left_out": left_out}
    return {"erd": {key: value for key, value in found.items() if value}}
