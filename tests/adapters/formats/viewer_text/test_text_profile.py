"""Text of profile viewers: what is written is read again, feet are feet, nothing is guessed.

Law: a number is read back within 1e-12 m, or that share of it where it is above one, and no number
takes more than 15 characters.
"""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref import InputError, Profile, ProfileTrack
from floatref.engine.formats import format_of, profile_of
from floatref_adapters.formats.viewer_text.text_profile import ViewerText
from floatref_adapters.formats.viewer_text.text_rows import write_number

names = st.text(st.characters(codec="utf-8", categories=("L", "N")), min_size=1, max_size=12)
free = names.filter(lambda name: name.lower() not in ("lelev", "relev"))
elevations = st.floats(-1e5, 1e5) | st.just(float("nan"))
FEET = (
    "LElev - Distance (ft)\tLElev_Full (in)\tRElev. - Distance (ft)\tRElev._Full (in)\n"
    "10.0\t1.0\t10.0\t-2.0\n10.5\t\t10.5\t0.5\n11.0\t3.0\t\t\n"
)


@st.composite
def profiles(draw):
    count = draw(st.integers(2, 30))
    tracks = []
    for name in draw(st.lists(free, min_size=1, max_size=3, unique_by=str.lower)):
        values = np.array(draw(st.lists(elevations, min_size=count, max_size=count)))
        valid = np.array(draw(st.lists(st.booleans(), min_size=count, max_size=count)))
        tracks.append(ProfileTrack.of(name, values, valid))
    interval = draw(st.floats(1e-3, 100.0) | st.sampled_from([0.00508, 0.1 + 0.2]))
    return Profile(interval, tuple(tracks), draw(st.floats(-1e4, 1e4)))


def read(path, text):
    path.write_text(text, encoding="utf-8")
    return ViewerText().read(path)


@pytest.mark.slow
@settings(deadline=None, max_examples=60)
@given(profile=profiles())
def test_what_is_written_is_read_again(tmp_path_factory, profile):
    path = tmp_path_factory.getbasetemp() / "law.txt"
    ViewerText().write(profile, path)
    back = profile_of(path)
    last = profile.tracks[0].elevation.size - 1
    ends = profile.start_m, profile.start_m + last * profile.interval_m
    allowed_m = 1e-12 * max(1.0, *map(abs, ends))
    assert back.start_m == pytest.approx(ends[0], rel=0, abs=allowed_m)
    assert back.start_m + last * back.interval_m == pytest.approx(ends[1], rel=0, abs=2 * allowed_m)
    for found, given_track in zip(back.tracks, profile.tracks, strict=True):
        assert found.name == given_track.name
        errors = np.abs(found.elevation - given_track.elevation)
        assert not (errors > 1e-12 * np.maximum(1.0, np.abs(given_track.elevation))).any()
        np.testing.assert_array_equal(np.isnan(errors), np.isnan(given_track.elevation))
        np.testing.assert_array_equal(found.valid, given_track.valid)
    fields = [field for line in path.read_text().splitlines()[1:] for field in line.split("\t")]
    assert max(map(len, fields)) <= 15


@given(
    thousandths=st.integers(-(10**9), 10**9),
    wide=st.floats(-1e11, 1e11),
    small=st.floats(-1.0, 1.0),
)
def test_a_number_is_as_short_as_it_is_right(thousandths, wide, small):
    assert write_number(thousandths / 1000.0) == repr(thousandths / 1000.0 + 0.0)
    assert write_number(0.0254 * 1.0000000000000002) == "0.0254"
    for value in (wide, small, thousandths / 39.37):
        text = write_number(value)
        assert len(text) <= 15, text
        assert float(text) == pytest.approx(value, rel=5.01e-13, abs=5.01e-13)
    assert write_number(float("nan")) == ""


@pytest.mark.parametrize("interval_m", [0.00508, 0.1 / 3.0, np.pi / 1000.0, 1.0 / 39.37])
@pytest.mark.parametrize("start_m", [0.0, -1.0 / 3.0, 12345.678901])
def test_a_long_profile_keeps_its_interval(tmp_path, interval_m, start_m):
    """Over 40,000 points the first distances have fewer digits before the point than the last."""
    profile = Profile(interval_m, (ProfileTrack.of("left", np.zeros(40_000)),), start_m)
    ViewerText().write(profile, tmp_path / "run.txt")
    back = ViewerText().read(tmp_path / "run.txt")
    farthest = start_m + 39_999 * interval_m
    found = back.start_m + 39_999 * back.interval_m
    assert back.start_m == pytest.approx(start_m, rel=0, abs=1e-12 * farthest)
    assert found == pytest.approx(farthest, rel=0, abs=2e-12 * farthest)


def test_feet_and_inches_become_metres_and_short_channels_end_missing(tmp_path):
    profile = read(tmp_path / "run.txt", FEET)
    assert (profile.start_m, profile.interval_m) == pytest.approx((3.048, 0.1524), rel=1e-15)
    left, right = profile.track("left"), profile.track("right")
    np.testing.assert_allclose(left.elevation, [0.0254, np.nan, 0.0762], rtol=1e-15)
    np.testing.assert_allclose(right.elevation, [-0.0508, 0.0127, np.nan], rtol=1e-15)
    assert left.valid.tolist() == [True, False, True]


