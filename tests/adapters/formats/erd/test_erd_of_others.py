"""ERD files of other programs: their units, names, line ends and numbers, and what is wrong."""

import numpy as np
import pytest

from floatref import InputError
from floatref_adapters.formats.erd.erd_profile import Erd

FOOT = 0.3048


def erd(
    *numbers,
    second="2, 3, -1, 1, 5, 0.5, -1,",
    short="LElev.  RElev.  ",
    units="in      in      ",
    x="ft",
    more=(),
):
    """Return the text of a file; None leaves a line out."""
    named = {"SHORTNAM": short, "UNITSNAM": units, "XUNITS  ": x}
    lines = ["ERDFILEV2.00", second]
    lines += [f"{keyword}{text}" for keyword, text in named.items() if text is not None]
    return "\n".join([*lines, *more, "END", *numbers, ""])


ROWS = ("1 2", "3 4", "5 6")


def read(tmp_path, text, name="a.erd"):
    path = tmp_path / name
    path.write_bytes(text if isinstance(text, bytes) else text.encode("latin-1"))
    assert Erd().recognises(path)
    return Erd().read(path)


@pytest.mark.parametrize("end", ["\n", "\r\n", "\r"])
@pytest.mark.parametrize("mark", ["", "\xef\xbb\xbf"])
@pytest.mark.parametrize("last", ["", "\x1a"])
def test_feet_and_inches_of_any_line_end(tmp_path, end, mark, last):
    profile = read(tmp_path, mark + erd(*ROWS, more=["XSTART  100"]).replace("\n", end) + last)
    assert profile.interval_m == 0.1524
    assert profile.start_m == pytest.approx(100 * FOOT, rel=1e-15)
    assert [t.name for t in profile.tracks] == ["left", "right"]
    np.testing.assert_allclose(profile.track("left").elevation, [0.0254, 0.0762, 0.127], rtol=1e-15)
    assert all(track.valid.all() for track in profile.tracks)


@pytest.mark.parametrize(
    ("unit", "metres"),
    [
        ("m", 1.0),
        ("mm", 1e-3),
        ("MM", 1e-3),
        ("cm", 1e-2),
        ("in", 0.0254),
        ("inches", 0.0254),
        ("mils", 2.54e-5),
        ("ft", FOOT),
        ("Feet", FOOT),
    ],
)
def test_units_of_elevation(tmp_path, unit, metres):
    profile = read(tmp_path, erd(*ROWS, units=f"{unit:8}{unit:8}"))
    np.testing.assert_allclose(profile.track("right").elevation, np.array([2, 4, 6]) * metres)


@pytest.mark.parametrize(
    ("unit", "metres"), [("m", 1.0), ("km", 1e3), ("mi", 1609.344), ("mm", 1e-3), ("in.", 0.0254)]
)
def test_units_of_the_step(tmp_path, unit, metres):
    second = "2, 3, -1, 1, 5, 0.0625, -1,"
    profile = read(tmp_path, erd(*ROWS, second=second, x=unit))
    assert profile.interval_m == pytest.approx(0.0625 * metres, rel=1e-15)


@pytest.mark.parametrize(
    "numbers",
    [
        ("1 2 3", "4 5 6"),
        ("1 2 3 4 5 6",),
        ("1, 2", "3, 4", "5, 6"),
        ("1,2", "3,4", "5,6"),
        ("1,2,", "3,4,", "5,6,"),
        ("", " 1.0E0\t+2.", "3.D0 4.0d+00", "5e0 6"),
    ],
)
def test_numbers_stand_as_they_like(tmp_path, numbers):
    profile = read(tmp_path, erd(*numbers, units="m       m"))
    assert profile.track("left").elevation.tolist() == [1, 3, 5]
    assert profile.track("right").elevation.tolist() == [2, 4, 6]


def test_a_missing_number_that_is_spelled_out_is_a_missing_point(tmp_path):
    profile = read(tmp_path, erd("1 2", "NaN 4", "5 6", units="m m"))
    np.testing.assert_array_equal(profile.track("left").valid, [True, False, True])


@pytest.mark.parametrize("second", ["2 3 -1 1 5 0.5", "2, -1, -1, 1, 5, .5", "  2,3,-1,1,5,5.D-1,"])
def test_the_second_line_as_others_write_it(tmp_path, second):
    assert read(tmp_path, erd(*ROWS, second=second)).interval_m == 0.1524


