"""Files of many columns come in pieces that stay small, and whole all the same."""

from collections.abc import Callable
from pathlib import Path

import h5py
import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pytest
from nptdms import ChannelObject, TdmsWriter

from floatref import InputError
from floatref_adapters.formats.arrow.adapter import ArrowIpc, Parquet
from floatref_adapters.formats.hdf5.adapter import Hdf5
from floatref_adapters.formats.hdf5.dataset_rows import native_file
from floatref_adapters.formats.tdms.adapter import Tdms
from floatref_adapters.testing.whole_reading import Opener

COLUMNS, ROWS, MOST_SAMPLES = 400, 30_000, 1 << 22
VALUES = np.arange(ROWS, dtype=np.int16)
NAMES = [f"c{k}" for k in range(COLUMNS)]


def write_parquet(path: Path) -> None:
    pq.write_table(pa.table(dict.fromkeys(NAMES, VALUES)), path)


def write_arrow(path: Path) -> None:
    table = pa.table(dict.fromkeys(NAMES, VALUES))
    with pa.ipc.new_file(path, table.schema) as writer:
        writer.write_table(table)


def write_hdf5(path: Path) -> None:
    with h5py.File(path, "w") as file:
        for name in NAMES:
            file.create_dataset(name, data=VALUES, chunks=(700,))


def write_tdms(path: Path) -> None:
    with TdmsWriter(str(path)) as writer:
        writer.write_segment([ChannelObject("g", name, VALUES) for name in NAMES])


@pytest.mark.slow
@pytest.mark.parametrize(
    ("write", "adapter"),
    [
        (write_parquet, Parquet()),
        (write_arrow, ArrowIpc()),
        (write_hdf5, Hdf5()),
        (write_tdms, Tdms()),
    ],
)
def test_a_piece_of_many_columns_has_fewer_rows(
    tmp_path: Path, write: Callable[[Path], None], adapter: Opener
) -> None:
    path = tmp_path / "run.arrow"
    write(path)
    (stream,) = adapter.streams(path, {}).streams
    first = 0
    for rows in stream.read(NAMES):
        lengths = {len(values) for values in rows.values.values()}
        (count,) = lengths
        assert count * COLUMNS <= MOST_SAMPLES
        for name in (NAMES[0], NAMES[-1]):
            np.testing.assert_array_equal(rows.values[name], VALUES[first : first + count])
        first += count
    assert first == stream.count == ROWS


@pytest.mark.slow
def test_large_chunks_of_many_datasets_are_not_unpacked_at_once(tmp_path: Path) -> None:
    path = tmp_path / "run.h5"
    with h5py.File(path, "w") as file:
        for k in range(17):
            item = file.create_dataset(
                f"c{k}", (1 << 22,), "f8", chunks=(1 << 22,), compression="gzip"
            )
            item[0] = 1.0
    (stream,) = native_file(path, {}).streams
    assert next(iter(stream.read(["c1", "c2"]))).values["c2"][0] == 1.0
    with pytest.raises(InputError, match="chunks of 570425344 bytes in 17 datasets; repack"):
        next(iter(stream.read([f"c{k}" for k in range(17)])))
