"""HDF5 files as other programs write them; what is elsewhere, damaged or swollen."""

from fractions import Fraction
from pathlib import Path
from typing import Any

import h5py
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from tests.adapters.formats.hdf5.conftest import rows

from floatref import Epoch, InputError, NativeFile
from floatref_adapters.formats.hdf5.adapter import Hdf5
from floatref_adapters.formats.hdf5.dataset_rows import native_file


def ticks(native: NativeFile, stream: str) -> np.ndarray:
    (chosen,) = (s for s in native.streams if s.name == stream)
    return np.concatenate([piece.ticks for piece in chosen.read([])])


@pytest.mark.slow
def test_groups_are_streams_and_datasets_columns(path: Path) -> None:
    with h5py.File(path, "w") as file:
        fast, slow = file.create_group("daq/fast"), file.create_group("daq/slow")
        fast.attrs["sampling_rate"] = 16000
        fast["laser"] = np.arange(4, dtype=np.int16)
        fast["laser"].attrs["units"] = np.bytes_("mm")
        fast["xyz"] = np.arange(8.0).reshape(4, 2)
        slow["time_ms"] = np.array([5, 7, 9], np.uint32)
        slow["pitch"] = np.array([1.5, 2.5, 3.5], np.float32)
        slow["note"] = "hello"
        file["main"] = np.arange(5.0)
        file["table"] = np.array([(1, 2.0), (3, 4.0)], [("t", "i8"), ("v", "f4")])
    native = Hdf5().streams(path, {})
    assert rows(native) == {
        "daq/fast": {"laser": [0, 1, 2, 3], "xyz[0]": [0, 2, 4, 6], "xyz[1]": [1, 3, 5, 7]},
        "daq/slow": {"pitch": [1.5, 2.5, 3.5]},
        "root 5 rows": {"main": [0, 1, 2, 3, 4]},
        "root t": {"v": [2, 4]},
    }
    clocks = {stream.name: stream.clock for stream in native.streams}
    assert clocks["daq/fast"].rate == 16000
    assert clocks["daq/slow"].tick_s == Fraction(1, 1000)
    assert ticks(native, "daq/slow").tolist() == [5, 7, 9]
    assert ticks(native, "root t").tolist() == [1, 3]
    assert clocks["root 5 rows"].name == "unknown"
    units = {c.name: c.unit for s in native.streams for c in s.columns}
    assert units["laser"] == "mm"


@pytest.mark.slow
@settings(deadline=None, max_examples=60)
@given(
    raw=st.lists(st.integers(-32767, 32767), min_size=2, max_size=20),
    scale=st.sampled_from([0.5, 0.01, 1e-6]),
    offset=st.sampled_from([0.0, 273.15, -5.0]),
    data=st.data(),
)
def test_packed_numbers_are_unpacked_as_cf_says(
    tmp_path_factory: pytest.TempPathFactory,
    raw: list[int],
    scale: float,
    offset: float,
    data: st.DataObject,
) -> None:
    lost = data.draw(st.sampled_from(raw))
    word = data.draw(st.sampled_from(["_FillValue", "missing_value"]))
    path = tmp_path_factory.mktemp("run") / "run.nc"
    with h5py.File(path, "w") as file:
        file["x"] = np.array(raw, np.int16)
        file["x"].attrs["scale_factor"] = scale
        file["x"].attrs["add_offset"] = np.array([offset])
        file["x"].attrs[word] = np.array([lost], np.int16)
    found = rows(native_file(path, {}))["root"]["x"]
    expected = [np.nan if k == lost else k * scale + offset for k in raw]
    np.testing.assert_allclose(found, expected, rtol=1e-15, atol=0)


@pytest.mark.slow
def test_times_since_a_date_are_utc_and_scaled_times_stay_integers(path: Path) -> None:
    with h5py.File(path, "w") as file:
        a, b = file.create_group("a"), file.create_group("b")
        a["time"] = np.array([1, 2, 4])
        a["time"].attrs["units"] = "milliseconds since 1970-01-02"
        b["time"] = np.array([10, 20], np.int32)
        b["time"].attrs["scale_factor"] = 0.0001
        a["x"], b["x"] = np.zeros(3), np.zeros(2)
    native = Hdf5().streams(path, {})
    first, second = (stream.clock for stream in native.streams)
    assert (first.epoch, first.origin_ns) == (Epoch.UTC, 86_400 * 10**9)
    assert first.tick_s == Fraction(1, 1000)
    assert (second.tick_s, ticks(native, "b").tolist()) == (Fraction(1, 10_000), [10, 20])


def test_a_dimension_scale_is_the_clock_of_what_it_is_the_scale_of(path: Path) -> None:
    with h5py.File(path, "w") as file:
        file["axes/time"] = np.array([0.5, 1.5, 2.5])
        file["axes/time"].make_scale("time")
        file["data/x"] = np.arange(3.0)
        file["data/x"].dims[0].attach_scale(file["axes/time"])
    native = Hdf5().streams(path, {})
    assert ticks(native, "data").tolist() == [0.5, 1.5, 2.5]


@pytest.mark.slow
def test_a_matlab_file_has_its_columns_across(path: Path) -> None:
    def put(group: Any, name: str, values: np.ndarray, kind: bytes = b"double") -> None:
        group[name] = values
        group[name].attrs["MATLAB_class"] = np.bytes_(kind)

    with h5py.File(path, "w", userblock_size=512) as file:
        run = file.create_group("run")
        put(run, "fs", np.array([[1000.0]]))
        put(run, "height", np.arange(100.0).reshape(1, 100))
        put(run, "acc", np.arange(300.0).reshape(3, 100))
        put(run, "name", np.full((4, 1), 65, np.uint16), b"char")
        file.create_group("#refs#")["a"] = np.arange(9.0)
    assert Hdf5().recognises(path)
    native = Hdf5().streams(path, {})
    found = rows(native)
    assert found["run 1000 Hz"]["height"] == list(range(100))
    assert found["run 1000 Hz"]["acc[1]"] == list(range(100, 200))
    assert not any("#refs#" in stream.name for stream in native.streams)
    assert {s.clock.rate for s in native.streams} == {Fraction(1000)}


@pytest.mark.slow
def test_the_option_time_names_a_dataset(path: Path) -> None:
    with h5py.File(path, "w") as file:
        file["a/clock"], file["a/x"] = np.array([3, 4]), np.zeros(2)
    for name in ("clock", "a/clock"):
        assert ticks(Hdf5().streams(path, {"time": name}), "a").tolist() == [3, 4]
    with pytest.raises(InputError, match="time = 'clokc': no dataset of that name"):
        Hdf5().streams(path, {"time": "clokc"})