def test_metres_and_millimetres_and_what_is_no_elevation(tmp_path):
    text = (
        "a - Distance (m)\ta_Full (mm)\ta IRI - Distance (m)\ta IRI_Full (m/km)\n"
        "0\t1\t0\t1.5\n0.25\t2\t0.25\t1.6\n"
    )
    profile = read(tmp_path / "run.txt", text)
    assert [track.name for track in profile.tracks] == ["a"]
    np.testing.assert_allclose(profile.tracks[0].elevation, [0.001, 0.002], rtol=1e-15)
    assert profile.provenance["text"]["left_out"] == ["a IRI_Full (m/km)"]


def test_a_file_in_front_of_the_channel_is_not_its_name(tmp_path):
    text = "run 7 - Distance (ft)\tRElev_Full (in)\n0\t1\n1\t2\n"
    assert read(tmp_path / "run.txt", text).tracks[0].name == "right"


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ("LElev_Full (in)", "LElev_Full", r"LElev_Full states no unit; .* LElev_Full \(in\)"),
        ("(in)", "(V)", "no column is an elevation"),
        ("LElev - Distance (ft)", "LElev - Distance (s)", "s is no unit of length"),
        ("10.5\t\t10.5", "10.5\t\t10.75", "have other distances"),
        ("\t3.0\t", "\t3,0\t", r"row 4: LElev_Full \(in\) is '3,0'; write decimal points"),
        ("\t3.0\t", "\tx\t", "row 4: .* is 'x'; write a number"),
        ("11.0\t3.0", "\t3.0", r"row 4: LElev - Distance \(ft\) is missing"),
        ("11.0\t3.0", "10.2\t3.0", r"row 4: LElev - Distance \(ft\) does not increase"),
        ("11.0\t3.0", "12.7\t3.0", r"LElev - Distance \(ft\) is 10.5, off .* 1.35 ft; resample"),
        ("11.0\t3.0\t\t", "11.0\t3.0\t\t\t", "row 4 has 5 fields, the header 4"),
        ("\tRElev._Full (in)", "", "has no column of values"),
    ],
)
def test_what_cannot_be_used_is_one_line_with_the_place(tmp_path, old, new, words):
    assert old in FEET
    with pytest.raises(InputError, match=words) as caught:
        read(tmp_path / "run.txt", FEET.replace(old, new))
    assert str(caught.value).startswith(f"{tmp_path / 'run.txt'}: ")
    assert "\n" not in str(caught.value)


def test_only_its_own_header_is_recognised(tmp_path):
    path = tmp_path / "table"
    assert format_of(tmp_path / "run.txt").name == "text"
    for text, known in ((FEET, True), ("distance_m\ta\n", False), ("ERDFILEV2.00\n", False)):
        path.write_text(text)
        assert ViewerText().recognises(path) is known


@pytest.mark.parametrize("name", ["a\tb", "left valid", "x (in)", "x.", "=1+1", "-2", "＠a"])
def test_a_name_that_is_a_formula_or_would_come_back_as_another_is_refused(tmp_path, name):
    profile = Profile(1.0, (ProfileTrack.of(name, [0.0, 1.0]),))
    with pytest.raises(InputError, match=r"cannot hold; write a \.csv"):
        ViewerText().write(profile, tmp_path / "run.txt")


@pytest.mark.parametrize("far", [90.0, 990.0, 9_990.0, 99_990.0])
def test_distances_of_15_digits_have_one_interval_wherever_their_decimals_end(tmp_path, far):
    """As viewers write them: 99.9999991234567, then 100.000000123457."""
    interval, count = 0.082020998001, 2500
    places = far + interval * np.arange(count)
    rows = "\n".join(f"{place:.15g}\t{k % 7}" for k, place in enumerate(places))
    profile = read(tmp_path / "run.txt", f"a - Distance (ft)\ta_Full (in)\n{rows}\n")
    assert profile.interval_m == pytest.approx(0.3048 * interval, rel=1e-12)
    lost = "\n".join(row for k, row in enumerate(rows.split("\n")) if k != 1200)
    with pytest.raises(InputError, match="off the interval"):
        read(tmp_path / "run.txt", f"a - Distance (ft)\ta_Full (in)\n{lost}\n")


def test_heights_without_a_unit_are_given_as_they_are_written(tmp_path):
    path = tmp_path / "run.txt"
    path.write_text(FEET.replace("_Full (in)", "_Full").replace("._Full (in)", "_Full"), "utf-8")
    profile, along = ViewerText().read_unstated(path)
    assert along == "ft"
    np.testing.assert_array_equal(profile.track("left").elevation, [1.0, np.nan, 3.0])
    path.write_text(FEET, "utf-8")
    assert ViewerText().read_unstated(path) is None


def test_of_a_long_name_the_end_is_kept_which_a_directory_can_hold(tmp_path):
    name = f"{'Rt 76 EB run 1 ' * 5}_ODS1 (Profile 1)"
    (tmp_path / "run.txt").write_text(f"{name} - Distance (m)\t{name}_Full (m)\n0\t1\n1\t2\n")
    profile = profile_of(tmp_path / "run.txt")
    assert name.endswith(profile.tracks[0].name)
    assert profile.tracks[0].name.endswith("_ODS1 (Profile 1)")
    format_of(tmp_path / "out").write(profile, tmp_path / "out")
    assert profile_of(tmp_path / "out").tracks[0].name == profile.tracks[0].name
