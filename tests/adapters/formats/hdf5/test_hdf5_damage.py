"""HDF5 files that point elsewhere, are damaged or swollen."""

from pathlib import Path
from typing import Any

import h5py
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from tests.adapters.damage import check_damaged
from tests.adapters.formats.hdf5.conftest import rows

from floatref import Channel, InputError, Recording, UniformClock
from floatref.files.apart import child_process
from floatref_adapters.formats.hdf5.adapter import Hdf5
from floatref_adapters.formats.hdf5.dataset_rows import native_file
from floatref_adapters.testing.hdf5 import write_hdf5


@pytest.mark.slow
def test_what_is_in_other_files_is_not_followed(path: Path) -> None:
    other = path.with_name("other.h5")
    with h5py.File(other, "w") as file:
        file["secret"] = np.arange(3.0)
    path.with_name("raw.bin").write_bytes(np.arange(3.0).tobytes())
    with h5py.File(path, "w") as file:
        file["x"] = np.arange(3.0)
        file["away"] = h5py.ExternalLink(str(other), "secret")
        file["same"] = h5py.SoftLink("/x")
        file["again"] = file["x"]
        file["cycle"] = file["/"]
        file.create_dataset("raw", (3,), "f8", external=str(path.with_name("raw.bin")))
        layout = h5py.VirtualLayout((3,), "f8")
        layout[:] = h5py.VirtualSource(str(other), "secret", shape=(3,))
        file.create_virtual_dataset("virtual", layout)
        file["reference"] = np.array([file["x"].ref] * 3, h5py.ref_dtype)
    native = Hdf5().streams(path, {})
    (numbers,) = rows(native).values()
    assert list(numbers.values()) == [[0, 1, 2]]
    warnings = "\n".join(native.warnings)
    for line in (
        "1 links to other files: left alone",
        "1 soft links: left alone",
        "2 further links to the same object: left alone",
        "2 datasets whose data are in other files: left alone",
    ):
        assert line in warnings
    listed = {c.name: c.numeric for s in native.streams for c in s.columns}
    assert (listed["raw"], listed["virtual"], listed["reference"]) == (False, False, False)


@pytest.mark.slow
def test_rows_that_were_never_written_are_missing(path: Path) -> None:
    with h5py.File(path, "w") as file:
        dataset = file.create_dataset("x", (50,), "f8", chunks=(10,))
        dataset[20:30] = 1.5
        file.create_dataset("empty", (50,), "f8", chunks=(10,))
    native = Hdf5().streams(path, {})
    found = np.array(rows(native)["root"]["x"])
    np.testing.assert_array_equal(np.flatnonzero(found == 1.5), np.arange(20, 30))
    assert np.isnan(np.delete(found, np.arange(20, 30))).all()
    assert "1 datasets without data: left alone" in native.warnings


def test_a_dataset_of_a_billion_rows_is_listed_at_once(path: Path) -> None:
    with h5py.File(path, "w") as file:
        file.create_dataset("x", (10**9,), "f8", chunks=(1 << 16,), compression="gzip")[:10] = 1.0
        wide = file.create_dataset("y", (10**9,), "i1", chunks=(1 << 28,), compression="gzip")
        wide.id.write_direct_chunk((0,), b"x")
    resource = pytest.importorskip("resource", reason="Windows counts no memory so")
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    (stream,) = native_file(path, {}).streams
    assert stream.count == 10**9
    pieces = stream.read(["x"])
    assert np.nansum(next(pieces).values["x"]) == 10
    assert np.isnan(next(pieces).values["x"]).all()
    with pytest.raises(InputError, match=r"/y: chunks of .* repack it in smaller ones"):
        next(stream.read(["y"]))
    assert resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before < 64 << 10


@pytest.mark.slow
@pytest.mark.parametrize("value", ["fast", 0, -1.0, np.nan, np.arange(3)])
def test_attributes_of_no_clock_are_refused(path: Path, value: Any) -> None:
    with h5py.File(path, "w") as file:
        file["x"] = np.arange(3.0)
        file["x"].attrs["rate_hz"] = value
    with pytest.raises(InputError, match=r"run\.h5: x: rate"):
        Hdf5().streams(path, {})


@pytest.mark.slow
def test_a_row_without_its_time_is_refused(path: Path) -> None:
    with h5py.File(path, "w") as file:
        file["t"], file["x"] = np.array([0.0, np.nan, 2.0]), np.arange(3.0)
    with pytest.raises(InputError, match="t: time 1 is nan; every row needs its time"):
        rows(Hdf5().streams(path, {}))


@pytest.mark.slow
@settings(deadline=None, max_examples=10)
@given(data=st.data())
def test_a_damaged_file_is_read_or_refused(
    tmp_path_factory: pytest.TempPathFactory,
    data: st.DataObject,
) -> None:
    path = tmp_path_factory.mktemp("run") / "run.h5"
    clock = UniformClock.of(100.0)
    channels = (
        Channel.of("height", np.arange(50.0), clock),
        Channel.of("distance", np.ones(30), clock),
    )
    write_hdf5(Recording(channels), path)
    check_damaged(Hdf5(), path, data)


@pytest.mark.slow
@pytest.mark.parametrize(
    "ill", ["import os; os.abort()", "import time; time.sleep(60)", "print(1)"]
)
def test_a_library_that_breaks_down_does_no_harm(
    path: Path, monkeypatch: pytest.MonkeyPatch, ill: str
) -> None:
    """Damaged files have crashed and hung the HDF5 library; what it does here stands for that."""
    with h5py.File(path, "w") as file:
        file["x"] = np.arange(3.0)
    (stream,) = Hdf5().streams(path, {}).streams
    monkeypatch.setattr(child_process, "COMMAND", ill)
    monkeypatch.setattr(child_process, "LONGEST_SILENCE_S", 0.5)
    with pytest.raises(InputError, match=r"run\.h5: no sound HDF5 .* copy the complete file again"):
        Hdf5().streams(path, {})
    with pytest.raises(InputError, match="no sound HDF5"):
        list(stream.read(["x"]))


@pytest.mark.slow
def test_a_reader_that_is_left_early_leaves_no_process(path: Path) -> None:
    with h5py.File(path, "w") as file:
        file["x"] = np.zeros(1 << 20)
    (stream,) = Hdf5().streams(path, {}).streams
    pieces = stream.read(["x"])
    next(pieces)
    pieces.close()
    assert next(stream.read(["x"])).values["x"].size == 1 << 16


@pytest.mark.slow
def test_modules_beside_the_file_are_not_imported(
    path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    with h5py.File(path, "w") as file:
        file["x"] = np.arange(3.0)
    for name in ("numpy", "h5py", "pickle"):
        path.with_name(f"{name}.py").write_text("raise SystemExit")
    monkeypatch.chdir(path.parent)
    assert rows(Hdf5().streams(path, {})) == {"root": {"x": [0, 1, 2]}}


def test_other_files_are_not_recognised(path: Path) -> None:
    path.write_bytes(b"\x89HDF\r\n")
    assert not Hdf5().recognises(path)
    with pytest.raises(InputError, match="no sound HDF5"):
        Hdf5().streams(path, {})
    for other in (path.parent, path.with_name("none.h5")):
        assert not Hdf5().recognises(other)
        with pytest.raises(InputError, match="not a file"):
            Hdf5().streams(other, {})