def test_channels_that_are_no_elevation_are_left_out_and_named(tmp_path):
    text = erd(
        "0 1 10 7",
        "1 2 20 7",
        second="4, 2, -1, 1, 5, 0.5, -1,",
        short="Dist.   LWP     Speed   Temp",
        units="ft      mm      mi/h    ",
        more=[
            "TITLE   Loop 1",
            "HISTORY of a vendor",
            "DATE    11/Apr/1997",
            " Section No:  3",
            "",
        ],
    )
    text = text.replace("SHORTNAM", "LONGNAME" + f"{'Distance':32}{'Left wheel path':32}\nSHORTNAM")
    profile = read(tmp_path, text)
    assert [t.name for t in profile.tracks] == ["LWP"]
    assert profile.provenance["erd"] == {
        "title": "Loop 1",
        "history": ["of a vendor"],
        "left_out": ["Dist.", "Speed", "Temp"],
    }


@pytest.mark.parametrize(
    ("short", "names"),
    [
        (None, ["channel 1", "channel 2"]),
        ("A       A       ", ["A", "A #2"]),
        ("LELEV   A #2", ["left"]),
    ],
)
def test_every_track_has_a_name_of_its_own(tmp_path, short, names):
    assert [t.name for t in read(tmp_path, erd(*ROWS, short=short)).tracks] == names


def test_names_and_units_go_on_behind_an_ampersand(tmp_path):
    text = erd(*ROWS, short="LElev\n&1000   RElev", units="mm      \n&1000   mm")
    assert [t.name for t in read(tmp_path, text).tracks] == ["left", "right"]


def reals(tmp_path, values, bytes_per_sample=8, name="a.bin", order="<f4"):
    np.asarray(values, order).tofile(tmp_path / name)
    return erd(second=f"2, -1, -1, {bytes_per_sample}, 1, 0.5", units="m m")


@pytest.mark.parametrize("name", ["a.bin", "a.BIN", "a.erd.bin"])
def test_reals_of_four_bytes_beside_the_header(tmp_path, name):
    profile = read(tmp_path, reals(tmp_path, [1, 2, 3, 4.5], name=name))
    assert profile.track("right").elevation.tolist() == [2, 4.5]


@pytest.mark.parametrize(
    ("values", "changes", "message"),
    [
        ([1, 2, 3], {}, r"a\.bin has 12 bytes, no multiple of 8; it is cut short"),
        ([1, 2], {"bytes_per_sample": 4}, "NBYTES is 4, but 2 reals of 4 bytes take 8"),
        ([1, 2], {"name": "b.bin"}, r"numbers are in a\.bin, which is missing"),
        ([1, 2], {"order": ">f4"}, "is it in another byte order"),
        ([1, np.inf], {}, "no elevations"),
        ([], {}, "no numbers below END"),
    ],
)
def test_reals_that_cannot_be(tmp_path, values, changes, message):
    with np.errstate(over="ignore"):
        values = np.array(values, "f8") * (1e-3 if "order" in changes else 1)
    with pytest.raises(InputError, match=message):
        read(tmp_path, reals(tmp_path, values, **changes))


