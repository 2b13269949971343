"""Tables in the forms that Arrow has."""

from collections.abc import Callable
from pathlib import Path

import pyarrow as pa
import pyarrow.parquet as pq
import pytest


@pytest.fixture(scope="session")
def write_table() -> Callable[[pa.Table, Path], None]:
    """Write Parquet, or a file or stream of Arrow in batches of three rows, by the suffix."""

    def write(table: pa.Table, path: Path) -> None:
        if path.suffix == ".parquet":
            pq.write_table(table, path)
            return
        begin = pa.ipc.new_file if path.suffix == ".arrow" else pa.ipc.new_stream
        with begin(path, table.schema) as writer:
            writer.write_table(table, max_chunksize=3)

    return write
