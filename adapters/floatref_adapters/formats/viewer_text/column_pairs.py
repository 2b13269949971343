"""The header of viewers' text: which columns are a pair, their names and units."""

import re
from collections.abc import Sequence
from typing import NamedTuple

from floatref import InputError
from floatref_adapters.shared.length_units import WHEEL_PATHS, Ratio, find_length_unit
from floatref_adapters.shared.numbered_names import number_repeats

TAB = "\t"
DISTANCE = re.compile(
    r"(?P<name>.*?) *- *Distance *\((?P<unit>[^()]*)\)", re.IGNORECASE | re.DOTALL
)
"""Title of a column of distances, as `LElev - Distance (ft)`."""
UNIT = re.compile(r"(?P<title>.*?) *\((?P<unit>[^()]*)\)", re.DOTALL)
LONGEST_NAME = 48
"""Characters of the longest name of a wheel path; viewers put the name of a file before it."""
SECTION = "_Full"
"""End of the title of a column of values: the section of the profile, here the whole of it."""
VALID, NO_UNIT = " valid", "-"
"""End of the name, and the unit, of a channel that says which points of another are valid."""


class Pair(NamedTuple):
    """A column of distances, and the column of values behind it.

    ``name`` is that of the channel; ``unit`` is the text of the values' unit, "" without one.
    """

    name: str
    distance: int
    distance_title: str
    distance_unit: str
    values: int
    values_title: str
    unit: str


class Layout(NamedTuple):
    """Where the elevations of a file are: pairs by the name of the wheel path.

    ``valid`` has the pairs that say which points are valid, ``left_out`` the titles of all others.
    """

    elevations: dict[str, Pair]
    valid: dict[str, Pair]
    left_out: list[str]


def is_header(line: str) -> bool:
    """Return whether ``line`` begins with the title of a column of distances, and has more."""
    titles = line.split(TAB)
    return len(titles) > 1 and DISTANCE.fullmatch(titles[0].strip()) is not None


def find_layout(titles: Sequence[str], unstated: str = "") -> Layout:
    """Return where the elevations are in a file whose columns have ``titles``.

    ``unstated`` is the unit of values whose title states no unit. Raises InputError for a column of
    distances without values behind it, for values without a unit and for a file without any
    elevation.
    """
    pairs = list_pairs(titles, unstated)
    for pair in pairs:
        if not pair.unit:
            raise InputError(
                f"column {pair.values_title} states no unit; write it behind the title in the "
                f"first line, as {pair.values_title} (in)"
            )
    flags = {p.name: p for p in pairs if p.name.endswith(VALID) and p.unit == NO_UNIT}
    lengths = [p for p in pairs if find_length_unit(p.unit) is not None]
    if not lengths:
        titles_of = ", ".join(pair.values_title for pair in pairs[:8])
        raise InputError(f"no column is an elevation in a unit of length: {titles_of}")
    tracks = number_repeats([_track_name(pair.name) for pair in lengths])
    elevations = dict(zip(tracks, lengths, strict=True))
    valid = {
        track: flags[f"{pair.name}{VALID}"]
        for track, pair in elevations.items()
        if f"{pair.name}{VALID}" in flags
    }
    used = [*elevations.values(), *valid.values()]
    return Layout(elevations, valid, [p.values_title for p in pairs if p not in used])


def _track_name(name: str) -> str:
    """Return the name of a wheel path: the end of one that no profile directory could hold."""
    return WHEEL_PATHS.get(name.lower(), name[-LONGEST_NAME:].lstrip(" ._-"))


def list_pairs(titles: Sequence[str], unstated: str = "") -> list[Pair]:
    """Return the pairs of columns in their order; other columns between them are passed over.

    ``unstated`` is the unit of values whose title has no unit.

    Raises InputError for a column of distances that has no column of values behind it.
    """
    found = [DISTANCE.fullmatch(title.strip()) for title in titles]
    pairs = []
    for place, match in enumerate(found):
        if match is None:
            continue
        if place + 1 == len(titles) or found[place + 1] is not None:
            raise InputError(
                f"column {titles[place].strip()} has no column of values behind it; export it again"
            )
        pairs.append(_pair(titles, place, match, unstated))
    return pairs


def unit_of(pair: Pair) -> tuple[Ratio, Ratio]:
    """Return what one unit of the distances and one of the values of ``pair`` is in m.

    Raises InputError for a unit of distance that is not a length.
    """
    along, up = find_length_unit(pair.distance_unit), find_length_unit(pair.unit)
    if along is None:
        raise InputError(
            f"column {pair.distance_title}: {pair.distance_unit or 'nothing'} is no unit of "
            "length; write m, mm, in, ft, km or mi"
        )
    return along, up or (1, 1)


def _pair(titles: Sequence[str], place: int, match: re.Match[str], unstated: str) -> Pair:
    title = titles[place + 1].strip()
    with_unit = UNIT.fullmatch(title)
    bare, unit = (with_unit["title"], with_unit["unit"]) if with_unit else (title, "")
    name = match["name"]
    if not (name and bare.startswith(name)):
        # Viewers may put a file before the channel; the section is behind the last underscore.
        name = bare.rpartition("_")[0] or bare
    return Pair(
        name.rstrip("."),
        place,
        titles[place].strip(),
        match["unit"],
        place + 1,
        title,
        unit.strip() or unstated,
    )