BAD = {
    "3 samples, but there are 2": erd("1 2", "3 4"),
    "3 samples, but there are 4": erd("1 2", "3 4", "5 6", "7 8"),
    "last sample has 1 of 2 numbers": erd("1 2", "3 4", "5"),
    "no numbers below END": erd(),
    r"'\*\*\*\*' is no number; export": erd("1 2", "3 ****", "5 6"),
    "'1.2-3.4' is no number": erd("1 2", "3 1.2-3.4", "5 6"),
    "'1_0' is no number": erd("1 2", "3 1_0", "5 6"),
    "'infinity' is no number": erd("1 2", "3 infinity", "5 6"),
    "'1e999' is more than float64": erd("1 2", "3 1e999", "5 6"),
    "write decimal points, not decimal commas": erd("1,5 2,5", "3 4", "5 6"),
    "missing between two commas": erd("1,,2", "3,4", "5,6"),
    "XUNITS is 's'; a profile needs the unit of its step": erd(*ROWS, x="s"),
    "no line XUNITS; a profile needs": erd(*ROWS, x=None),
    r"no channel is an elevation .*: A \(deg\), B \(no unit\)": erd(
        *ROWS, short="A       B", units="deg"
    ),
    r"channel LElev\. has unit V; write m, mm, in or ft": erd(*ROWS, units="V       in"),
    r"channel LElev\. has no unit; write": erd(*ROWS, units=None),
    "NCHAN is 0; a profile has 1 to": erd(*ROWS, second="0, 3, -1, 1, 5, 0.5,"),
    "NCHAN is 99999999;": erd(*ROWS, second="99999999, 3, -1, 1, 5, 0.5,"),
    "NCHAN is 'two'": erd(*ROWS, second="two, 3, -1, 1, 5, 0.5,"),
    "NSAMP is '9{40}'": erd(*ROWS, second=f"2, {'9' * 5000}, -1, 1, 5, 0.5,"),
    "999999999999999999 samples, but there are 3": erd(
        *ROWS, second=f"2, {'9' * 18}, -1, 1, 5, 0.5,"
    ),
    "KEYNUM is 0; 5": erd(*ROWS, second="2, 3, -1, 4, 0, 0.5,"),
    "second line has 4 numbers": erd(*ROWS, second="2, 3, -1, 1"),
    "STEP is '1/2'": erd(*ROWS, second="2, 3, -1, 1, 5, 1/2,"),
    "STEP is 'nan'": erd(*ROWS, second="2, 3, -1, 1, 5, nan"),
    "interval_m is 0;": erd(*ROWS, second="2, 3, -1, 1, 5, 0, -1"),
    "interval_m is -0.1524;": erd(*ROWS, second="2, 3, -1, 1, 5, -0.5, -1"),
    "start_m is inf;": erd(*ROWS, more=["XSTART  1e999"]),
    "XSTART is 'here'": erd(*ROWS, more=["XSTART  here"]),
    "format is floatref-erd/2; this version reads": erd(*ROWS, more=["HISTORY floatref-erd/2, x"]),
    "no channel has a long name that ends with elevation": erd(
        *ROWS, more=["HISTORY floatref-erd/1, x"]
    ),
    "no line END after the header; the file is truncated": "ERDFILEV2.00\n2, 3, -1, 1, 5, 0.5\n",
    "no line END in the first 1 MiB": "ERDFILEV2.00\n" + "x" * (1 << 20) + "\nEND\n",
    "second line, with the number": "ERDFILEV2.00\nEND\n",
    "begins with 'ERDFILEV3.00": "ERDFILEV3.00\n1, 1, -1, 1, 5, 1\nEND\n0\n",
    "no number; give numbers as text": erd("1" * 3_000_000),
}


@pytest.mark.parametrize("message", BAD)
def test_one_clear_line_for_what_is_wrong(tmp_path, message):
    with pytest.raises(InputError, match=message) as caught:
        read(tmp_path, BAD[message])
    text = str(caught.value)
    assert text.startswith(str(tmp_path / "a.erd: "))
    assert "\n" not in text
    assert len(text) < 300


def test_a_validity_that_is_neither_is_refused(tmp_path):
    long = f"LONGNAME{'left elevation':32}{'left valid':32}"
    text = erd("1 0", "2 1", "3 2", units="m -", more=[long, "HISTORY floatref-erd/1, by hand"])
    with pytest.raises(InputError, match="validity of track left is 2; it must be 0 or 1"):
        read(tmp_path, text)
    assert read(tmp_path, text.replace("3 2", "3 1")).track("left").valid.tolist() == [0, 1, 1]


def test_what_is_no_file_is_refused(tmp_path):
    for path in (tmp_path, tmp_path / "gone.erd"):
        assert not Erd().recognises(path)
        with pytest.raises(InputError, match="not a file"):
            Erd().read(path)


@pytest.mark.parametrize("value", ["3e9", "-3e9", "1e30"])
def test_an_elevation_that_no_road_has_is_refused(tmp_path, value):
    with pytest.raises(InputError, match=r"a\.erd: track left: an elevation of .* m; a road has"):
        read(tmp_path, erd("1 2", f"{value} 4", "5 6"))
