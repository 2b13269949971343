"""Tables of text that could be read in two ways, are damaged, or are something else."""

import csv
import io
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from tests.adapters.damage import check_damaged
from tests.adapters.formats.csv_table.files_of_text import read

import floatref
from floatref import InputError
from floatref_adapters.formats.csv_table.adapter import CsvTable
from floatref_adapters.testing.whole_reading import make_columns as columns

few = settings(deadline=None, max_examples=80)


REFUSED = {
    "": "holds no rows; copy the complete file",
    "time_s,distance\n": "no rows of numbers below the header; copy the complete file",
    "time_s,distance\n0,1,0,2\n": "write decimal points, not decimal commas",
    "time_s,distance\n0,1,0,2\n0,2,0,3\n0,3,0,4\n": "write decimal points, not decimal commas",
    'time_s,distance\n0,"0,5"\n1,"0,6"\n': "distance is '0,5'; write a decimal point, not a dec",
    "time_s,distance\n0,0\n0.1\n0.2,1\n": "row 3 has 1 fields, the header 2; the file is truncat",
    "time_s,distance\n0,0\n# pause\n1,2\n": "row 3 is a remark, '# pause'; take it",
    "time,x\n10:59:59,1\n10:60:00,2\n": "row 3: time is '10:60:00'; every row needs its time",
    "time_s,distance\n0,0\n\n0.2,1\n": "row 3 has 0 fields, the header 2; the file is truncated",
    "time_s,distance\n0,0\n0.1,fast\n": "row 3: distance is 'fast'; write a number",
    "time_s,distance\n0,fast\n0.1,1\n0.2,2\n": "row 2: distance is 'fast'; write a number",
    "time_s,distance\n0,0\n,1\n": "row 3: time_s is ''; every row needs its time",
    "time_s,distance\n0,0\n1,1_000\n": "row 3: distance is '1_000'",
    'time_s,distance\n0,0\n1,"0\n2,1\n': "row 3: '1,\"0' is no row",
    "0,186\n0,843\n": "row 1: '0,186' may be two columns, or a number with a decimal comma",
    "0,186,0,1\n0,843,0,2\n": "row 1: '0,186' may be two columns, or a number with a decimal",
    "height\n0,186\n0,843\n": "'0,186' may be two columns, or a number with a decimal comma",
    "a;b\n1,5;2\n1.5;3\n": "numbers such as '1,5' and '1.5'; write one decimal mark only",
    "a;b\n1,5;2\n2,5;3\n1.000,5;3\n": "row 4: a is '1.000,5'; write a decimal comma and no",
    "a;b\n1.5;2\n2.5;3\n1,000.5;3\n": "row 4: a is '1,000.5'; write a decimal point and no sign",
    "a,b\n1.5,2\n3,4,5\n": "row 3 has 3 fields, the header 2; write decimal points",
    b"a,b\n1,\xff\n2,3\n4,5\n": "row 2: b is 'ÿ'; write a number",
    b"a,b\n\0\0\0\0\n": "not a text file",
    f"time_s,x\n0,1\n0.{'3' * 310},2\n": "a time with 310 digits on one side of its decimal mark",
    f"time_s,x\n0,1\n{'3' * 310},2\n": "a time with 310 digits on one side of its decimal mark",
}


@pytest.mark.parametrize("text", REFUSED, ids=range(len(REFUSED)))
def test_anything_else_is_refused_in_one_line(tmp_path: Path, text: str | bytes) -> None:
    with pytest.raises(InputError) as caught:
        columns(read(tmp_path, text))
    assert REFUSED[text] in str(caught.value)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("text", "count", "warnings"),
    [
        ("time,x\n0,1.25\n1,2.25", 2, ()),
        ("time,x\n0,1.25\n1,2.2", 1, ("1 row at the end, cut short: dropped",)),
        ("time,x\n0,1.25\n1", 1, ("1 row at the end, cut short: dropped",)),
        ("time,x\n0,1.25\n1,2.25\n\n \n", 2, ()),
    ],
)
def test_a_last_line_that_was_cut_short_is_dropped(
    tmp_path: Path, text: str, count: int, warnings: tuple[str, ...]
) -> None:
    native = read(tmp_path, text)
    assert len(columns(native)["x"]) == count
    assert native.warnings == warnings


def test_a_line_without_an_end_is_refused_before_it_fills_the_memory(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="no line end in 16 MB"):
        read(tmp_path, "a,b\n1,2\n" + "1" * (18 << 20))


