"""Times in tables of text: ticks of their last decimal, or dates."""

from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from tests.adapters.formats.csv_table.files_of_text import read

from floatref import Epoch, InputError
from floatref_adapters.testing.whole_reading import ticks_of as ticks

few = settings(deadline=None, max_examples=80)


@pytest.mark.slow
@few
@given(
    numbers=st.lists(st.integers(-(10**16), 10**17), min_size=2, max_size=20),
    decimals=st.integers(0, 9),
)
def test_times_are_ticks_of_their_last_decimal(
    tmp_path_factory: pytest.TempPathFactory, numbers: list[int], decimals: int
) -> None:
    def shown(number: int) -> str:
        digits = f"{abs(number):0{decimals + 1}d}"
        whole, part = digits[: len(digits) - decimals], digits[len(digits) - decimals :]
        # Zeros at the end are left out, as many loggers do.
        part = part.rstrip("0") if number != numbers[0] else part
        return ("-" if number < 0 else "") + whole + (f".{part}" if part else "")

    text = "time [ms],x\n" + "".join(f"{shown(n)},1.5\n" for n in numbers)
    native = read(tmp_path_factory.mktemp("csv"), text)
    clock, found = native.streams[0].clock, ticks(native)
    assert found.dtype == np.int64
    exact = [int(t) * clock.tick_s for t in found]
    assert exact == [Fraction(n, 10**decimals * 1000) for n in numbers]


@pytest.mark.slow
@few
@given(
    starts=st.lists(st.integers(-(2**63) + 1, 2**63 - 1), min_size=1, max_size=8),
    decimals=st.sampled_from([0, 3, 9]),
)
def test_ns_since_1970_keep_their_last_digit(
    tmp_path_factory: pytest.TempPathFactory, starts: list[int], decimals: int
) -> None:
    numbers = [1_764_000_000_123_456_789, 1_764_000_000_123_456_790, *starts]
    clear = [n for n in numbers if abs(n) < 2**63 - 2**11]

    def shown(number: int) -> str:
        digits = f"{abs(number):0{decimals + 1}d}"
        point = len(digits) - decimals
        return "-" * (number < 0) + digits[:point] + "." * (decimals > 0) + digits[point:]

    text = "timestamp,x\n" + "".join(f"{shown(n)},1.5\n" for n in clear)
    native = read(tmp_path_factory.mktemp("csv"), text)
    assert ticks(native).tolist() == clear
    assert native.streams[0].clock.tick_s == Fraction(1, 10**decimals)


def test_times_beyond_64_bits_are_floats(tmp_path: Path) -> None:
    assert ticks(read(tmp_path, "t,x\n1,1\n9300000000000000000,2\n")).tolist() == [1.0, 9.3e18]


def test_a_time_that_later_decimals_push_beyond_64_bits_is_refused(tmp_path: Path) -> None:
    rows = "999999999999999999,1\n" + "1,1\n" * (1 << 19) + "1.5,1\n"
    with pytest.raises(InputError, match="t is 999999999999999999; write fewer decimals"):
        ticks(read(tmp_path, "t,x\n" + rows))


def test_times_with_exponents_are_floats(tmp_path: Path) -> None:
    native = read(tmp_path, "t,x\n1e-3,1\n2.5e-3,2\n1e30,3\n")
    assert ticks(native).tolist() == [0.001, 0.0025, 1e30]


@pytest.mark.parametrize(
    ("texts", "expected"),
    [
        (["1970-01-01T00:00:01Z", "1970-01-01T00:00:01.5Z"], [10**9, 1_500_000_000]),
        (["1970-01-01 02:00:00.25+02:00", "1970-01-01 02:00:01+02:00"], [250_000_000, 10**9]),
        (["1969-12-31T23:59:59,75Z", "1970-01-02T00:00Z"], [-250_000_000, 86_400 * 10**9]),
        (["2024-05-01T12:00:00.123456789Z"] * 2, [1714564800123456789] * 2),
        (["1.5.2024 12:00:00,5Z", "01.05.2024 12:00Z"], [1714564800500000000, 1714564800 * 10**9]),
    ],
)
def test_iso_times_are_ns_utc(tmp_path: Path, texts: list[str], expected: list[int]) -> None:
    native = read(tmp_path, "Timestamp;x\n" + "".join(f"{t};1\n" for t in texts))
    assert ticks(native).tolist() == expected
    clock = native.streams[0].clock
    assert (clock.epoch, clock.tick_s) == (Epoch.UTC, Fraction(1, 10**9))
    assert native.warnings == ()


def test_a_column_of_times_that_are_not_read_is_told(tmp_path: Path) -> None:
    """Whether the month comes first here, nobody can tell."""
    native = read(tmp_path, "Time,x\n1/2/2024 10:00:00,1\n1/2/2024 10:00:01,2\n")
    assert "Time: '1/2/2024 10:00:00' is no time that is read" in native.warnings
    assert native.streams[0].clock.name == "unknown"
    with pytest.raises(InputError, match=r"row 3: Time is '31.2.2024 10:00:00'; every row needs"):
        ticks(read(tmp_path, "Time,x\n1.2.2024 10:00:00,1\n31.2.2024 10:00:00,2\n"))


def test_iso_times_without_a_zone_and_times_of_a_day(tmp_path: Path) -> None:
    native = read(tmp_path, "time,x\n1970-01-01T00:00:01,1\n1970-01-01T00:00:02,1\n")
    assert native.warnings == ("time: states no time zone; taken as UTC",)
    native = read(tmp_path, "Uhrzeit;x\n00:00:01,5;1\n10:00:02,25;1\n")
    assert ticks(native).tolist() == [1_500_000_000, 36_002_250_000_000]
    assert native.streams[0].clock.epoch is Epoch.LOCAL


@pytest.mark.parametrize(
    ("name", "unit_s"),
    [
        ("time_s", Fraction(1)),
        ("t", Fraction(1)),
        ("Time (ms)", Fraction(1, 1000)),
        ("Zeit [s]", Fraction(1)),
        ("TIMESTAMP_US", Fraction(1, 10**6)),
        ("Time stamp [ns]", Fraction(1, 10**9)),
        ("t [°C]", None),
        ("theta", None),
        ("travel_time_correction", None),
    ],
)
def test_a_column_of_time_is_known_by_its_name(
    tmp_path: Path, name: str, unit_s: Fraction | None
) -> None:
    native = read(tmp_path, f"x;{name}\n1;0\n2;1\n")
    clock = native.streams[0].clock
    if unit_s is None:
        assert (clock.name, clock.rate) == ("unknown", 1)
        assert native.warnings == ("no time column; state rate_hz in the map",)
    else:
        assert clock.tick_s == unit_s
        assert [c.name for c in native.streams[0].columns] == ["x"]


def test_the_option_time_names_the_column(tmp_path: Path) -> None:
    text = "time_s,gps_s,x\n0,5.25,1\n1,6.25,1\n"
    native = read(tmp_path, text, time="gps_s", epoch="gps")
    assert ticks(native).tolist() == [525, 625]
    assert native.streams[0].clock.epoch is Epoch.GPS
    assert [c.name for c in native.streams[0].columns] == ["time_s", "x"]
    assert read(tmp_path, text, time="none").streams[0].clock.name == "unknown"
    for option, said in ({"time": "gps"}, "no such column"), ({"epoch": "gsp"}, "epoch = 'gsp'"):
        with pytest.raises(InputError, match=said):
            read(tmp_path, text, **option)
