"""Writing an ERD file: a header of text lines, then one line of decimals per point.

Sources of the layout, and why the lines are what they are, are in docs/erd.md.
"""

from collections.abc import Iterator, Sequence
from decimal import Decimal
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from floatref import InputError, Profile, ProfileTrack, __version__
from floatref_adapters.formats.erd.erd_header import KEYWORD, LONG_FIELD, SHORT_FIELD, TEXT

FORMAT = "floatref-erd/1"
PIPELINE = "pipeline "
ELEVATION, VALID = " elevation", " valid"
"""How the long names of our channels end."""
SHORT_NAMES = {
    "left": ("LElev", "LValid"),
    "right": ("RElev", "RValid"),
    "main": ("Elev", "Valid"),
}
DECIMALS = 7
"""Decimals of an elevation in m: 0.1 µm, a fiftieth of what a laser resolves."""
HIGHEST_M = 1e6
"""Elevation from zero up to which float64 gives the same decimals back, and far above any road."""
LONGEST_LINE = 1000
LONGEST_TEXT = 80
"""Characters of a line of names, and of a line of free text."""
LONGEST_NUMBER = 40
"""Characters of the step or the start; below 1e-22 m they have an exponent."""
ROWS = 1 << 14
"""Points written together."""
NEW_LINE = "\r\n"

Floats = NDArray[np.float64]


class Column(NamedTuple):
    """One channel of the file: its names and unit, and where its numbers come from."""

    short: str
    long: str
    unit: str
    track: ProfileTrack
    gaps: NDArray[np.int64]
    is_validity: bool = False

    def words(self, first: int, last: int) -> list[str]:
        """Return points ``first`` to ``last`` as they are written."""
        if self.is_validity:
            return ["1" if valid else "0" for valid in self.track.valid[first:last].tolist()]
        values = bridge_gaps(self.track.elevation, self.gaps, first, last)
        return [f"{value:.{DECIMALS}f}" for value in values.tolist()]


def write_erd(profile: Profile, path: Path) -> None:
    """Write ``profile`` to ``path``; its validity where a point is not valid, but no 1-σ.

    A point without elevation is written on the line between its neighbours, and as not valid.
    Raises InputError for a track without any elevation, or beyond `HIGHEST_M`.
    """
    for track in profile.tracks:
        _check(track)
    columns = _columns(profile)
    with path.open("w", encoding="ascii", newline="") as stream:
        stream.writelines(f"{line}{NEW_LINE}" for line in _header(profile, columns))
        count = profile.tracks[0].elevation.size
        for first in range(0, count, ROWS):
            words = [column.words(first, min(first + ROWS, count)) for column in columns]
            stream.writelines(f"{' '.join(row)}{NEW_LINE}" for row in zip(*words, strict=True))


def _check(track: ProfileTrack) -> None:
    highest = np.nanmax(np.abs(track.elevation), initial=-1.0)
    if highest < 0:
        raise InputError(f"track {track.name}: no elevation at any point, which ERD cannot say")
    if highest > HIGHEST_M:
        raise InputError(
            f"track {track.name}: elevation is {highest:g} m; ERD holds up to {HIGHEST_M:g} m, "
            "write a profile directory"
        )


def _columns(profile: Profile) -> list[Column]:
    columns: list[Column] = []
    short: set[str] = set()
    long: set[str] = set()
    for track in profile.tracks:
        label = _unique(_ascii(track.name), LONG_FIELD - len(ELEVATION), long)
        names = SHORT_NAMES.get(track.name, (label, f"{label[:3].rstrip()}Valid"))
        gaps = find_gaps(track.elevation)
        name = _unique(names[0], SHORT_FIELD, short)
        columns.append(Column(name, f"{label}{ELEVATION}", "m", track, gaps))
        if not track.valid.all():
            name = _unique(names[1], SHORT_FIELD, short)
            columns.append(Column(name, f"{label}{VALID}", "-", track, gaps, is_validity=True))
    return columns


def _header(profile: Profile, columns: Sequence[Column]) -> Iterator[str]:
    count = profile.tracks[0].elevation.size
    step, start = _decimal(profile.interval_m), _decimal(profile.start_m)
    by = f" by {profile.pipeline}" if profile.pipeline else ""
    yield "ERDFILEV2.00"
    yield f"{len(columns)}, {count}, -1, 1, {TEXT}, {step}, -1,"
    yield _line("TITLE", f"Road profile{by}")
    yield from _fields("SHORTNAM", [c.short for c in columns], SHORT_FIELD)
    yield from _fields("LONGNAME", [c.long for c in columns], LONG_FIELD)
    yield from _fields("UNITSNAM", [c.unit for c in columns], SHORT_FIELD)
    yield _line("XLABEL", "Distance")
    yield _line("XUNITS", "m")
    yield _line("XSTART", start)
    yield _line("HISTORY", f"{FORMAT}, written by floatref {__version__}")
    if profile.pipeline:
        yield _line("HISTORY", f"{PIPELINE}{profile.pipeline}")
    if any(column.gaps.size for column in columns):
        yield _line("HISTORY", "points not measured are on the line between their neighbours")
    yield "END"


def _line(keyword: str, text: str) -> str:
    return f"{keyword:{KEYWORD}}{_ascii(text)}"[:LONGEST_TEXT].rstrip()


def _fields(keyword: str, texts: Sequence[str], width: int) -> Iterator[str]:
    """Yield the lines of names of a fixed width; the second and later ones begin with &."""
    most = (LONGEST_LINE - KEYWORD) // width
    for first in range(0, len(texts), most):
        start = keyword if first == 0 else f"&{LONGEST_LINE}"
        fields = "".join(f"{text:{width}}" for text in texts[first : first + most])
        yield f"{start:{KEYWORD}}{fields}"


def _decimal(value: float) -> str:
    """Return ``value`` in the fewest digits that give it back, without an exponent if it can be."""
    fixed = f"{Decimal(repr(value)):f}"
    return fixed if len(fixed) <= LONGEST_NUMBER else repr(value)


def _ascii(text: str) -> str:
    return "".join(c if " " <= c <= "~" else "?" for c in text).strip()


def _unique(text: str, width: int, taken: set[str]) -> str:
    """Return ``text`` in at most ``width`` characters, other than all ``taken``, and take it."""
    name, number = text[:width].strip() or "track"[:width], 1
    while name in taken:
        number += 1
        name = f"{text[: width - len(str(number)) - 1].strip()}#{number}"
    taken.add(name)
    return name


Gaps = NDArray[np.int64]


def find_gaps(values: Floats) -> Gaps:
    """Return first and end index of every run of NaN in ``values``, shape (gaps, 2)."""
    missing = np.isnan(values)
    edges = np.flatnonzero(np.diff(missing, prepend=False, append=False))
    return edges.reshape(-1, 2)


def bridge_gaps(values: Floats, gaps: Gaps, first: int, last: int) -> Floats:
    """Return ``values[first:last]`` with its gaps filled; at either end the nearest value stays.

    ``gaps`` are those of ``values``, shape (n,), of which one at least is not NaN.
    """
    stretch = values[first:last]
    missing = np.flatnonzero(np.isnan(stretch))
    if missing.size == 0:
        return stretch
    begin, end = gaps[np.searchsorted(gaps[:, 0], missing + first, "right") - 1].T
    before = np.where(begin > 0, begin - 1, end)
    after = np.where(end < values.size, end, before)
    before = np.where(begin > 0, before, after)
    part = (missing + first - before) / np.maximum(after - before, 1)
    filled = stretch.copy()
    filled[missing] = values[before] + part * (values[after] - values[before])
    return filled
