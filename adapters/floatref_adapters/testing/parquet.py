"""A recording as a Parquet file."""

from collections.abc import Mapping
from pathlib import Path

from floatref import Recording
from floatref_adapters.shared.libraries import library
from floatref_adapters.testing.arrow_batches import batches
from floatref_adapters.testing.file_writing import check_quanta, replacing


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
        replacing(path) as beside,
        pq.ParquetWriter(
            beside, schema, compression="zstd", use_dictionary=False, write_page_checksum=True
        ) as writer,
    ):
        for batch in rows:
            writer.write_batch(batch)


__all__ = ["write_parquet"]
