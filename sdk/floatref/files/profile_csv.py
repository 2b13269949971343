"""Profiles as CSV: columns `distance_m, <track>_elevation_m, <track>_valid`.

Numbers are written so that float64 reads back the same, and names of wheel paths so that no
spreadsheet takes them for formulas; pipeline, settings, provenance and sigma are in the profile
directory only.
"""

import csv
import io
from collections.abc import Iterator
from itertools import chain, islice
from pathlib import Path

import numpy as np

from floatref.errors import InputError
from floatref.files.atomic import replace_file
from floatref.files.constant_interval import DISTANCE, constant_interval, count_decimals
from floatref.files.document import show
from floatref.files.sources import name_errors, open_bytes
from floatref.values.arrays import FloatArray
from floatref.values.display.spreadsheet_cells import read_cell, write_cell
from floatref.values.profile import Profile, ProfileTrack

ELEVATION = "_elevation_m"
VALID = "_valid"
ROWS = 1 << 16
"""Rows processed together."""

Rows = list[list[str]]


def write_profile_csv(profile: Profile, path: Path, overwrite: bool = False) -> None:
    """Write ``profile`` to the CSV file ``path``, complete or not at all.

    Missing elevation is written as nan. Raises InputError if ``path`` exists and ``overwrite``
    is false, or cannot be written.
    """
    with (
        replace_file(path, overwrite) as beside,
        beside.open("w", encoding="utf-8", newline="") as stream,
    ):
        names = [(f"{t.name}{ELEVATION}", f"{t.name}{VALID}") for t in profile.tracks]
        header = csv.writer(stream, lineterminator="\n")
        header.writerow(map(write_cell, [DISTANCE, *chain(*names)]))
        for first in range(0, profile.tracks[0].elevation.size, ROWS):
            stream.writelines(_lines(profile, first))


def read_profile_csv(path: Path) -> Profile:
    """Return the profile in the CSV file ``path``; columns of other names are ignored.

    An empty or nan elevation is a missing point; without a column of validity all points that have
    an elevation are valid. Raises InputError naming the file, the row and the value for missing
    columns, text that is not a number, and a distance without a constant interval.
    """
    path = Path(path)
    with open_bytes(path) as raw, name_errors(path):
        stream = io.TextIOWrapper(raw, encoding="utf-8-sig", newline="")
        try:
            return _profile(csv.reader(stream, strict=True))
        except UnicodeDecodeError as error:
            raise InputError("not UTF-8 text; give a profile directory or a CSV") from error
        except csv.Error as error:
            raise InputError(f"not a CSV ({error}); give a profile directory or a CSV") from error
        finally:
            stream.detach()


def _lines(profile: Profile, first: int) -> Iterator[str]:
    rows = slice(first, first + ROWS)
    index = np.arange(first, min(first + ROWS, profile.tracks[0].elevation.size))
    columns = [map(repr, (profile.start_m + profile.interval_m * index).tolist())]
    for track in profile.tracks:
        columns.append(map(repr, track.elevation[rows].tolist()))
        columns.append(map(str, track.valid[rows].astype(int).tolist()))
    return (",".join(row) + "\n" for row in zip(*columns, strict=True))


def _profile(reader: Iterator[list[str]]) -> Profile:
    header = [read_cell(name.strip()) for name in next(reader, [])]
    names = _tracks(header)
    wanted = _find_columns(header, names)
    columns, decimals = _read_columns(reader, header, wanted)
    distance = columns[DISTANCE]
    start, interval = constant_interval(distance, decimals)
    tracks = tuple(
        ProfileTrack.of(name, columns[f"{name}{ELEVATION}"], columns.get(f"{name}{VALID}"))
        for name in names
    )
    return Profile(interval, tracks, start)


def _tracks(header: list[str]) -> list[str]:
    names = [name[: -len(ELEVATION)] for name in header if name.endswith(ELEVATION)]
    if DISTANCE in header and names:
        return names
    if len(header) == 1 and (";" in header[0] or "\t" in header[0]):
        raise InputError(
            "columns are not separated by commas; export with commas and decimal points"
        )
    raise InputError(
        f"columns are {show(', '.join(header))}; "
        f"expected {DISTANCE}, <track>{ELEVATION} and optionally <track>{VALID}"
    )


def _find_columns(header: list[str], names: list[str]) -> dict[str, int]:
    """Return the columns to read and their positions."""
    ours = [DISTANCE, *(f"{n}{suffix}" for n in names for suffix in (ELEVATION, VALID))]
    for name in ours:
        if header.count(name) > 1:
            raise InputError(f"column {name}: given twice; rename one of them")
    return {name: header.index(name) for name in ours if name in header}


def _read_columns(
    reader: Iterator[list[str]], header: list[str], wanted: dict[str, int]
) -> tuple[dict[str, FloatArray], int]:
    """Return the requested columns, and the most decimals of a distance near the start."""
    parts: dict[str, list[FloatArray]] = {name: [] for name in wanted}
    first, decimals = 2, 0
    while rows := list(islice(reader, ROWS)):
        _check_widths(rows, header, first)
        for name, at in wanted.items():
            parts[name].append(_numbers([row[at] for row in rows], name, first))
        if first == 2:
            decimals = max(count_decimals(row[wanted[DISTANCE]]) for row in rows[:1000])
        first += len(rows)
    if first == 2:
        raise InputError("no rows below the header; copy the complete file")
    return {name: np.concatenate(arrays) for name, arrays in parts.items()}, decimals


def _check_widths(rows: Rows, header: list[str], first: int) -> None:
    for number, row in enumerate(rows, first):
        if len(row) != len(header):
            cut = "the file is truncated, or a line is empty"
            comma = "write decimal points, not decimal commas"
            raise InputError(
                f"row {number} has {len(row)} fields, the header {len(header)}; "
                f"{comma if len(row) > len(header) else cut}"
            )


def _numbers(texts: list[str], name: str, first: int) -> FloatArray:
    """Return a column's numbers; an empty field is NaN, or 0 in a column of validity."""
    empty = 0.0 if name.endswith(VALID) else np.nan
    try:
        numbers = np.array([float(text) if text else empty for text in texts])
    except ValueError:
        bad = next(i for i, text in enumerate(texts) if not _is_number(text))
        raise InputError(
            f"row {first + bad}: {name} is {show(texts[bad])}; "
            "write a number with a decimal point, or nan"
        ) from None
    if name.endswith(VALID) and not np.isin(numbers, (0, 1)).all():
        bad = int(np.argmin(np.isin(numbers, (0, 1))))
        raise InputError(f"row {first + bad}: {name} is {show(texts[bad])}; write 0 or 1")
    return numbers


def _is_number(text: str) -> bool:
    try:
        float(text or "nan")
    except ValueError:
        return False
    return True
