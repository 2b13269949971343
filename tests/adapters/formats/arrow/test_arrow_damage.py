"""Parquet and Arrow IPC files that are damaged, cut short or swollen."""

import base64
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pyarrow.parquet.encryption as encryption
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from tests.adapters.damage import check_damaged

from floatref import Channel, InputError, Recording, UniformClock
from floatref_adapters.formats.arrow.adapter import ArrowIpc, Parquet
from floatref_adapters.testing import WRITERS
from floatref_adapters.testing.whole_reading import make_columns

WriteTable = Callable[[pa.Table, Path], None]
ZSTD = b"\x28\xb5\x2f\xfd"
"""What zstd begins with."""
few = settings(deadline=None, max_examples=120)


@pytest.mark.slow
@few
@given(data=st.data(), suffix=st.sampled_from([".parquet", ".arrow"]))
def test_a_damaged_file_is_read_or_refused(
    tmp_path_factory: pytest.TempPathFactory,
    data: st.DataObject,
    suffix: str,
) -> None:
    path = tmp_path_factory.mktemp("run") / f"run{suffix}"
    clock = UniformClock.of(100.0)
    channels = (
        Channel.of("height", np.arange(50.0), clock),
        Channel.of("distance", np.ones(30), clock),
    )
    WRITERS[suffix](Recording(channels), path, None)
    check_damaged(Parquet() if suffix == ".parquet" else ArrowIpc(), path, data)


def test_rows_that_no_row_group_holds_are_refused(tmp_path: Path) -> None:
    """A fuzzer's file: its footer counts forty rows, and lists no row group."""
    path = tmp_path / "a.parquet"
    path.write_bytes((Path(__file__).parent / "data" / "no_row_group.parquet").read_bytes())
    with pytest.raises(InputError, match=r"counts 40 rows, its row groups hold 0; copy the comp"):
        Parquet().streams(path, {})


def test_a_column_of_fewer_values_than_its_row_group_counts_is_refused(tmp_path: Path) -> None:
    """A fuzzer's file: by its footer one of the columns has -23 of forty values."""
    path = tmp_path / "a.parquet"
    path.write_bytes((Path(__file__).parent / "data" / "fewer_values.parquet").read_bytes())
    (stream,) = Parquet().streams(path, {}).streams
    with pytest.raises(InputError, match=r"counts 40 rows, its columns hold 0; copy the complete"):
        list(stream.read([column.name for column in stream.columns]))


@pytest.mark.parametrize("suffix", [".arrow", ".arrows"])
def test_whole_batches_of_a_file_that_was_cut_short_are_read(
    tmp_path: Path, suffix: str, write_table: WriteTable
) -> None:
    path = tmp_path / f"run{suffix}"
    write_table(pa.table({"x": np.arange(9.0)}), path)
    whole = path.read_bytes()
    third = whole.rindex(np.array([6.0, 7.0]).tobytes())
    path.write_bytes(whole[: third + 4])
    native = ArrowIpc().streams(path, {})
    assert make_columns(native) == {"x": [0, 1, 2, 3, 4, 5]}
    assert native.streams[0].count == 6
    assert native.warnings[0].startswith("behind row 6: ")


PEAK = """
import sys
from pathlib import Path
from floatref_adapters.formats.arrow.adapter import Parquet
(stream,) = Parquet().streams(Path(sys.argv[1]), {}).streams
pieces = stream.read(["x"])
sizes = {next(pieces).values["x"].size for _ in range(400)}
peak = next(line for line in open("/proc/self/status") if line.startswith("VmHWM"))
print(stream.count, max(sizes), peak.split()[1])
"""


@pytest.mark.slow
@pytest.mark.skipif(not Path("/proc/self/status").exists(), reason="tells no peak of memory")
def test_a_parquet_file_of_a_billion_rows_takes_little_memory(tmp_path: Path) -> None:
    """A billion missing samples take two megabytes; 400 pieces go over a row group's end."""
    path = tmp_path / "run.parquet"
    piece = pa.table({"x": pa.nulls(1 << 24, pa.float64())})
    with pq.ParquetWriter(path, piece.schema, compression="zstd") as writer:
        for _ in range(60):
            writer.write_table(piece, row_group_size=1 << 24)
    assert path.stat().st_size < 4 << 20
    command = [sys.executable, "-c", PEAK, str(path)]
    said = subprocess.run(command, capture_output=True, text=True, check=True).stdout
    count, largest, peak_kib = map(int, said.split())
    assert count == 60 << 24
    assert largest <= 1 << 16
    # One row group as float64 would take 128 MiB more.
    assert peak_kib < 200 << 10


