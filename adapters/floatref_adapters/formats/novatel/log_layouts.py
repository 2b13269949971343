"""What the columns of a NovAtel log are, by the receivers' own list of logs in novatel_edie."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import partial
from operator import attrgetter
from typing import Any

from floatref import Column
from floatref_adapters.formats.novatel.field_units import QUALITIES, SOLVED, find_unit

NAN = float("nan")
WIDTHS = {
    **dict.fromkeys(("CHAR", "UCHAR", "HEXBYTE"), 1),
    **dict.fromkeys(("SHORT", "USHORT"), 2),
    **dict.fromkeys(("DOUBLE", "LONGLONG", "ULONGLONG"), 8),
}
"""Bytes of a field by its type; all others, enumerations too, have 4."""
PLAIN = ("DOUBLE", "FLOAT", "LONG", "ULONG", "SHORT", "USHORT", "UCHAR")
WRITTEN = tuple("cmTZ")
"""Types that are numbers and need no look, unless they are written as characters or names."""
FIXED = ("SIMPLE", "ENUM", "BITFIELD", "FIXED_LENGTH_ARRAY")
TEXTS = ("%s", "%Z")
"""Arrays that are one field in ASCII."""
UNKNOWN = "EDIE_UNKNOWN"
TAKEN = frozenset(("name", "header", "encode"))
"""What a decoded log calls something else."""

Values = Mapping[str, Callable[[Any], float]]


@dataclass(frozen=True, eq=False)
class LogLayout:
    """Columns of one definition of a log, how to have them, and the least size of the log.

    ``size`` is in bytes, ``fields`` counts those in ASCII. A log with lists of varying length
    has no columns.
    """

    columns: tuple[Column, ...]
    values: Values
    size: int
    fields: int


def find_layout(definition: Any, crc: int | None) -> LogLayout:
    """Return the layout of the log ``definition`` with the fields that ``crc`` stands for."""
    versions = definition.fields
    fields = versions.get(crc, versions.get(definition.latest_message_crc, ()))
    if not fields or any(field.type.name not in FIXED for field in fields):
        return LogLayout((), {}, 0, 0)
    last = fields[-1]
    pairs = dict(pair for field in fields for pair in _columns(definition.name, field))
    pairs.update(_derive(fields))
    return LogLayout(
        tuple(column for column, _ in pairs.values()),
        {name: value for name, (_, value) in pairs.items()},
        last.index + _width(last),
        sum(1 if _is_text(field) else _length(field) for field in fields),
    )


def _length(field: Any) -> int:
    return int(field.array_length) if field.type.name == "FIXED_LENGTH_ARRAY" else 1


def _is_text(field: Any) -> bool:
    return field.type.name == "FIXED_LENGTH_ARRAY" and field.conversion in TEXTS


def _is_plain(field: Any) -> bool:
    plain = field.type.name == "SIMPLE" and field.data_type.name in PLAIN
    return plain and not field.conversion.endswith(WRITTEN)


def _width(field: Any) -> int:
    return _length(field) * WIDTHS.get(field.data_type.name, 4)


Pair = tuple[str, tuple[Column, Callable[[Any], float]]]


def _columns(log: str, field: Any) -> list[Pair]:
    name = field.name
    if _is_text(field) or name in TAKEN:
        return []
    unit = find_unit(log, name)
    note = f"number of {field.enum_def.name}" if field.type.name == "ENUM" else unit.note
    if field.type.name != "FIXED_LENGTH_ARRAY":
        value = attrgetter(name) if _is_plain(field) else partial(_number, name)
        return [(name, (Column(name, unit.text, note), value))]
    elements = [f"{name}[{k}]" for k in range(_length(field))]
    return [
        (element, (Column(element, unit.text, note), partial(_element, name, k)))
        for k, element in enumerate(elements)
    ]


def _derive(fields: Any) -> list[Pair]:
    names = {field.name for field in fields}
    enums = {f.enum_def.name: f.name for f in reversed(fields) if f.type.name == "ENUM"}
    pairs: list[Pair] = []
    if "SolType" in enums:
        note = f"as in NMEA GGA, from {enums['SolType']}: 4 RTK fixed, 5 RTK float"
        status = enums.get("SolStatus", enums.get("INSStatus"))
        value = partial(_quality, enums["SolType"], status)
        pairs.append(("quality", (Column("quality", "1", note), value)))
    height = next((n for n in ("height", "orthometric_height") if n in names), None)
    if height is not None and "undulation" in names:
        column = Column("ellipsoidal_height", "m", f"{height} + undulation")
        pairs.append((column.name, (column, partial(_ellipsoidal, height))))
    return pairs


def _as_number(value: Any) -> float:
    if getattr(value, "name", "") == UNKNOWN or not isinstance(value, int | float):
        return NAN
    return float(value)


def _number(name: str, message: Any) -> float:
    return _as_number(getattr(message, name))


def _element(name: str, k: int, message: Any) -> float:
    values = getattr(message, name)
    return _as_number(values[k]) if k < len(values) else NAN


def _quality(kind: str, status: str | None, message: Any) -> float:
    """Return 0 unless the solution was computed."""
    if status is not None and getattr(message, status).name not in SOLVED:
        return 0.0
    return QUALITIES.get(getattr(message, kind).name, NAN)


def _ellipsoidal(height: str, message: Any) -> float:
    return _number(height, message) + _number("undulation", message)
