"""The summary of all files, as CSV and as Parquet: one row for each segment of each wheel path."""

import csv
import json
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import ExitStack
from itertools import islice
from math import isnan
from pathlib import Path
from typing import Any

from floatref.batch.jobs.job import PROFILES
from floatref.batch.results.record import Record, Row
from floatref.errors import missing_extra
from floatref.files.atomic import replace_file
from floatref.files.sources import check_file
from floatref.measures import rate_iri
from floatref.measures.ride.segment_measures import MEASURES
from floatref.values.display.spreadsheet_cells import write_cell

CSV, PARQUET = "summary.csv", "summary.parquet"
"""Names of the two files; they hold the same values, texts in CSV as `write_cell` has them."""
COLUMNS: Mapping[str, type] = {
    "file": str,
    "name": str,
    "status": str,
    "error": str,
    "track": str,
    "segment": int,
    "start_m": float,
    "length_m": float,
    "latitude_deg": float,
    "longitude_deg": float,
    "iri_m_per_km": float,
    "mean_roughness_index_m_per_km": float,
    "flagged_m": float,
    "warnings": str,
    "pipeline": str,
    "settings": str,
    "versions": str,
    "adapter": str,
    "inputs": str,
    "outputs": str,
    "profile": str,
    "iri_of_valid_m_per_km": float,
    "counted_share": float,
    "iri_of_valid_low_m_per_km": float,
    "iri_of_valid_high_m_per_km": float,
    "mean_roughness_index_of_valid_m_per_km": float,
    "mean_roughness_index_counted_share": float,
}
"""Columns and their types; an unknown value is null, and empty in CSV."""
RATING = "hpms_rating"
NOT_COLUMNS = ("lines_deg", "measures")
"""Fields of a row that are no columns by themselves."""
TOGETHER = 4096
"""Rows in memory at a time, one row group of Parquet."""


def measure_columns(measures: bool) -> Mapping[str, type]:
    """Return the columns of the measures of ride and their types; without ``measures``, no column.

    The rating is that of the mean roughness index of all points, or of the only wheel path.
    """
    return {**dict.fromkeys(MEASURES, float), RATING: str} if measures else {}


def figures_of(row: Row) -> dict[str, Any]:
    """Return the figures of ``row`` by column, those of its measures included; None is unknown."""
    held = {name: value for name, value in vars(row).items() if name not in NOT_COLUMNS}
    if row.measures is not None:
        mean = row.mean_roughness_index_m_per_km
        rated = rate_iri(row.iri_m_per_km if isnan(mean) else mean)
        held |= vars(row.measures) | {RATING: rated}
    return {name: None if value != value else value for name, value in held.items()}


def write_summary(records: Iterable[Record], out: Path, measures: bool = False) -> None:
    """Write `summary.csv` and `summary.parquet` of ``records`` into the folder ``out``.

    With ``measures`` the columns of the measures of ride follow the others. Texts are written to
    the first by `write_cell`.
    A file that failed is one row with its error. Both files are written completely or not at all,
    in bounded memory. Raises InputError where pyarrow is missing, or if they cannot be written.
    """
    pa, parquet = _arrow()
    kinds = {str: pa.string(), int: pa.int64(), float: pa.float64()}
    columns = {**COLUMNS, **measure_columns(measures)}
    schema = pa.schema([(name, kinds[kind]) for name, kind in columns.items()])
    lines = (line for record in records for line in _lines(record, columns))
    with ExitStack() as stack:
        text, table = (
            stack.enter_context(replace_file(out / name, overwrite=True)) for name in (CSV, PARQUET)
        )
        stream = stack.enter_context(text.open("w", encoding="utf-8", newline=""))
        # csv quotes a line feed by itself, a carriage return only if it ends lines.
        sheet = csv.DictWriter(stream, list(columns), lineterminator="\r\n")
        sheet.writeheader()
        groups = stack.enter_context(parquet.ParquetWriter(table, schema, compression="zstd"))
        while batch := list(islice(lines, TOGETHER)):
            sheet.writerows(map(_as_cells, batch))
            groups.write_table(pa.Table.from_pylist(batch, schema))


def _as_cells(line: Mapping[str, Any]) -> dict[str, Any]:
    """Return ``line`` with texts that no spreadsheet takes for formulas."""
    return {k: write_cell(v) if isinstance(v, str) else v for k, v in line.items()}


def _arrow() -> tuple[Any, Any]:
    try:
        import pyarrow as pa
        import pyarrow.parquet as parquet
    except ImportError as error:
        raise missing_extra("the summary needs pyarrow", "batch") from error
    return pa, parquet


def _lines(record: Record, columns: Mapping[str, type]) -> Iterator[dict[str, Any]]:
    """Yield the rows of ``record`` by column; None stands for unknown."""
    same = {name: _writable(value) for name, value in _common(record).items()}
    if not record.rows:
        yield {**dict.fromkeys(columns), **same}
    for row in record.rows:
        held = figures_of(row) | same | {"track": _writable(row.track)}
        yield {name: held.get(name) for name in columns}


def _common(record: Record) -> dict[str, str]:
    """Return what all rows of ``record`` have in common."""
    asked: Mapping[str, Any] = record.key.get("asked", {})
    return {
        "file": record.source,
        "name": record.name,
        "status": "failed" if record.error else "done",
        "error": record.error,
        "warnings": " | ".join((*record.warnings, *record.remarks)),
        "pipeline": record.pipeline,
        "settings": _json(record.key.get("settings", asked.get("settings", {}))),
        "versions": _json(asked.get("versions", {})),
        "adapter": record.key.get("adapter") or asked.get("adapter") or "",
        "inputs": _json(record.inputs),
        "outputs": _json(record.outputs),
        "profile": "" if record.error else f"{PROFILES}/{record.name}",
    }


def _json(value: Mapping[str, Any]) -> str:
    finite = {k: None if isinstance(v, float) and isnan(v) else v for k, v in value.items()}
    return json.dumps(finite, ensure_ascii=False)


def _writable(text: str) -> str:
    """Return ``text`` as UTF-8 holds it: half a pair, as in odd file names, is written out."""
    return text.encode("utf-8", "backslashreplace").decode("utf-8")


def read_columns(out: Path, names: Sequence[str]) -> dict[str, list[Any]]:
    """Return the columns ``names`` of the summary in the folder ``out``; None is unknown."""
    from pyarrow import parquet

    table = parquet.read_table(check_file(out / PARQUET), columns=list(names))
    found: dict[str, list[Any]] = table.to_pydict()
    return found
