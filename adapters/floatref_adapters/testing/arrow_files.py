"""A recording as an Arrow IPC file or a Parquet file: one column per channel.

Clocks are metadata of the fields. Columns that are shorter than the longest are filled up with
nulls, and say their `count`. The times of stamped channels are columns `<channel>.time_s`, which
their fields name.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from floatref import Channel, Recording, UniformClock
from floatref_adapters.shared.refusals import library
from floatref_adapters.testing.file_writing import (
    Floats,
    by_clock,
    check_quanta,
    quantum_of,
    replace_file,
    round_to_quantum,
    start_of,
)

ROWS = 1 << 16


@dataclass(frozen=True, eq=False)
class _Part:
    name: str
    values: Floats
    quantum: float | None
    metadata: Mapping[str, str]


def batches(recording: Recording, quanta: Mapping[str, float] | None) -> tuple[Any, Iterator[Any]]:
    """Return the schema of ``recording``, and its record batches of 65 536 rows."""
    pa = library("pyarrow", "writing Arrow")
    parts = [part for group in by_clock(recording.channels) for part in _parts(group, quanta)]
    rows = max(part.values.size for part in parts)
    fields = [pa.field(part.name, pa.float64(), metadata=_count_rows(part, rows)) for part in parts]
    schema = pa.schema(fields, {"vendor": recording.vendor, "model": recording.model})
    return schema, _batches(schema, parts, rows)


def _parts(group: Sequence[Channel], quanta: Mapping[str, float] | None) -> Iterator[_Part]:
    """Yield the columns of the channels in ``group``, which are on one clock."""
    clock = group[0].clock
    if isinstance(clock, UniformClock):
        stated = {"rate_hz": str(clock.rate), "start_s": start_of(clock)}
    else:
        time = f"{group[0].id}.time_s"
        stated = {"time_column": time}
        yield _Part(time, clock.times_s, None, {"unit": "s"})
    for channel in group:
        quantum = quantum_of(channel, quanta)
        yield _Part(str(channel.id), channel.values, quantum, {"unit": channel.unit, **stated})


def _count_rows(part: _Part, rows: int) -> dict[str, str]:
    count = part.values.size
    return {**part.metadata, **({"count": str(count)} if count < rows else {})}


def _batches(schema: Any, parts: Sequence[_Part], rows: int) -> Iterator[Any]:
    pa = library("pyarrow", "writing Arrow")
    for first in range(0, rows, ROWS):
        count = min(ROWS, rows - first)
        arrays = []
        for part in parts:
            values = pa.array(round_to_quantum(part.values[first : first + count], part.quantum))
            missing = pa.nulls(count - len(values), pa.float64())
            arrays.append(pa.concat_arrays([values, missing]) if len(missing) else values)
        yield pa.record_batch(arrays, schema=schema)


def write_arrow(
    recording: Recording, path: Path, quanta: Mapping[str, float] | None = None
) -> None:
    """Write ``recording`` to ``path``; InputError if that fails.

    Samples of channels in ``quanta`` are rounded to multiples of theirs.
    """
    pa = library("pyarrow", "writing Arrow")

    check_quanta(recording, quanta)
    schema, rows = batches(recording, quanta)
    with replace_file(path) as beside, pa.ipc.new_file(beside, schema) as writer:
        for batch in rows:
            writer.write_batch(batch)


def write_parquet(
    recording: Recording, path: Path, quanta: Mapping[str, float] | None = None
) -> None:
    """Write ``recording`` to ``path``; InputError if that fails.

    Samples of channels in ``quanta`` are rounded to multiples of theirs.
    """
    pq = library("pyarrow.parquet", "writing Parquet")

    check_quanta(recording, quanta)
    schema, rows = batches(recording, quanta)
    with (
        replace_file(path) as beside,
        pq.ParquetWriter(
            beside, schema, compression="zstd", use_dictionary=False, write_page_checksum=True
        ) as writer,
    ):
        for batch in rows:
            writer.write_batch(batch)