@pytest.mark.slow
@settings(deadline=None, max_examples=150)
@given(data=st.data())
def test_a_damaged_table_is_read_or_refused(
    tmp_path_factory: pytest.TempPathFactory,
    data: st.DataObject,
) -> None:
    whole = b"time_s;height [mm];state\r\n" + b"".join(
        b"%d,%02d;%d,5;ok\r\n" % (k // 100, k % 100, k) for k in range(40)
    )
    path = tmp_path_factory.mktemp("csv") / "run.csv"
    path.write_bytes(whole)
    check_damaged(CsvTable(), path, data)


@settings(deadline=None, max_examples=150)
@given(text=st.text('0123456789.,;|\t "-+eEnaN#\r\n[]()t', max_size=80))
def test_no_text_breaks_the_reader(tmp_path_factory: pytest.TempPathFactory, text: str) -> None:
    folder = tmp_path_factory.mktemp("csv")
    try:
        native = read(folder, text)
        found = columns(native)
    except InputError:
        return
    assert len({len(values) for values in found.values()}) <= 1


@pytest.mark.slow
@few
@given(
    rows=st.lists(
        st.lists(
            st.sampled_from(["1", "2.5", "", " ", "x", '"3"', '"4,5"', "6e1"]),
            min_size=1,
            max_size=4,
        ),
        min_size=1,
        max_size=8,
    )
)
def test_no_number_is_made_of_fields_that_hold_another(
    tmp_path_factory: pytest.TempPathFactory, rows: list[list[str]]
) -> None:
    """What comes out is what the csv module and float() make of the same fields."""
    text = "a,b,c\n9.5,9.5,9.5\n9.5,9.5,9.5\n" + "".join(",".join(row) + "\n" for row in rows)
    try:
        found = columns(read(tmp_path_factory.mktemp("csv"), text))
    except InputError:
        return
    fields = list(csv.reader(io.StringIO(text)))[1:]
    while not "".join(fields[-1]).strip():
        fields.pop()
    for k, name in enumerate("abc"):
        if name in found:
            np.testing.assert_array_equal(
                found[name], [float(row[k]) if row[k].strip() else np.nan for row in fields]
            )


def test_a_quote_over_lines_that_leaves_an_empty_one_is_no_fault(tmp_path: Path) -> None:
    # Every line of a table's width ends in a delimiter here, so a line of "" alone has no field.
    text = '"",""\n"1",2,""\n"3",4,""\n5,6,\n""\n'
    with pytest.raises(InputError) as refusal:
        columns(read(tmp_path, text))
    assert "\n" not in str(refusal.value)


def test_a_last_line_below_spaces_alone_is_not_cut_short(tmp_path: Path) -> None:
    with pytest.raises(InputError):
        columns(read(tmp_path, ' \n\n"0" a'))


def test_spaces_beyond_ascii_around_a_time_are_spaces(tmp_path: Path) -> None:
    # 0x85 is a line end in Latin-1, which counts as a space.
    content = b"a,b\n0,2\n" + 15 * b"\x85" + b"3,4\n"
    (stream,) = read(tmp_path, content, time="a").streams
    ticks = [rows.ticks for rows in stream.read(["b"])]
    assert [t.tolist() for t in ticks if t is not None] == [[0, 3]]


@pytest.mark.parametrize("delimiter", [",", ";", "\t", "|"])
def test_rows_of_nothing_at_the_end_are_left_out(tmp_path: Path, delimiter: str) -> None:
    """As spreadsheets leave them; above another row such a row has no time."""
    rows = ["time_s,a,b", "0,1,2", "1,,", ",,", " ,,", "", ",,"]
    lines = [row.replace(",", delimiter) for row in rows]
    for end in ("\n", ""):
        native = read(tmp_path, "\n".join(lines) + end)
        assert (native.streams[0].count, native.warnings) == (2, ())
        np.testing.assert_array_equal(columns(native)["b"], [2, np.nan])
    with pytest.raises(InputError, match="row 4: time_s is ''; every row needs its time"):
        columns(read(tmp_path, "\n".join([*lines[:4], lines[1]])))


def test_what_other_adapters_read_is_not_taken_for_a_table(tmp_path: Path) -> None:
    others = {
        "a.txt": "$GPGGA,123519,4807.038,N,01131.000,E,1,08,0.9,545.4,M,46.9,M,,*47\n" * 3,
        "b.csv": "#BESTPOSA,COM1,0,83.5,FINESTEERING,2000,1.0;SOL_COMPUTED,1,2*00000000\n" * 3,
        "c.txt": "ERDFILEV2.00\n2, 100, 50, 1, 5, 0.1\n1,2\n3,4\n",
        "d.txt": "date Tue May 1 12:00:00 2024\nbase hex timestamps absolute\n0.1 1 2 3\n",
        "e.txt": '{"a": [1, 2]}\n',
        "f.txt": "Permission is hereby granted, free of charge, to any person\n" * 4,
        "g.dat": "a,b\n1,2\n",
        "i.txt": "LElev - Distance (ft)\tLElev_Full (in)\n0\t1\n0.1\t2\n",
        "h.csv": "\0\1\2\3",
    }
    for name, text in others.items():
        (tmp_path / name).write_text(text)
        assert not CsvTable().recognises(tmp_path / name), name
    profile = floatref.Profile(0.05, (floatref.ProfileTrack.of("main", np.zeros(5)),))
    floatref.write_profile_csv(profile, tmp_path / "profile.csv")
    assert not CsvTable().recognises(tmp_path / "profile.csv")


def test_a_table_that_begins_with_a_distance_of_another_thing_is_recognised(tmp_path: Path) -> None:
    (tmp_path / "a.txt").write_text("wheel - distance (m)\ttime_s\theight\n0\t0\t1\n1\t1\t2\n")
    assert CsvTable().recognises(tmp_path / "a.txt")


@pytest.mark.parametrize("name", ["run.csv", "RUN.CSV", "run.tsv", "run.txt"])
def test_a_table_is_recognised(tmp_path: Path, name: str) -> None:
    (tmp_path / name).write_text("time_s\theight\n0\t1\n1\t2\n")
    assert CsvTable().recognises(tmp_path / name)


def test_a_folder_and_a_missing_file_are_refused(tmp_path: Path) -> None:
    for path in (tmp_path, tmp_path / "none.csv"):
        assert not CsvTable().recognises(path)
        with pytest.raises(InputError, match="not a file"):
            CsvTable().streams(path, {})
