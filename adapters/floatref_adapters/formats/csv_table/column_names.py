"""The names and units above the rows of a table."""

import re
from collections.abc import Sequence

from floatref import Column
from floatref_adapters.shared.numbered_names import number_repeats

_UNITS = (
    "s sec ms us µs μs ns min h m mm cm km um µm μm in inch ft mi mil g mg kg gal mgal m/s m/s2 "
    "m/s^2 m/s² m/s/s mm/s km/h kmh kph mph kn knots deg ° degrees rad mrad grad deg/s °/s dps "
    "rad/s v mv uv a ma hz khz % - 1 °c degc k bar mbar pa kpa hpa n nm rpm count counts pulses "
    "pulse raw lsb bit"
)
UNITS = frozenset(_UNITS.split())
"""What is a unit in round brackets or in a row of its own, in small letters."""
_SQUARE = re.compile(r"(?P<name>.*\S)\s*\[(?P<unit>[^\[\]]*)\]", re.S)
_ROUND = re.compile(r"(?P<name>.*\S)\s*\((?P<unit>[^()]*)\)", re.S)
_BRACKETS = (("[", "]"), ("(", ")"))


def is_unit(text: str) -> bool:
    """Tell whether ``text`` reads as a unit, without brackets."""
    plain = text.strip().lower()
    return plain in UNITS or bool(re.search(r"[/²³°^·]", plain))


def is_unit_row(fields: Sequence[str]) -> bool:
    """Tell whether every field is a unit or nothing, and one is a unit."""
    plain = [_bare(field) for field in fields]
    return any(plain) and all(
        not bare or bare != field or is_unit(bare)
        for bare, field in zip(plain, fields, strict=True)
    )


def name_and_unit(text: str) -> tuple[str, str]:
    """Return name and unit of a field such as `height [mm]` or `height (mm)`; "" is no unit."""
    square = _SQUARE.fullmatch(text.strip())
    if square:
        return square["name"].strip(), square["unit"].strip()
    around = _ROUND.fullmatch(text.strip())
    if around and is_unit(around["unit"]):
        return around["name"].strip(), around["unit"].strip()
    return text.strip(), ""


def make_columns(
    names: Sequence[str], units: Sequence[str], numeric: Sequence[bool]
) -> tuple[Column, ...]:
    """Return the columns under a row of ``names`` and one of ``units``, "" for no unit."""
    first = re.sub(r"^\s*(#+|%+|//)\s*", "", names[0])
    pairs = [name_and_unit(name) for name in (first, *names[1:])]
    plain = [name or f"column {k}" for k, (name, _) in enumerate(pairs, 1)]
    found = []
    for name, unique, (_, unit), row, is_numeric in zip(
        plain, number_repeats(plain), pairs, units, numeric, strict=True
    ):
        note = f"another column {name}" if unique != name else ""
        if not is_numeric:
            note = "; ".join(filter(None, (note, "text")))
        found.append(Column(unique, _bare(row) or unit, note, is_numeric))
    return tuple(found)


def _bare(text: str) -> str:
    """Return ``text`` without the brackets around it."""
    plain = text.strip()
    for left, right in _BRACKETS:
        if plain.startswith(left) and plain.endswith(right):
            return plain[1:-1].strip()
    return plain
