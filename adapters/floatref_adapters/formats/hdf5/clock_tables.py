"""Which datasets of an HDF5 file were taken together: one group, one length, one clock."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction

from floatref import Column, Epoch, InputError, NativeClock
from floatref_adapters.formats.hdf5.object_tree import Group, Tree
from floatref_adapters.formats.hdf5.series import Series, find_series
from floatref_adapters.shared.numbered_names import number_repeats
from floatref_adapters.shared.stated_clock import read_stated_clock
from floatref_adapters.shared.time_columns import (
    NONE,
    UNKNOWN,
    TimeColumn,
    find_unit,
    of_epoch,
    time_column,
)
from floatref_adapters.shared.time_texts import read_iso_ns

ROOT = "root"
"""What the group that holds all others is called."""
_Clock = tuple[NativeClock | None, Series | None]


@dataclass(frozen=True, eq=False)
class Table:
    """Columns of one clock: those with a series ``time`` of ticks, or a rate."""

    name: str
    series: tuple[Series, ...]
    clock: NativeClock
    time: Series | None
    count: int


def find_tables(
    tree: Tree, options: Mapping[str, str]
) -> tuple[tuple[Table, ...], tuple[str, ...]]:
    """Return the tables in ``tree``, and warnings.

    InputError for attributes that no clock can be made of, or an option that names no dataset.
    """
    everything = [(group, _series(group)) for group in tree.groups]
    scales = {s.dataset.path: s for _, several in everything for s in several}
    tables: list[Table] = []
    warnings: list[str] = []
    for group, series in everything:
        tables += _tables(group, series, scales, options, warnings)
    option = options.get("time")
    if option not in (None, NONE) and not any(_is(t.time, option) for t in tables):
        raise InputError(f"time = {option!r}: no dataset of that name and of the others' length")
    if any(table.clock.name == "unknown" for table in tables):
        warnings.append(UNKNOWN)
    names = number_repeats([table.name for table in tables])
    return tuple(replace(t, name=n) for t, n in zip(tables, names, strict=True)), tuple(warnings)


def _is(series: Series | None, name: str | None) -> bool:
    return series is not None and name in (series.dataset.path, series.column.name)


def _series(group: Group) -> list[Series]:
    """Return the columns of ``group`` with a name of their own each."""
    found = [series for dataset in group.datasets for series in find_series(dataset)]
    names = number_repeats([series.column.name for series in found])
    return [
        s if s.column.name == name else replace(s, column=_rename(s.column, name))
        for s, name in zip(found, names, strict=True)
    ]


def _rename(column: Column, name: str) -> Column:
    note = "; ".join(filter(None, (column.note, f"another column {column.name}")))
    return replace(column, name=name, note=note)


def _tables(
    group: Group,
    series: Sequence[Series],
    scales: Mapping[str, Series],
    options: Mapping[str, str],
    warnings: list[str],
) -> list[Table]:
    """Return the tables of one group, the columns of time left out."""
    times = _times(series, options.get("time"), warnings)
    stated = read_stated_clock(group.attributes, group.path or ROOT)
    parts: dict[tuple[int, NativeClock | None, str], list[Series]] = {}
    clocks: dict[tuple[int, NativeClock | None, str], Series | None] = {}
    for one in series:
        if one in times.values():
            continue
        clock, time = _clock(one, times, scales, stated, "time" in options)
        key = (one.count, clock, f"{time.dataset.path}/{time.column.name}" if time else "")
        parts.setdefault(key, []).append(one)
        clocks[key] = time
    whole = group.path or ROOT
    return [
        Table(
            whole if len(parts) == 1 else _name(whole, key[1], clocks[key], key[0]),
            tuple(several),
            _make_clock(key[1], clocks[key], options),
            clocks[key],
            key[0],
        )
        for key, several in parts.items()
    ]


def _name(group: str, clock: NativeClock | None, time: Series | None, count: int) -> str:
    if time is not None:
        return f"{group} {time.column.name}"
    return f"{group} {clock.rate} Hz" if clock else f"{group} {count} rows"


def _times(
    series: Sequence[Series], option: str | None, warnings: list[str]
) -> dict[tuple[str, int], Series]:
    """Return the column of time of every length, by the dataset that compound ones are in."""
    found: dict[tuple[str, int], Series] = {}
    places = dict.fromkeys((_place(s), s.count) for s in series)
    for place, count in places:
        usable = [s for s in series if (_place(s), s.count) == (place, count) and s.column.numeric]
        columns = [s.column for s in usable]
        if option not in (None, NONE):
            named = [s for s in usable if _is(s, option)]
            if named:
                # The unit is checked, as that of a name that is found.
                time_column([named[0].column], named[0].column.name)
                found[place, count] = named[0]
                continue
        chosen = time_column(columns, NONE if option == NONE else None)
        if isinstance(chosen, TimeColumn):
            found[place, count] = usable[chosen.index]
            warnings += chosen.list_others(columns)
    return found


def _place(series: Series) -> str:
    """Return where the times of ``series`` are looked for: in its table, or in its group."""
    return series.dataset.path if series.part is not None else ""


def _clock(
    series: Series,
    times: Mapping[tuple[str, int], Series],
    scales: Mapping[str, Series],
    stated: NativeClock | None,
    chosen: bool,
) -> _Clock:
    """Return the clock that is stated for a series, or the series of its times, or neither."""
    own = read_stated_clock(series.dataset.attributes, series.dataset.path)
    time = times.get((_place(series), series.count))
    if own is not None and not (chosen and time):
        return own, None
    if time is not None:
        return None, time
    scale = scales.get(series.dataset.scale)
    if scale is not None and scale.count == series.count and find_unit(scale.column) is not None:
        return None, scale
    return stated, None


def _make_clock(
    stated: NativeClock | None, time: Series | None, options: Mapping[str, str]
) -> NativeClock:
    """Return the clock of a table."""
    if stated is not None:
        return of_epoch(stated, options)
    if time is None:
        return NativeClock(Fraction(1), name="unknown")
    found = time_column([time.column], time.column.name)
    assert found is not None
    tick = found.unit_s * (time.scale if time.integral else 1)
    _, since, origin = time.column.unit.partition(" since ")
    began = read_iso_ns(origin.strip()) if since else None
    if since and began is None:
        began = read_iso_ns(f"{origin.strip()} 00:00")
    if began is not None:
        return NativeClock(tick_s=tick, epoch=Epoch.UTC, origin_ns=began, name="utc")
    return of_epoch(NativeClock(tick_s=tick), options)
