"""Headers of tables of text: names, units, and columns that are no numbers."""

from pathlib import Path

import numpy as np
import pytest
from tests.adapters.formats.csv_table.files_of_text import read

from floatref_adapters.testing.whole_reading import make_columns as columns
from floatref_adapters.testing.whole_reading import ticks_of as ticks


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
    assert native.warnings == ("3 lines above the table: skipped",)


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
    assert native.warnings == ("1 columns of text: not read",)


def test_tables_without_a_header_or_with_delimiters_at_the_end(tmp_path: Path) -> None:
    assert columns(read(tmp_path, "1.0 2.5\n3.0   4.5\n  5.0 6.5 \n")) == {
        "column 1": [1, 3, 5], "column 2": [2.5, 4.5, 6.5]
    }  # fmt: skip
    assert columns(read(tmp_path, "a;b;\n1;2;\n3;4;\n")) == {"a": [1, 3], "b": [2, 4]}
    assert columns(read(tmp_path, "1,2\n3,4\n", delimiter="comma")) == {
        "column 1": [1, 3], "column 2": [2, 4]
    }  # fmt: skip
