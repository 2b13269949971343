"""Channels of TDMS that hold the time."""

import struct
from fractions import Fraction
from functools import partial
from pathlib import Path

import numpy as np
import pytest

from floatref import Epoch
from floatref_adapters.formats.tdms.adapter import Tdms
from floatref_adapters.testing.tdms import (
    DOUBLE,
    META,
    NEW,
    RAW,
    STAMP,
    UNIX_S,
    Properties,
    describe_channel,
    segment,
)
from floatref_adapters.testing.whole_reading import read_whole

read = partial(read_whole, Tdms())


def test_time_stamps_are_whole_ns(tmp_path: Path) -> None:
    ns = np.array([1_700_000_000_123_456_789, 1_700_000_001_999_999_999])
    seconds, rest = ns // 10**9 + UNIX_S, ns % 10**9
    raw = b"".join(
        struct.pack("<Qq", (int(r) << 64) // 10**9, int(s))
        for s, r in zip(seconds, rest, strict=True)
    )
    channels = describe_channel("when", STAMP, 2, {}) + describe_channel("x", DOUBLE, 2, {})
    metadata = struct.pack("<I", 2) + channels
    path = tmp_path / "a.tdms"
    path.write_bytes(segment(META | NEW | RAW, metadata, raw + np.arange(2.0).tobytes()))
    native, [(values, ticks)] = read(path)
    stream = native.streams[0]
    assert [column.name for column in stream.columns] == ["x"]
    assert (stream.clock.tick_s, stream.clock.epoch) == (Fraction(1, 10**9), Epoch.UTC)
    assert ticks.dtype == np.int64
    np.testing.assert_array_equal(ticks, ns)
    np.testing.assert_array_equal(values["x"], [0, 1])


@pytest.mark.parametrize(
    ("name", "unit", "tick_s"),
    [
        ("time", "s", Fraction(1)),
        ("Timestamp", "ms", Fraction(1, 1000)),
        ("time_us", "", Fraction(1, 10**6)),
        ("t", "", Fraction(1)),
        ("Zeit", "s", Fraction(1)),
        ("Time [ms]", "", Fraction(1, 1000)),
        ("Temp", "s", None),
        ("time", "m", None),
    ],
)
def test_a_column_that_is_called_so_and_has_a_unit_of_time_is_the_clock(
    tmp_path: Path, name: str, unit: str, tick_s: Fraction | None
) -> None:
    unit_of: Properties = {"unit_string": unit} if unit else {}
    channels = describe_channel("x", DOUBLE, 2, {}) + describe_channel(name, DOUBLE, 2, unit_of)
    raw = np.array([5.0, 6.0, 0.5, 1.5]).tobytes()
    path = tmp_path / "a.tdms"
    path.write_bytes(segment(META | NEW | RAW, struct.pack("<I", 2) + channels, raw))
    native, [(values, ticks)] = read(path)
    clock = native.streams[0].clock
    if tick_s is None:
        assert (clock.name, clock.rate, ticks) == ("unknown", 1, None)
        assert "give its rate in the map" in native.warnings[0]
        np.testing.assert_array_equal(values[name], [0.5, 1.5])
    else:
        assert (clock.name, clock.rate, clock.tick_s) == ("", None, tick_s)
        np.testing.assert_array_equal(ticks, [0.5, 1.5])
        assert list(values) == ["x"]
