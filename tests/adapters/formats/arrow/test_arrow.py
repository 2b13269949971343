"""Parquet and Arrow IPC as other programs write them; what is damaged or swollen."""

from collections.abc import Callable
from datetime import UTC, datetime
from decimal import Decimal
from fractions import Fraction
from pathlib import Path

import numpy as np
import pyarrow as pa
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref import Epoch, InputError, NativeFile
from floatref_adapters.formats.arrow.adapter import ArrowIpc, Parquet
from floatref_adapters.testing.whole_reading import Whole, make_columns, whole

WriteTable = Callable[[pa.Table, Path], None]
few = settings(deadline=None, max_examples=120)


FORMS = {"run.parquet": Parquet(), "run.arrow": ArrowIpc(), "run.arrows": ArrowIpc()}


@pytest.fixture(params=list(FORMS))
def form(request: pytest.FixtureRequest, tmp_path: Path, write_table: WriteTable):
    adapter = FORMS[request.param]

    def read(table: pa.Table, **options: str) -> NativeFile:
        path = tmp_path / request.param
        write_table(table, path)
        assert adapter.recognises(path)
        return adapter.streams(path, options)

    return read


def rows(native: NativeFile) -> Whole:
    """Return the samples of every column of numbers of the only stream, and the ticks."""
    return whole(native.streams[0])


def test_every_type_of_number_comes_as_float64_and_others_are_listed(form) -> None:
    table = pa.table(
        {
            "i8": pa.array([1, None, -3], pa.int8()),
            "u64": pa.array([2**53, 2**60, 0], pa.uint64()),
            "f16": pa.array(np.array([0.5, 1.5, np.nan], np.float16)),
            "money": pa.array([Decimal("1.25"), None, Decimal("-0.75")], pa.decimal128(9, 2)),
            "flag": pa.array([True, False, None]),
            "step": pa.array([2.5, None, 0.5]).dictionary_encode(),
            "text": ["a", "b", None],
            "kind": pa.array(["a", "b", "a"]).dictionary_encode(),
            "list": [[1.0], [2.0, 3.0], None],
        }
    )
    native = form(table)
    found, ticks = rows(native)
    assert ticks is None
    nan = float("nan")
    expected = {
        "i8": [1, nan, -3],
        "u64": [2**53, 2**60, 0],
        "f16": [0.5, 1.5, nan],
        "money": [1.25, nan, -0.75],
        "flag": [1, 0, nan],
        "step": [2.5, nan, 0.5],
    }
    assert list(found) == list(expected)
    for name, values in expected.items():
        np.testing.assert_array_equal(found[name], values)
    assert [c.name for c in native.streams[0].columns if not c.numeric] == ["text", "kind", "list"]
    assert "3 columns hold no numbers: not read" in native.warnings
    assert native.streams[0].clock.name == "unknown"


@pytest.mark.parametrize("deltas", [True, False])
@pytest.mark.parametrize("compression", [None, "zstd"])
def test_a_dictionary_that_grows_or_is_replaced_gives_the_numbers_that_were_meant(
    tmp_path: Path, deltas: bool, compression: str | None
) -> None:
    first = pa.array([1.0, 2.0, 1.0]).dictionary_encode()
    later = pa.DictionaryArray.from_arrays(pa.array([2, 0, None], pa.int32()), [1.0, 2.0, 5.0])
    batches = [pa.record_batch({"x": x}) for x in (first, later)]
    options = pa.ipc.IpcWriteOptions(emit_dictionary_deltas=deltas, compression=compression)
    path = tmp_path / "run.arrows"
    with pa.ipc.new_stream(path, batches[0].schema, options=options) as writer:
        for batch in batches:
            writer.write_batch(batch)
    found, _ = rows(ArrowIpc().streams(path, {}))
    np.testing.assert_array_equal(found["x"], [1, 2, 1, 5, 1, np.nan])


