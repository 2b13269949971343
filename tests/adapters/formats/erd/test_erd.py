"""ERD written by us: every number to the last written digit, and the layout docs/erd.md states."""

import re
from decimal import ROUND_HALF_EVEN, Decimal

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref import InputError, Profile, ProfileTrack
from floatref_adapters.formats.erd.erd_profile import Erd
from floatref_adapters.formats.erd.erd_writing import bridge_gaps, find_gaps

KEYWORDS = {
    "TITLE",
    "SHORTNAM",
    "LONGNAME",
    "UNITSNAM",
    "XLABEL",
    "XUNITS",
    "XSTART",
    "HISTORY",
    "&1000",
}
elevations = st.floats(-1e5, 1e5) | st.floats(-0.1, 0.1) | st.sampled_from([0.0, -0.0, 5e-8, 1e-7])
names = st.text(st.characters(codec="ascii", categories=("L", "N")), min_size=1, max_size=20)


@st.composite
def profiles(draw, missing=True):
    count = draw(st.integers(1, 30))
    tracks = []
    for name in draw(st.lists(names, min_size=1, max_size=3, unique=True)):
        values = np.array(draw(st.lists(elevations, min_size=count, max_size=count)))
        valid = np.array(draw(st.lists(st.booleans(), min_size=count, max_size=count)))
        if missing and count > 1:
            values[draw(st.integers(0, count - 1))] = np.nan
        tracks.append(ProfileTrack.of(name, values, valid))
    interval = draw(st.floats(1e-5, 1000.0) | st.sampled_from([0.00508, 0.1 + 0.2]))
    return Profile(interval, tuple(tracks), draw(st.floats(-1e9, 1e9)), draw(names))


def written(profile, path):
    path.unlink(missing_ok=True)
    Erd().write(profile, path)
    return path.read_bytes()


def lines_of(raw):
    """Return header lines and lines of numbers, by the line END alone."""
    lines = raw.decode("ascii").split("\r\n")
    assert lines.pop() == ""
    end = lines.index("END")
    return lines[:end], lines[end + 1 :]


@pytest.mark.slow
@settings(deadline=None, max_examples=150)
@given(profile=profiles())
def test_what_is_read_are_the_written_digits(tmp_path_factory, profile):
    path = tmp_path_factory.getbasetemp() / "law.erd"
    raw = written(profile, path)
    back = Erd().read(path)
    assert (back.interval_m, back.start_m) == (profile.interval_m, profile.start_m)
    assert back.pipeline == profile.pipeline
    assert [t.name for t in back.tracks] == [t.name for t in profile.tracks]
    rows = [line.split(" ") for line in lines_of(raw)[1]]
    digits = [[word for word in row if "." in word] for row in rows]
    for index, (track, given_track) in enumerate(zip(back.tracks, profile.tracks, strict=True)):
        assert [f"{z:.7f}" for z in track.elevation.tolist()] == [row[index] for row in digits]
        assert track.elevation.tolist() == [float(row[index]) for row in digits]
        np.testing.assert_array_equal(track.valid, given_track.valid)
    assert written(back, path).split(b"END")[1] == raw.split(b"END")[1]


@pytest.mark.slow
@settings(deadline=None, max_examples=150)
@given(values=st.lists(elevations, min_size=1, max_size=20))
def test_digits_are_rounded_half_to_even(tmp_path_factory, values):
    path = tmp_path_factory.getbasetemp() / "digits.erd"
    raw = written(Profile(0.1, (ProfileTrack.of("main", values),)), path)
    unit = Decimal("1e-7")
    expected = [Decimal(v).quantize(unit, ROUND_HALF_EVEN) for v in values]
    assert [Decimal(line) for line in lines_of(raw)[1]] == expected


