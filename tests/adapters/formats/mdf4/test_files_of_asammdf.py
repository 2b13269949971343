"""MDF 4 and asammdf: each reads what the other has written."""

import warnings
from functools import partial
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from floatref import Channel, Recording, UniformClock
from floatref_adapters.formats.mdf4.adapter import Mdf4
from floatref_adapters.testing.mdf4 import write_mdf4
from floatref_adapters.testing.whole_reading import read_whole

read = partial(read_whole, Mdf4())


def asammdf_file(path: Path, version: str, compression: int) -> dict[str, NDArray[np.float64]]:
    """Write channels of many kinds with asammdf; return the numbers to be read."""
    from asammdf import MDF, Signal

    rng = np.random.default_rng(5)
    n = 70_000
    t = np.arange(n) / 128
    ints, floats = rng.integers(-(2**15), 2**15, n), rng.normal(size=n)
    invalid = rng.random(n) < 0.1
    texts = {"val_0": 0, "text_0": b"off", "val_1": 1, "text_1": b"on"}
    pair = np.rec.fromarrays([ints, floats], names=["first", "second"])
    signals = [
        Signal(ints.astype("i2"), t, name="linear", unit="m", conversion={"a": 0.5, "b": 1.0}),
        Signal(ints.astype(">i2"), t, name="big"),
        Signal(floats.astype("f4"), t, name="short"),
        Signal(floats, t, name="marked", invalidation_bits=invalid),
        Signal(ints, t, name="formula", conversion={"formula": "X * X + 1"}),
        Signal((ints % 2).astype("u1"), t, name="state", conversion=texts),
        Signal(np.array([b"word"] * n), t, name="word", encoding="utf-8"),
        Signal(pair, t, name="pair"),
    ]
    with warnings.catch_warnings(), MDF(version=version) as mdf:
        warnings.simplefilter("ignore")
        mdf.append(signals, acq_name="bench", common_timebase=True)
        mdf.save(path, compression=compression)
    return {
        "linear": ints * 0.5 + 1,
        "big": ints.astype(float),
        "short": floats.astype("f4").astype(float),
        "marked": np.where(invalid, np.nan, floats),
        "formula": ints.astype(float) ** 2 + 1,
        "first": ints.astype(float),
        "second": floats,
    }


@pytest.mark.parametrize(
    ("version", "compression"),
    [("4.10", 0), ("4.10", 1), ("4.10", 2), ("4.30", 3), ("4.30", 4), ("4.30", 5), ("4.30", 6)],
)
def test_files_of_asammdf_are_read_as_written(
    tmp_path: Path, version: str, compression: int
) -> None:
    expected = asammdf_file(tmp_path / "a.mf4", version, compression)
    native, [(values, ticks)] = read(tmp_path / "a.mf4")
    assert list(values) == list(expected)
    for name, column in values.items():
        np.testing.assert_array_equal(column, expected[name])
    np.testing.assert_array_equal(ticks, np.arange(70_000) / 128)
    assert native.streams[0].columns[0].unit == "m"
    assert native.warnings == (
        "bench: 1 channels are text by a table",
        "bench: 1 channels are values of varying length",
        "bench: 1 channels are an array or a structure",
    )


def test_asammdf_reads_what_is_written(tmp_path: Path) -> None:
    from asammdf import MDF

    values = np.array([0.25, np.nan, 1.5])
    clock = UniformClock.of(8.0, 2.0)
    recording = Recording(
        (Channel.of("height", values, clock), Channel.of("distance", values, clock))
    )
    write_mdf4(recording, tmp_path / "a.mf4", {"distance": 0.25})
    with MDF(tmp_path / "a.mf4") as mdf:
        height, distance = mdf.get("height"), mdf.get("distance")
    np.testing.assert_array_equal(height.samples, values)
    np.testing.assert_array_equal(height.timestamps, [2.0, 2.125, 2.25])
    np.testing.assert_array_equal(distance.samples, [0.25, 1.5])
