"""A recording as an Arrow IPC file."""

from collections.abc import Mapping
from pathlib import Path

from floatref import Recording
from floatref_adapters.shared.libraries import library
from floatref_adapters.testing.arrow_batches import batches
from floatref_adapters.testing.file_writing import check_quanta, replacing


def write_arrow(
    recording: Recording, path: Path, quanta: Mapping[str, float] | None = None
) -> None:
    """Write ``recording`` to ``path``; InputError if that fails.

    Samples of channels in ``quanta`` are rounded to multiples of theirs.
    """
    pa = library("pyarrow", "writing Arrow")

    check_quanta(recording, quanta)
    schema, rows = batches(recording, quanta)
    with replacing(path) as beside, pa.ipc.new_file(beside, schema) as writer:
        for batch in rows:
            writer.write_batch(batch)


__all__ = ["write_arrow"]