@pytest.mark.slow
@settings(deadline=None, max_examples=100)
@given(profile=profiles())
def test_the_header_follows_the_layout_facts(tmp_path_factory, profile):
    header, numbers = lines_of(written(profile, tmp_path_factory.getbasetemp() / "layout.erd"))
    assert header[0] == "ERDFILEV2.00"
    stated = header[1].split(",")
    assert len(stated) == 8
    assert stated[7] == ""
    count = int(stated[0])
    assert int(stated[1]) == len(numbers) == profile.tracks[0].elevation.size
    assert [int(stated[k]) for k in (2, 3, 4, 6)] == [-1, 1, 5, -1]
    assert "e" not in stated[5].lower()
    assert float(stated[5]) == profile.interval_m
    assert max(map(len, header)) <= 1000
    assert {line[:8].strip() for line in header[2:]} <= KEYWORDS
    behind = {line[:8]: line[8:] for line in header[2:]}
    short, long, units = (behind[key] for key in ("SHORTNAM", "LONGNAME", "UNITSNAM"))
    assert (len(short), len(long), len(units)) == (8 * count, 32 * count, 8 * count)
    assert len({short[k : k + 8] for k in range(0, 8 * count, 8)}) == count
    assert set(units.split()) <= {"m", "-"}
    assert behind["XUNITS  "] == "m"
    assert float(behind["XSTART  "]) == profile.start_m
    for line in numbers:
        assert len(line.split(" ")) == count
        assert re.fullmatch(r"((-?\d+\.\d{7}|[01]) ?)+", line)


def test_names_of_many_tracks_go_on_in_lines_that_begin_with_an_ampersand(tmp_path):
    tracks = tuple(ProfileTrack.of(f"track {k}", [0.5, np.nan]) for k in range(20))
    header, _ = lines_of(written(Profile(0.1, tracks), tmp_path / "a.erd"))
    assert max(map(len, header)) <= 1000
    first = header.index(next(line for line in header if line.startswith("LONGNAME")))
    assert len(header[first]) == 1000
    assert header[first + 1].startswith("&1000   track 15 valid ")
    back = Erd().read(tmp_path / "a.erd")
    assert [t.name for t in back.tracks] == [t.name for t in tracks]


def test_wheel_paths_have_the_names_of_proval_and_a_validity_where_it_is_needed(tmp_path):
    left, right = ProfileTrack.of("left", [1.0, 2.0]), ProfileTrack.of("right", [1.0, np.nan])
    header, numbers = lines_of(written(Profile(0.1, (left, right)), tmp_path / "a.erd"))
    assert "SHORTNAMLElev   RElev   RValid  " in header
    assert "UNITSNAMm       m       -       " in header
    assert numbers == ["1.0000000 1.0000000 1", "2.0000000 1.0000000 0"]
    assert "HISTORY points not measured are on the line between their neighbours" in header


def test_names_that_ascii_or_the_field_cannot_hold_stay_apart(tmp_path):
    tracks = [ProfileTrack.of(name, [0.0]) for name in ("ä", "ö", "x" * 40, "x" * 41, " ")]
    Erd().write(Profile(0.1, tuple(tracks), pipeline="pì"), tmp_path / "a.erd")
    back = Erd().read(tmp_path / "a.erd")
    assert [t.name for t in back.tracks] == ["?", "?#2", "x" * 22, "x" * 20 + "#2", "track"]
    assert back.pipeline == "p?"


@pytest.mark.slow
@settings(deadline=None, max_examples=150)
@given(
    values=st.lists(st.none() | st.floats(-9, 9), min_size=1, max_size=40), cut=st.integers(1, 40)
)
def test_bridging_in_stretches_is_the_line_between_neighbours(values, cut):
    z = np.array([np.nan if v is None else v for v in values])
    known = np.flatnonzero(np.isfinite(z))
    if known.size == 0:
        return
    gaps = find_gaps(z)
    parts = [bridge_gaps(z, gaps, k, min(k + cut, z.size)) for k in range(0, z.size, cut)]
    expected = np.interp(np.arange(z.size), known, z[known])
    np.testing.assert_allclose(np.concatenate(parts), expected, rtol=0, atol=1e-13)


@pytest.mark.parametrize(
    ("values", "message"),
    [
        ([np.nan, np.nan], "track main: no elevation at any point"),
        ([0.0, 2e6], "track main: elevation is 2e\\+06 m; ERD holds up to 1e\\+06 m"),
    ],
)
def test_what_erd_cannot_say_is_refused(tmp_path, values, message):
    profile = Profile(0.1, (ProfileTrack.of("main", values),))
    with pytest.raises(InputError, match=message):
        Erd().write(profile, tmp_path / "a.erd")
