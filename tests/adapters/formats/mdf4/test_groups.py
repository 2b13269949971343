"""Groups of MDF 4: each is a stream on its own clock, its channels told apart by name."""

from fractions import Fraction
from functools import partial
from pathlib import Path

import numpy as np
import pytest

from floatref import Epoch
from floatref_adapters.formats.mdf4.adapter import Mdf4
from floatref_adapters.testing.mdf4 import MASTER, Stored, StoredGroup, write
from floatref_adapters.testing.whole_reading import read_whole

NS = (1e-9, 0.0)
read = partial(read_whole, Mdf4())


@pytest.mark.parametrize("mixed", [False, True])
def test_an_integer_master_keeps_its_ticks(tmp_path: Path, mixed: bool) -> None:
    path = tmp_path / "run.mf4"
    ticks = np.array([2**53 + 1, 2**53 + 2, 2**53 + 4])
    start_ns = 1_795_324_988_374_539_008
    groups = [
        StoredGroup("g", [Stored("t", ticks, "s", NS, MASTER), Stored("x", np.arange(3.0))]),
        StoredGroup(
            "g", [Stored("t", ticks[:2], "s", (1e-9, 0.5), MASTER), Stored("x", ticks[:2])]
        ),
    ]
    write(groups, path, start_ns, mixed=mixed)
    native, numbers = read(path)
    assert [stream.name for stream in native.streams] == ["g", "g #2"]
    assert [stream.clock.tick_s for stream in native.streams] == [Fraction(1, 10**9)] * 2
    origins = [stream.clock.origin_ns for stream in native.streams]
    assert origins == [start_ns, start_ns + 500_000_000]
    assert {stream.clock.epoch for stream in native.streams} == {Epoch.UTC}
    for (_, found), expected in zip(numbers, (ticks, ticks[:2]), strict=True):
        assert found.dtype == np.int64
        np.testing.assert_array_equal(found, expected)


def test_a_local_start_time_is_no_utc_and_is_told(tmp_path: Path) -> None:
    master = Stored("t", np.arange(3.0), "s", kind=MASTER)
    write([StoredGroup("g", [master])], tmp_path / "a.mf4", 10**18, time_flags=1)
    native, _ = read(tmp_path / "a.mf4")
    assert native.streams[0].clock.epoch is Epoch.LOCAL
    assert "local time" in native.warnings[0]


def test_a_master_of_distance_is_a_column_and_the_clock_unknown(tmp_path: Path) -> None:
    metres = Stored("s", np.arange(4.0), "m", kind=MASTER, sync=3)
    write([StoredGroup("g", [metres])], tmp_path / "a.mf4")
    native, [(values, ticks)] = read(tmp_path / "a.mf4")
    assert native.streams[0].clock.name == "unknown"
    assert ticks is None
    np.testing.assert_array_equal(values["s"], np.arange(4.0))
    assert native.warnings == ("g: no time; its clock is called unknown, give its rate in the map",)


def test_names_given_twice_are_numbered_and_noted(tmp_path: Path) -> None:
    columns = [Stored(name, np.arange(2.0) + k) for k, name in enumerate(["x", "x #2", "x", ""])]
    master = Stored("t", np.arange(2.0), "s", kind=MASTER)
    write([StoredGroup("", [master, *columns])], tmp_path / "a.mf4")
    native, [(values, _)] = read(tmp_path / "a.mf4")
    assert native.streams[0].name == "group 0"
    assert list(values) == ["x", "x #2", "x #3", ""]
    assert [values[name][0] for name in values] == [0, 1, 2, 3]
    assert "more than once" in native.streams[0].columns[2].note