@pytest.mark.slow
@few
@given(
    unit=st.sampled_from(["s", "ms", "us", "ns"]),
    zone=st.sampled_from([None, "UTC", "Europe/Berlin"]),
    ticks=st.lists(st.integers(-(2**62), 2**62), min_size=1, max_size=8),
    form=st.sampled_from(list(FORMS)),
)
def test_time_stamps_are_their_integers(
    tmp_path_factory: pytest.TempPathFactory,
    unit: str,
    zone: str | None,
    ticks: list[int],
    form: str,
    write_table: WriteTable,
) -> None:
    if form == "run.parquet" and unit == "s":
        # Parquet has no time stamps in seconds: they are multiplied when written.
        ticks = [tick % 2**40 for tick in ticks]
    stamps = pa.array(ticks, pa.int64()).cast(pa.timestamp(unit, zone))
    path = tmp_path_factory.mktemp("run") / form
    write_table(pa.table({"when": stamps, "x": np.arange(float(len(ticks)))}), path)
    native = FORMS[form].streams(path, {})
    clock = native.streams[0].clock
    found = rows(native)[1]
    assert found.dtype == np.int64
    seconds = {"s": 1, "ms": 10**3, "us": 10**6, "ns": 10**9}[unit]
    exact = [int(tick) * clock.tick_s for tick in found]
    assert exact == [Fraction(tick, seconds) for tick in ticks]
    assert clock.epoch is (Epoch.UTC if zone else Epoch.LOCAL)


def test_the_clock_is_a_column_named_like_time_or_stated(form) -> None:
    when = [datetime(2024, 5, 1, tzinfo=UTC)] * 2
    table = pa.table({"x": [1.0, 2.0], "t_ms": [5, 7], "gps": [1.5, 2.5], "when": when})
    native = form(table)
    assert rows(native)[1].tolist() == [5, 7]
    assert native.streams[0].clock.tick_s == Fraction(1, 1000)
    native = form(table, time="gps", epoch="gps")
    assert rows(native)[1].tolist() == [1.5, 2.5]
    assert native.streams[0].clock.epoch is Epoch.GPS
    field = pa.field("x", pa.float64(), metadata={"rate_hz": "10", "count": "9"})
    longer = form(pa.table([table["x"]], schema=pa.schema([field])))
    assert longer.streams[0].count == len(rows(longer)[0]["x"]) == 2
    native = form(table.replace_schema_metadata({"rate_hz": "48000/7", "start_s": "0.1"}))
    clock = native.streams[0].clock
    assert (clock.rate, clock.first_tick * clock.tick_s) == (Fraction(48000, 7), Fraction(1, 10))
    for options, said in ({"time": "gsp"}, "no such column"), ({"epoch": "x"}, "epoch = 'x'"):
        with pytest.raises(InputError, match=said):
            form(table, **options)


def test_repeated_names_and_names_with_points_are_told_apart(form) -> None:
    arrays = [pa.array([float(k), k + 0.5]) for k in range(4)]
    table = pa.Table.from_arrays(arrays, ["a", "left.height", "a", "left"])
    assert make_columns(form(table)) == {
        "a": [0, 0.5], "left.height": [1, 1.5], "a #2": [2, 2.5], "left": [3, 3.5]
    }  # fmt: skip


def test_a_nested_column_is_not_taken_for_one_of_its_name(form) -> None:
    table = pa.table({"left": [{"height": 1.0}, {"height": 2.0}], "left.height": [3.0, 4.0]})
    assert make_columns(form(table)) == {"left.height": [3, 4]}


@pytest.mark.parametrize(
    ("column", "said"),
    [
        (pa.array([1, None, 3]), "row 1: its time is missing"),
        (pa.array([1.0, 2.0, float("nan")]), "row 2: its time is nan"),
        (pa.array([1, 2, 2**63], pa.uint64()), "no sound"),
    ],
)
def test_rows_without_a_time_are_refused(form, column: pa.Array, said: str) -> None:
    with pytest.raises(InputError, match=said):
        rows(form(pa.table({"time": column, "x": [1.0, 2.0, 3.0]})))


@pytest.mark.parametrize(
    ("metadata", "said"),
    [
        ({"rate_hz": "fast"}, "column x: rate_hz is 'fast'; give a number"),
        ({"rate_hz": "0"}, "rate in Hz is 0; correct it"),
        ({"rate_hz": "1/0"}, "rate_hz is '1/0'"),
        ({"rate_hz": "1e999999999"}, "rate_hz is '1e999999999'"),
        ({"rate_hz": "10", "start_s": "nan"}, "start_s is 'nan'"),
        ({"rate_hz": "10", "count": "-1"}, "column x: count is '-1'; correct it"),
        ({"time_column": "tiem"}, "column x: time_column is 'tiem', no column"),
    ],
)
def test_metadata_of_no_clock_are_refused(form, metadata: dict[str, str], said: str) -> None:
    schema = pa.schema([pa.field("x", pa.float64(), metadata=metadata)])
    with pytest.raises(InputError, match="run") as caught:
        form(pa.table([[1.0, 2.0]], schema))
    assert said in str(caught.value).replace('"', "'")
