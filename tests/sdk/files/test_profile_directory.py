"""What is written of a profile reads back the same; spoilt directories are named."""

import json
import re
import tempfile
from collections.abc import Callable
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref.files import read_profile, write_profile
from floatref.values.profile import Profile, ProfileTrack

Edit = Callable[[Path, Callable[[Any], Any]], None]

JSON = st.recursive(
    st.none() | st.booleans() | st.integers(-(10**15), 10**15) | st.text() | st.floats(-1e9, 1e9),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.text(), inner, max_size=3),
    max_leaves=6,
)
OBJECT = st.dictionaries(st.text(), JSON, max_size=3)


@st.composite
def profiles(draw: st.DrawFn) -> Profile:
    names = draw(st.lists(st.sampled_from(["left", "Left", "left.valid", "x y", "路"]), min_size=1,
                          unique=True))  # fmt: skip
    count = draw(st.integers(1, 6))
    column = st.lists(st.floats(allow_infinity=False), min_size=count, max_size=count)
    valid = st.none() | st.lists(st.booleans(), min_size=count, max_size=count)
    sigma = st.none() | st.lists(st.floats(0, 1), min_size=count, max_size=count)
    tracks = tuple(ProfileTrack.of(n, draw(column), draw(valid), draw(sigma)) for n in names)
    interval, start = draw(st.floats(1e-5, 1e3)), draw(st.floats(-1e9, 1e9))
    return Profile(interval, tracks, start, draw(st.text()), draw(OBJECT), draw(OBJECT))


@pytest.mark.slow
@given(profiles())
@settings(deadline=None, max_examples=40)
def test_a_profile_written_reads_back_the_same(profile: Profile) -> None:
    with tempfile.TemporaryDirectory() as parent:
        write_profile(profile, Path(parent) / "p")
        found = read_profile(Path(parent) / "p")
    for name in ("interval_m", "start_m", "pipeline", "settings", "provenance"):
        assert getattr(found, name) == getattr(profile, name)
    for ours, theirs in zip(found.tracks, profile.tracks, strict=True):
        assert ours.name == theirs.name
        np.testing.assert_array_equal(ours.elevation, theirs.elevation)
        np.testing.assert_array_equal(ours.valid, theirs.valid)
        if ours.sigma is None or theirs.sigma is None:
            assert ours.sigma is theirs.sigma
        else:
            np.testing.assert_array_equal(ours.sigma, theirs.sigma)


@pytest.fixture
def directory(tmp_path: Path) -> Path:
    sigma = np.full(4, 1e-4)
    track = ProfileTrack.of("left", np.array([0.0, 0.001, np.nan, 0.002]), sigma=sigma)
    write_profile(Profile(0.25, (track,), 3.0, "spatial-basic"), tmp_path / "p")
    return tmp_path / "p"


def test_the_files_are_those_of_the_format(directory: Path) -> None:
    document = json.loads((directory / "profile.json").read_text())
    assert document["format"] == "floatref-profile/1"
    (track,) = document["tracks"]
    assert (directory / track["valid_file"]).read_bytes() == b"\1\1\0\1"
    assert np.fromfile(directory / track["elevation_file"], "<f8")[3] == 0.002
    assert np.fromfile(directory / track["sigma_file"], "<f8").tolist() == [1e-4] * 4


def test_without_a_file_of_validity_every_point_is_valid(directory: Path, edit: Edit) -> None:
    np.zeros(4).tofile(directory / "left.f64")
    edit(directory / "profile.json", lambda d: d["tracks"][0].pop("valid_file"))
    assert read_profile(directory / "profile.json").track("left").valid.all()


def test_settings_are_written_as_plain_json_with_null_for_nan(tmp_path: Path) -> None:
    track = ProfileTrack.of("main", [0.0])
    given_settings = {"a": np.float32(0.5), "b": (1, np.nan), "c": np.arange(2), "d": {1: None}}
    write_profile(Profile(0.25, (track,), settings=given_settings), tmp_path / "p")
    document = json.loads((tmp_path / "p" / "profile.json").read_text())
    assert document["settings"] == {"a": 0.5, "b": [1, None], "c": [0, 1], "d": {"1": None}}


