"""Profiles as the tab-separated text that profile viewers export, out and in.

Every channel is a pair of columns, `LElev - Distance (ft)` and `LElev_Full (in)`; a channel that
is shorter than others ends in empty fields. A unit that a title does not state is not guessed.
"""

import io
from collections.abc import Iterator
from itertools import islice
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from floatref import InputError, Profile, ProfileTrack, open_bytes
from floatref_adapters.formats.viewer_text.column_pairs import (
    NO_UNIT,
    SECTION,
    TAB,
    VALID,
    Layout,
    Pair,
    find_layout,
    is_header,
    list_pairs,
    unit_of,
)
from floatref_adapters.formats.viewer_text.text_rows import (
    ROWS,
    Columns,
    distance_decimals,
    write_number,
)
from floatref_adapters.shared.length_units import to_metres
from floatref_adapters.shared.refusals import prefix_errors

FORMULA = tuple("=+-@＝＋－＠")
"""What a spreadsheet calculates if a title begins with it."""
LONGEST_HEADER = 1 << 20
"""Bytes within which the first line must end."""

Floats = NDArray[np.float64]


class ViewerText:
    """The format of such files."""

    name = "text"
    suffix = ".txt"
    summary = "tab-separated text of profile viewers: a pair of columns per channel"

    def recognises(self, path: Path) -> bool:
        """Tell whether the first line of ``path`` begins with a distance and has tabs."""
        try:
            with open_bytes(path) as stream:
                line = stream.readline(LONGEST_HEADER)
        except InputError:
            return False
        return is_header(line.decode("utf-8-sig", "replace"))

    def read(self, path: Path) -> Profile:
        """Return the profile in ``path``, in m; every channel that is an elevation is a track.

        Raises InputError in one line naming the file for anything else than such a file.
        """
        return _read(path)

    def read_unstated(self, path: Path) -> tuple[Profile, str] | None:
        """Return the profile with heights as they are written, and the unit of its distances.

        None if every title states its unit. Raises InputError as `read`.
        """
        with prefix_errors(path), open_bytes(path) as stream:
            line = stream.readline(LONGEST_HEADER).decode("utf-8-sig", "replace")
            pairs = list_pairs(line.rstrip("\r\n").split(TAB))
        if not pairs or any(pair.unit for pair in pairs):
            return None
        return _read(path, "m"), pairs[0].distance_unit.strip().rstrip(".").lower()

    def write(self, profile: Profile, path: Path) -> None:
        """Write ``profile`` in m; its validity where a point is not valid, but no 1-σ.

        Raises InputError for the name of a wheel path that the layout cannot hold.
        """
        for track in profile.tracks:
            _check_name(track.name, path)
        with path.open("w", encoding="utf-8", newline="") as stream:
            channels = list(_channels(profile))
            titles = (title for name, unit, _ in channels for title in _titles(name, unit))
            stream.write(TAB.join(titles) + "\r\n")
            count = profile.tracks[0].elevation.size
            decimals = distance_decimals(profile.start_m, profile.interval_m, count)
            for first in range(0, count, ROWS):
                stream.writelines(_lines(profile, channels, first, decimals))


def _read(path: Path, unstated: str = "") -> Profile:
    if not path.is_file():
        raise InputError(f"{path}: not a file; give a text file")
    with prefix_errors(path):
        try:
            with open_bytes(path) as raw, _text(raw) as stream:
                return _profile(stream, unstated)
        except UnicodeDecodeError as error:
            raise InputError("not UTF-8 text; export it as text again") from error


def _text(raw: io.BufferedReader) -> io.TextIOWrapper:
    return io.TextIOWrapper(raw, encoding="utf-8-sig", newline="")


def _profile(stream: io.TextIOWrapper, unstated: str) -> Profile:
    titles = stream.readline(LONGEST_HEADER).rstrip("\r\n").split(TAB)
    layout = find_layout(titles, unstated)
    pairs = [*layout.elevations.values(), *layout.valid.values()]
    columns = Columns(stream, len(titles), pairs, titles)
    start, interval = _grid(columns, pairs)
    count = max(columns.values(pair).size for pair in layout.elevations.values())
    if count < 2:
        raise InputError("no rows below the header; copy the complete file")
    tracks = [_track(name, layout, columns, count) for name in layout.elevations]
    provenance: dict[str, Any] = {}
    if layout.left_out:
        provenance = {"text": {"left_out": layout.left_out}}
    return Profile(interval, tuple(tracks), start, provenance=provenance)


def _grid(columns: Columns, pairs: list[Pair]) -> tuple[float, float]:
    """Return start and interval in m of all ``pairs``; InputError unless they are the same."""
    grids = {}
    for pair in pairs:
        unit = unit_of(pair)[0]
        start, interval = columns.start_and_interval(pair)
        grids[pair.distance_title] = to_metres(start, unit), to_metres(interval, unit)
    if len(set(grids.values())) > 1:
        one, other = islice({grid: title for title, grid in grids.items()}.values(), 2)
        raise InputError(
            f"columns {one} and {other} have other distances; a profile has one start and one "
            "interval, export each channel by itself"
        )
    return next(iter(grids.values()))


def _track(name: str, layout: Layout, columns: Columns, count: int) -> ProfileTrack:
    pair = layout.elevations[name]
    values = to_metres(columns.values(pair), unit_of(pair)[1])
    elevation = np.pad(values, (0, count - values.size), constant_values=np.nan)
    if name not in layout.valid:
        return ProfileTrack.of(name, elevation)
    flags = columns.values(layout.valid[name])
    if not np.isin(flags, (0.0, 1.0)).all():
        bad = int(np.argmin(np.isin(flags, (0.0, 1.0))))
        title = layout.valid[name].values_title
        raise InputError(f"row {bad + 2}: {title} is {flags[bad]:g}; it must be 0 or 1")
    return ProfileTrack.of(name, elevation, np.pad(flags, (0, count - flags.size)) != 0.0)


def _check_name(name: str, path: Path) -> None:
    """Raise InputError for a name that breaks a line, is a formula, or is read back as another."""
    broken = any(c in name for c in "\t\r\n()") or name.startswith(FORMULA)
    if broken or name != name.strip() or name.endswith((".", VALID)):
        raise InputError(
            f"{path}: track {name!r} has a name that this format cannot hold; write a .csv"
        )


def _channels(profile: Profile) -> Iterator[tuple[str, str, NDArray[Any]]]:
    for track in profile.tracks:
        yield track.name, "m", track.elevation
        if not (track.valid | np.isnan(track.elevation)).all():
            yield f"{track.name}{VALID}", NO_UNIT, track.valid.astype(np.int64)


def _titles(name: str, unit: str) -> tuple[str, str]:
    return f"{name} - Distance (m)", f"{name}{SECTION} ({unit})"


def _lines(
    profile: Profile, channels: list[tuple[str, str, NDArray[Any]]], first: int, decimals: int
) -> Iterator[str]:
    count = min(ROWS, profile.tracks[0].elevation.size - first)
    index = np.arange(first, first + count)
    places = (profile.start_m + profile.interval_m * index).tolist()
    distances = [repr(round(place, decimals)) for place in places]
    columns = []
    for _, _, values in channels:
        part = values[first : first + count]
        write = str if part.dtype.kind == "i" else write_number
        columns += [distances, [write(value) for value in part.tolist()]]
    return (TAB.join(row) + "\r\n" for row in zip(*columns, strict=True))
