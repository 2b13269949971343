"""Columns of a summary, for a drawing of it."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from floatref.batch.summary import PARQUET


def read_columns(out: Path, names: Sequence[str]) -> dict[str, list[Any]]:
    """Return the columns ``names`` of the summary in the folder ``out``; None is not known."""
    from pyarrow import parquet

    table = parquet.read_table(out / PARQUET, columns=list(names))
    found: dict[str, list[Any]] = table.to_pydict()
    return found