@pytest.mark.parametrize(
    ("changes", "text"),
    [
        ({"settings": {"a": [1.0, np.inf]}}, r"profile.settings.a\[1\] is inf; JSON holds finite"),
        ({"settings": {"a": Fraction(1, 3)}}, "profile.settings.a is a Fraction; give a number"),
        ({"pipeline": "x" * 2000}, "expected the name of the pipeline"),
        ({"tracks": (ProfileTrack.of("a/b", [0.0]),)}, r'tracks\[0\].name .* is "a/b"; expected'),
    ],
)
def test_a_profile_that_breaks_the_format_is_not_written(
    tmp_path: Path, changes: dict[str, Any], text: str
) -> None:
    values = {"interval_m": 0.25, "tracks": (ProfileTrack.of("left", [0.0]),)} | changes
    with pytest.raises(InputError, match=text):
        write_profile(Profile(**values), tmp_path / "p")
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    ("change", "text"),
    [
        (lambda d: d.update(format="floatref-recording/1"), 'expected "floatref-profile/1"'),
        (lambda d: d.pop("interval_m"), "has no interval_m"),
        (lambda d: d.update(interval_m=0), "interval_m is 0; expected the profile interval in m"),
        (lambda d: d.update(start_m="0"), 'start_m is "0"; expected the distance of the first'),
        (lambda d: d.update(settings=[]), r"settings is .*expected an object with the settings"),
        (lambda d: d.update(tracks=[]), "is a list of 0; expected a list of 1 to 64 tracks"),
        (lambda d: d["tracks"].append(d["tracks"][0]), "two tracks .* the same name"),
        (lambda d: d["tracks"][0].update(elevation_file="../x"), "elevation_file .* plain name"),
        (lambda d: d["tracks"][0].update(sigma_file="none"), "track left: .*none: No such file"),
    ],
)
def test_a_spoilt_document_is_named(
    directory: Path, edit: Edit, change: Callable[[Any], Any], text: str
) -> None:
    edit(directory / "profile.json", change)
    with pytest.raises(InputError, match=text) as caught:
        read_profile(directory)
    assert str(directory) in str(caught.value)


@pytest.mark.parametrize(
    ("name", "content", "text"),
    [
        ("left.f64", b"", "empty; copy the complete file"),
        ("left.f64", bytes(31), "31 bytes are not a whole number of float64 samples"),
        ("left.f64", bytes(24), "left.valid.u8: 4 points, but the elevation has 3"),
        ("left.f64", np.full(4, np.inf).tobytes(), "track left: infinite elevation"),
        ("left.valid.u8", b"\1\1\2\1", "left.valid.u8: byte 2 is 2; write one byte per point"),
        ("left.valid.u8", b"\1\1", "left.valid.u8: 2 points, but the elevation has 4"),
        ("left.sigma.f64", bytes(8), "left.sigma.f64: 1 points, but the elevation has 4"),
        ("left.sigma.f64", np.full(4, -1.0).tobytes(), "track left: sigma is below zero"),
    ],
)
def test_a_spoilt_sample_file_is_named(
    directory: Path, name: str, content: bytes, text: str
) -> None:
    (directory / name).write_bytes(content)
    with pytest.raises(InputError, match=re.escape(text)):
        read_profile(directory)


def test_tracks_of_different_length_are_named(directory: Path, edit: Edit) -> None:
    np.zeros(5).tofile(directory / "right.f64")
    right = {"name": "right", "elevation_file": "right.f64"}
    edit(directory / "profile.json", lambda d: d["tracks"].append(right))
    with pytest.raises(InputError, match="tracks differ in length"):
        read_profile(directory)
