"""Tables of text: what is written is read, what could be read in two ways is refused."""

from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref import Epoch, InputError, NativeFile
from floatref_adapters.csv_table.adapter import CsvTable

samples = st.none() | st.floats(-1e6, 1e6) | st.floats(-1e-6, 1e-6)


few = settings(deadline=None, max_examples=80)


MISSING = ("", "nan", "NaN", "NA", "-", "n/a", "#DIV/0!", "#NUM!")


def read(folder: Path, text: str | bytes, name: str = "run.csv", **options: str) -> NativeFile:
    """Return what the adapter finds in a file that holds ``text``."""
    path = folder / name
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    return CsvTable().streams(path, options)


def columns(native: NativeFile) -> dict[str, list[float]]:
    """Return the samples of every column of numbers, by its name."""
    (stream,) = native.streams
    names = [column.name for column in stream.columns if column.numeric]
    pieces = list(stream.read(names))
    found = {n: np.concatenate([p.values[n] for p in pieces]).tolist() for n in names}
    assert all(len(values) == stream.count for values in found.values())
    return found


def ticks(native: NativeFile) -> np.ndarray:
    """Return the ticks of every row."""
    return np.concatenate([rows.ticks for rows in native.streams[0].read([])])


@few
@given(
    rows=st.lists(st.tuples(samples, samples, samples), min_size=2, max_size=12),
    delimiter=st.sampled_from([",", ";", "\t", "|", " ", "   "]),
    comma=st.booleans(),
    ending=st.sampled_from(["\n", "\r\n", "\r"]),
    encoding=st.sampled_from(["utf-8", "utf-8-sig", "utf-16", "latin-1"]),
    quoted=st.booleans(),
    above=st.integers(0, 3),
    missing=st.sampled_from(MISSING),
)
def test_every_sample_comes_back_whatever_the_writing(
    tmp_path_factory: pytest.TempPathFactory,
    rows: list[tuple[float | None, ...]],
    delimiter: str,
    comma: bool,
    ending: str,
    encoding: str,
    quoted: bool,
    above: int,
    missing: str,
) -> None:
    mark = "," if comma and delimiter != "," else "."
    missing = missing if delimiter.strip() else "NaN"

    def field(value: float | None) -> str:
        text = missing if value is None else repr(value).replace(".", mark)
        return f'"{text}"' if quoted else text

    lines = [f"# made by a logger {k}" for k in range(above)]
    lines.append(delimiter.join(["time_s", "a", "µ°b", "c"]))
    for k, row in enumerate(rows):
        time = f"{k / 8:.4f}".replace(".", mark)
        lines.append(delimiter.join([time, *map(field, row)]))
    text = "".join(line + ending for line in lines)
    native = read(tmp_path_factory.mktemp("csv"), text.encode(encoding))
    expected = [[np.nan if x is None else x for x in values] for values in zip(*rows, strict=True)]
    found = columns(native)
    assert list(found) == ["a", "µ°b", "c"]
    for values, wanted in zip(found.values(), expected, strict=True):
        np.testing.assert_array_equal(values, wanted)
    np.testing.assert_array_equal(ticks(native), 1250 * np.arange(len(rows)))
    assert native.streams[0].clock.tick_s == Fraction(1, 10_000)
    assert native.told == ((f"{above} lines above the table: skipped",) if above else ())


@few
@given(
    values=st.lists(st.floats(allow_nan=False, allow_infinity=False), min_size=2, max_size=40),
    shape=st.sampled_from(["{!r}", "{:.17e}", "{:.3f}", "{:+.6g}", " {!r} "]),
)
def test_numbers_are_read_as_python_reads_them(
    tmp_path_factory: pytest.TempPathFactory, values: list[float], shape: str
) -> None:
    texts = [shape.format(value) for value in values]
    text = "a,b\n" + "".join(f"{t},1\n" for t in texts)
    native = read(tmp_path_factory.mktemp("csv"), text)
    assert columns(native)["a"] == [float(t) for t in texts]


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
    assert native.told == ()


def test_a_column_of_times_that_are_not_read_is_told(tmp_path: Path) -> None:
    """Whether the month comes first here, nobody can tell."""
    native = read(tmp_path, "Time,x\n1/2/2024 10:00:00,1\n1/2/2024 10:00:01,2\n")
    assert "Time: '1/2/2024 10:00:00' is no time that is read" in native.told
    assert native.streams[0].clock.name == "unknown"
    with pytest.raises(InputError, match=r"row 3: Time is '31.2.2024 10:00:00'; every row needs"):
        ticks(read(tmp_path, "Time,x\n1.2.2024 10:00:00,1\n31.2.2024 10:00:00,2\n"))