def write_compressed(batch: pa.RecordBatch, path: Path) -> None:
    options = pa.ipc.IpcWriteOptions(compression="zstd")
    with pa.ipc.new_file(path, batch.schema, options=options) as writer:
        writer.write_batch(batch)


def test_a_compressed_batch_that_swells_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "run.arrow"
    table = pa.table({"x": pa.array(np.zeros((1 << 25) + 1, np.int8))})
    write_compressed(table.to_batches()[0], path)
    assert path.stat().st_size < 1 << 16
    with pytest.raises(InputError, match="compressed batch of 33554433 rows; write batches of"):
        ArrowIpc().streams(path, {})


@pytest.mark.slow
def test_a_compressed_dictionary_that_swells_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "run.arrow"
    values = pa.array([b"\0" * (1 << 27)])
    column = pa.DictionaryArray.from_arrays(pa.array([0], pa.int8()), values)
    batch = pa.record_batch({"x": pa.array([1.0]), "text": column})
    write_compressed(batch, path)
    assert path.stat().st_size < 1 << 16
    with pytest.raises(InputError, match=r"compressed dictionaries of 134217.*; write plain"):
        ArrowIpc().streams(path, {})


@pytest.mark.parametrize("size", [1 << 31, 1 << 60])
def test_a_buffer_that_says_it_unpacks_to_more_than_its_rows_is_refused(
    tmp_path: Path, size: int
) -> None:
    """Eight bytes in front of a buffer are the size that it has when it is unpacked."""
    path, values = tmp_path / "run.arrow", np.zeros(1000)
    write_compressed(pa.record_batch({"a": values}), path)
    sound, told = path.read_bytes(), values.nbytes.to_bytes(8, "little")
    path.write_bytes(sound.replace(told + ZSTD, size.to_bytes(8, "little") + ZSTD))
    assert path.read_bytes() != sound
    with pytest.raises(InputError, match=rf"a buffer of .* bytes that unpacks to {size}, in a"):
        list(ArrowIpc().streams(path, {}).streams[0].read(["a"]))


def test_compressed_batches_are_not_unpacked_for_many_columns_at_once(tmp_path: Path) -> None:
    path = tmp_path / "run.arrow"
    long = pa.nulls(1 << 24, pa.null())
    batch = pa.record_batch({"abcdef"[k]: long.cast(pa.bool_()) for k in range(5)})
    write_compressed(batch, path)
    (stream,) = ArrowIpc().streams(path, {}).streams
    assert len(next(iter(stream.read(["a", "b", "c", "d"]))).values["a"]) == 1 << 16
    with pytest.raises(InputError, match="16777216 rows for 5 columns at once; write batches of"):
        next(iter(stream.read(list("abcde"))))


class Keys(encryption.KmsClient):
    """Wraps keys in nothing."""

    def __init__(self, _: object) -> None:
        super().__init__()

    def wrap_key(self, key: bytes, _: str) -> bytes:
        return base64.b64encode(key)


@pytest.mark.parametrize("plain", [True, False])
def test_an_encrypted_file_is_told_as_such(tmp_path: Path, plain: bool) -> None:
    path = tmp_path / "run.parquet"
    table = pa.table({"x": [1.0, 2.0]})
    made = encryption.EncryptionConfiguration("k", column_keys={"c": ["x"]}, plaintext_footer=plain)
    keys = encryption.CryptoFactory(Keys)
    secret = keys.file_encryption_properties(encryption.KmsConnectionConfig(), made)
    with pq.ParquetWriter(path, table.schema, encryption_properties=secret) as writer:
        writer.write_table(table)
    assert Parquet().recognises(path)
    with pytest.raises(InputError, match=r"rypt.*; write it without encryption"):
        list(Parquet().streams(path, {}).streams[0].read(["x"]))


def test_other_files_are_not_recognised(tmp_path: Path) -> None:
    for adapter in (Parquet(), ArrowIpc()):
        for text in (b"", b"PA", b"time,x\n1,2\n", b"\x89HDF\r\n\x1a\n"):
            path = tmp_path / "run.arrow"
            path.write_bytes(text)
            assert not adapter.recognises(path)
        for path in (tmp_path, tmp_path / "none.parquet"):
            assert not adapter.recognises(path)
            with pytest.raises(InputError, match="not a file"):
                adapter.streams(path, {})
