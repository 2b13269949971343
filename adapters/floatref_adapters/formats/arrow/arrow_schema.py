"""The columns of an Arrow table and their clocks, as its schema states them.

Metadata of the schema or of a field may hold `rate_hz` and `start_s`; that of a field `unit`,
`time_column` (the column that holds the times of this one) and `count` (where a column is shorter
than the table, which is filled up with nulls). Columns of one clock and length are one stream.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from floatref import Column, Epoch, InputError, NativeClock
from floatref_adapters.shared.numbered_names import number_repeats
from floatref_adapters.shared.refusals import library
from floatref_adapters.shared.stated_clock import number, read_stated_clock
from floatref_adapters.shared.time_columns import DAY_S, NONE, UNKNOWN, of_epoch, time_column

TICKS: Mapping[str, Fraction] = {
    "s": Fraction(1),
    "ms": Fraction(1, 10**3),
    "us": Fraction(1, 10**6),
    "ns": Fraction(1, 10**9),
}
MOST_COLUMNS = 10_000


@dataclass(frozen=True)
class Field:
    """A column with its place in the schema, its type, and the metadata of its field."""

    index: int
    column: Column
    type: Any
    stated: Mapping[str, str]


@dataclass(frozen=True)
class Table:
    """Columns of one clock: those with ``time``, the place of their times, or a rate."""

    name: str
    fields: tuple[Field, ...]
    clock: NativeClock
    time: int | None
    count: int


def find_tables(
    schema: Any, rows: int, options: Mapping[str, str]
) -> tuple[tuple[Table, ...], tuple[str, ...]]:
    """Return the tables in ``schema``, of at most ``rows`` rows each, and warnings.

    InputError for metadata that no clock can be made of, or an option that names no column.
    """
    fields = _fields(schema)
    default, warnings = _default_time(fields, options)
    stated = (
        read_stated_clock(decode_text(schema.metadata), "schema") if "time" not in options else None
    )
    if stated is not None:
        default, warnings = None, ()
    times = {f.index for f in fields if f.column.name in _list_time_columns(fields)}
    groups: dict[tuple[NativeClock | None, int | None, int], list[Field]] = {}
    for field in fields:
        if field.index in times or field.index == default:
            continue
        clock, time = _clock(field, fields, stated, default)
        groups.setdefault((clock, time, _count(field, rows)), []).append(field)
    if any(clock is None and time is None for clock, time, _ in groups):
        warnings += (UNKNOWN,)
    names = _stream_names([(*key, fields) for key in groups])
    return tuple(
        Table(name, tuple(group), _make_clock(key[0], key[1], fields, options), key[1], key[2])
        for name, (key, group) in zip(names, groups.items(), strict=True)
    ), (*_warn_of_other_types(fields, default), *warnings)


def _fields(schema: Any) -> list[Field]:
    if len(schema.names) > MOST_COLUMNS:
        raise InputError(f"{len(schema.names)} columns; write at most {MOST_COLUMNS} into a file")
    found = []
    for index, (name, field) in enumerate(zip(number_repeats(schema.names), schema, strict=True)):
        stated = decode_text(field.metadata)
        unit = stated.get("unit", stated.get("units", ""))
        notes = [f"another column {field.name}"] if name != field.name else []
        numeric = is_numeric(field.type)
        notes += [] if numeric else [str(field.type)[:60]]
        found.append(
            Field(index, Column(name, unit, "; ".join(notes), numeric), field.type, stated)
        )
    return found


def decode_text(metadata: Mapping[bytes, bytes] | None) -> dict[str, str]:
    """Return ``metadata`` as text, but what other programs keep there at length."""
    return {
        key.decode("utf-8", "replace"): value.decode("utf-8", "replace")
        for key, value in (metadata or {}).items()
        if len(value) <= 200
    }


def is_numeric(kind: Any) -> bool:
    """Tell whether an Arrow type holds numbers, be it as indices into a dictionary of them."""
    types = library("pyarrow.types", "reading Arrow")
    if types.is_dictionary(kind):
        return is_numeric(kind.value_type)
    return bool(
        types.is_integer(kind)
        or types.is_floating(kind)
        or types.is_decimal(kind)
        or types.is_boolean(kind)
    )


def is_temporal(kind: Any) -> bool:
    """Tell whether an Arrow type holds times as integers of a stated unit."""
    types = library("pyarrow.types", "reading Arrow")
    return bool(types.is_timestamp(kind) or types.is_duration(kind) or types.is_time(kind))


def _is_of_day(kind: Any) -> bool:
    """Tell whether an Arrow type holds times of a day."""
    return bool(library("pyarrow.types", "reading Arrow").is_time(kind))


def _default_time(
    fields: Sequence[Field], options: Mapping[str, str]
) -> tuple[int | None, tuple[str, ...]]:
    """Return the place of the column of time, and warnings about it."""
    option = options.get("time")
    usable = [f for f in fields if is_numeric(f.type) or is_temporal(f.type)]
    columns = [field.column for field in usable]
    found = time_column(columns, option)
    if found is not None:
        return usable[found.index].index, found.list_others(columns)
    if option == NONE:
        return None, ()
    stamps = [field.index for field in usable if is_temporal(field.type)]
    return (stamps[0] if stamps else None), ()


def _list_time_columns(fields: Sequence[Field]) -> set[str]:
    return {field.stated["time_column"] for field in fields if "time_column" in field.stated}


def _clock(
    field: Field, fields: Sequence[Field], stated: NativeClock | None, default: int | None
) -> tuple[NativeClock | None, int | None]:
    """Return the clock that is stated for a column, or the place of its times, or neither."""
    name = field.stated.get("time_column")
    if name is not None:
        for other in fields:
            if other.column.name == name and (is_numeric(other.type) or is_temporal(other.type)):
                return None, other.index
        raise InputError(f"column {field.column.name}: time_column is {name[:40]!r}, no column")
    own = read_stated_clock(field.stated, f"column {field.column.name}")
    if own is not None or stated is not None:
        return own or stated, None
    return None, default


def _count(field: Field, rows: int) -> int:
    """Return how many rows a column has: those of the table unless its field states fewer."""
    if "count" not in field.stated:
        return rows
    count = number(field.stated["count"])
    if count is None or count < 0 or count.denominator != 1:
        raise InputError(
            f"column {field.column.name}: count is {field.stated['count'][:40]!r}; correct it"
        )
    return min(int(count), rows)


def _make_clock(
    stated: NativeClock | None,
    time: int | None,
    fields: Sequence[Field],
    options: Mapping[str, str],
) -> NativeClock:
    """Return the clock of a table."""
    if stated is not None:
        return of_epoch(stated, options)
    if time is None:
        return NativeClock(Fraction(1), name="unknown")
    field = fields[time]
    if is_temporal(field.type):
        zone = getattr(field.type, "tz", None)
        tick = TICKS[field.type.unit]
        if zone:
            return NativeClock(tick_s=tick, epoch=Epoch.UTC, name="utc")
        turn_s = Fraction(DAY_S) if _is_of_day(field.type) else None
        return of_epoch(NativeClock(tick_s=tick, turn_s=turn_s), options)
    found = time_column([field.column], field.column.name)
    assert found is not None
    return of_epoch(NativeClock(tick_s=found.unit_s), options)


def _stream_names(
    keys: Sequence[tuple[NativeClock | None, int | None, int, Sequence[Field]]],
) -> list[str]:
    """Return a name for the columns of each clock: `table` for the only ones."""
    if len(keys) == 1:
        return ["table"]
    names = []
    for clock, time, _, fields in keys:
        if time is not None:
            names.append(fields[time].column.name)
        else:
            names.append(f"{clock.rate} Hz" if clock else "table")
    return number_repeats(names)


def _warn_of_other_types(fields: Sequence[Field], default: int | None) -> tuple[str, ...]:
    others = sum(not field.column.numeric and field.index != default for field in fields)
    return (f"{others} columns hold no numbers: not read",) if others else ()


__all__ = ["Field", "Table", "decode_text", "find_tables", "is_numeric", "is_temporal"]