def test_iso_times_without_a_zone_and_times_of_a_day(tmp_path: Path) -> None:
    native = read(tmp_path, "time,x\n1970-01-01T00:00:01,1\n1970-01-01T00:00:02,1\n")
    assert native.told == ("time: states no time zone; taken as UTC",)
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
        assert native.told == ("no time column; state rate_hz in the map",)
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


def test_units_are_in_brackets_or_in_a_row_of_their_own(tmp_path: Path) -> None:
    native = read(
        tmp_path, "time_s,height [mm],force (m/s²),height (left),left.height\n0,1,2,3,4\n"
    )
    named = [(c.name, c.unit) for c in native.streams[0].columns]
    assert named == [
        ("height", "mm"),
        ("force", "m/s²"),
        ("height (left)", ""),
        ("left.height", ""),
    ]
    native = read(tmp_path, "Time\tAz\tLaser\n[s]\t[g]\tmm\n0.5\t1\t300\n1.0\t1\t301\n")
    assert [(c.name, c.unit) for c in native.streams[0].columns] == [("Az", "g"), ("Laser", "mm")]
    assert ticks(native).tolist() == [5, 10]


def test_quoted_names_go_over_lines_and_stray_quotes_do_not(tmp_path: Path) -> None:
    native = read(tmp_path, '"time\n[s]",x,"height,\r\nleft (mm)"\n0,1,2\n1,2,3\n')
    assert [(c.name, c.unit) for c in native.streams[0].columns] == [
        ("x", ""),
        ("height, left", "mm"),
    ]
    assert columns(native)["x"] == [1, 2]
    above = 'run 5\n2" tape\nby hand\n'
    native = read(tmp_path, above + "time_s,x,y\n" + "0,1,2\n" * 9)
    assert [c.name for c in native.streams[0].columns] == ["x", "y"]
    assert columns(native)["x"] == [1] * 9
    assert native.told == ("3 lines above the table: skipped",)


@pytest.mark.parametrize("count", [300, 6000])
def test_tables_of_many_columns_have_long_lines(tmp_path: Path, count: int) -> None:
    names = [f"acceleration {k} [m/s²]" for k in range(count)]
    rows = (",".join([str(k), *["1.5"] * count]) for k in range(3))
    native = read(tmp_path, "\n".join([",".join(["time_s", *names]), *rows]))
    assert native.streams[0].count == 3
    assert native.streams[0].columns[-1].name == f"acceleration {count - 1}"
    assert ticks(native).tolist() == [0, 1, 2]


def test_repeated_and_missing_names_are_told_apart(tmp_path: Path) -> None:
    native = read(tmp_path, "time,a,a,,a #2\n0,1,2,3,4\n1,1,2,3,4\n")
    found = native.streams[0].columns
    assert [c.name for c in found] == ["a", "a #3", "column 4", "a #2"]
    assert found[1].note == "another column a"


def test_columns_of_text_are_listed_and_not_read(tmp_path: Path) -> None:
    native = read(tmp_path, "time,state,x,lost\n0,ok,1,\n1,bad,2,\n")
    assert [(c.name, c.numeric) for c in native.streams[0].columns] == [
        ("state", False), ("x", True), ("lost", True)
    ]  # fmt: skip
    np.testing.assert_array_equal(columns(native)["x"], [1, 2])
    assert native.told == ("1 columns of text: not read",)


def test_tables_without_a_header_or_with_delimiters_at_the_end(tmp_path: Path) -> None:
    assert columns(read(tmp_path, "1.0 2.5\n3.0   4.5\n  5.0 6.5 \n")) == {
        "column 1": [1, 3, 5], "column 2": [2.5, 4.5, 6.5]
    }  # fmt: skip
    assert columns(read(tmp_path, "a;b;\n1;2;\n3;4;\n")) == {"a": [1, 3], "b": [2, 4]}
    assert columns(read(tmp_path, "1,2\n3,4\n", delimiter="comma")) == {
        "column 1": [1, 3], "column 2": [2, 4]
    }  # fmt: skip


@pytest.mark.parametrize("size", [1 << 16, (1 << 16) + 1, 1 << 20])
def test_rows_over_the_edges_of_blocks_are_whole(tmp_path: Path, size: int) -> None:
    rng = np.random.default_rng(size)
    wanted = rng.normal(size=(60_000, 2))
    rows = "".join(f"{k / 1000:.3f},{a!r},{b!r}\r\n" for k, (a, b) in enumerate(wanted.tolist()))
    head = "time,a,b\r\n"
    pad = "# " + "x" * (size - len(head) - 5 - rows.find("\n")) + "\r\n"
    native = read(tmp_path, pad[: 1 << 15].rstrip() + "\r\n" + head + rows)
    found = columns(native)
    np.testing.assert_array_equal(np.column_stack([found["a"], found["b"]]), wanted)
    np.testing.assert_array_equal(ticks(native), np.arange(60_000))
