"""Profiles as Parquet: read back as they were written, and refused in a line."""

import json
import re
import sys

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref import InputError, Profile, ProfileTrack
from floatref_adapters.formats.arrow import parquet_profile
from floatref_adapters.formats.arrow.parquet_profile import ParquetProfile

pa = pytest.importorskip(
    "pyarrow", reason="pyarrow writes Parquet; it comes with floatref[adapters]"
)
pq = pytest.importorskip(
    "pyarrow.parquet", reason="pyarrow writes Parquet; it comes with floatref[adapters]"
)

NAMES = st.text(max_size=6) | st.sampled_from(["a.b", "a", "a_valid", "distance_m", "."])
numbers = st.floats(allow_infinity=False, width=64)


@st.composite
def profiles(draw):
    count = draw(st.integers(1, 20))
    tracks = []
    for name in draw(st.lists(NAMES, min_size=1, max_size=3, unique=True)):
        z, sigma = (draw(st.lists(numbers, min_size=count, max_size=count)) for _ in range(2))
        valid = draw(st.lists(st.booleans(), min_size=count, max_size=count))
        known = draw(st.booleans())
        tracks.append(ProfileTrack.of(name, z, valid, np.abs(sigma) if known else None))
    chosen = {"cutoff": draw(numbers | st.none()), "names": ["a", 1], "deep": {"b": True}}
    return Profile(
        draw(st.floats(1e-5, 1000.0)),
        tuple(tracks),
        draw(st.floats(-1e10, 1e10)),
        draw(st.text(max_size=5)),
        chosen,
        {"sha256": {"x": "00"}},
    )


def same(found, expected):
    """Assert that two profiles are the same, NaN in settings as null."""
    for name in ("interval_m", "start_m", "pipeline", "provenance"):
        assert getattr(found, name) == getattr(expected, name)
    cutoff = expected.settings["cutoff"]
    null = cutoff is not None and np.isnan(cutoff)
    assert found.settings == {**expected.settings, "cutoff": None if null else cutoff}
    assert [t.name for t in found.tracks] == [t.name for t in expected.tracks]
    for one, other in zip(found.tracks, expected.tracks, strict=True):
        np.testing.assert_array_equal(one.elevation, other.elevation)
        np.testing.assert_array_equal(one.valid, other.valid)
        assert (one.sigma is None) == (other.sigma is None)
        if one.sigma is not None:
            np.testing.assert_array_equal(one.sigma, other.sigma)


@pytest.mark.slow
@settings(deadline=None, max_examples=120)
@given(profile=profiles(), rows=st.integers(1, 8))
def test_what_is_read_is_what_was_written(tmp_path_factory, profile, rows):
    path = tmp_path_factory.getbasetemp() / "law.parquet"
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(parquet_profile, "ROWS", rows)
        ParquetProfile().write(profile, path)
        assert ParquetProfile().recognises(path)
        same(ParquetProfile().read(path), profile)


@pytest.fixture
def profile():
    z = np.linspace(0.0, 0.01, 300_000)
    z[7] = np.nan
    left = ProfileTrack.of("left", z, np.arange(z.size) > 3, np.full(z.size, 1e-4))
    return Profile(0.00508, (left,), 12.5, "temporal-basic", {"cutoff": 1.0}, {"version": "0.1"})


def test_other_readers_find_columns_and_metadata(tmp_path, profile):
    path = tmp_path / "a.parquet"
    ParquetProfile().write(profile, path)
    table = pq.read_table(path)
    assert table.column_names == ["distance_m", "left_elevation_m", "left_valid", "left_sigma_m"]
    assert table["left_elevation_m"].null_count == 1
    assert table["distance_m"][2].as_py() == 12.5 + 2 * 0.00508
    assert table["left_valid"].to_pylist()[:9] == [False] * 4 + [True] * 3 + [False, True]
    metadata = {key.decode(): value.decode() for key, value in table.schema.metadata.items()}
    assert metadata["format"] == "floatref-profile/1"
    assert (metadata["interval_m"], metadata["start_m"]) == ("0.00508", "12.5")
    assert json.loads(metadata["settings"]) == {"cutoff": 1.0}
    groups = pq.ParquetFile(path).metadata
    assert [groups.row_group(k).num_rows for k in range(groups.num_row_groups)] == [
        131_072,
        131_072,
        37_856,
    ]


@pytest.mark.parametrize("library", ["pyarrow", "pyarrow.parquet"])
def test_a_missing_library_is_named_with_the_extra(tmp_path, profile, monkeypatch, library):
    path = tmp_path / "a.parquet"
    ParquetProfile().write(profile, path)
    monkeypatch.setitem(sys.modules, library, None)
    with pytest.raises(InputError, match=r"a\.parquet: .* needs pyarrow; .*\.\[adapters\]"):
        ParquetProfile().read(path)
    with pytest.raises(InputError, match=r"writing Parquet needs pyarrow; .*\.\[adapters\]"):
        ParquetProfile().write(profile, tmp_path / "b.parquet")


GOOD = {
    "distance_m": pa.array([0.0, 0.5, 1.0]),
    "left_elevation_m": pa.array([0.0, None, 1.0], pa.float64()),
    "left_valid": pa.array([True, True, None]),
}
METADATA = {
    "format": "floatref-profile/1",
    "interval_m": "0.5",
    "start_m": "0",
    "tracks": '["left"]',
    "settings": "{}",
    "provenance": "{}",
}


def made(path, columns, metadata):
    names, arrays = zip(*columns, strict=True)
    schema = pa.schema(
        [pa.field(n, a.type) for n, a in zip(names, arrays, strict=True)], metadata=metadata
    )
    pq.write_table(pa.Table.from_arrays(list(arrays), schema=schema), path)
    return path


def test_a_file_by_another_program_with_our_metadata_is_read(tmp_path):
    path = made(tmp_path / "a.parquet", [*GOOD.items(), ("speed", pa.array([1, 2, 3]))], METADATA)
    profile = ParquetProfile().read(path)
    assert profile.interval_m == 0.5
    assert profile.track("left").valid.tolist() == [True, False, False]


BAD = {
    "metadata format is missing": ({}, {"format": None}),
    "metadata format is floatref-profile/2": ({}, {"format": "floatref-profile/2"}),
    "metadata interval_m is 'x'": ({}, {"interval_m": "x"}),
    "metadata start_m is 'nan'": ({}, {"start_m": "nan"}),
    "metadata settings is ''": ({}, {"settings": None}),
    r"metadata settings is '\[1\]'": ({}, {"settings": "[1]"}),
    r"metadata provenance is '\[{20}": ({}, {"provenance": "[" * 100_000}),
    "metadata tracks names no tracks": ({}, {"tracks": "[]"}),
    "column right_elevation_m: 0 of it": ({}, {"tracks": '["right"]'}),
    "two tracks of the profile have the same": ({}, {"tracks": '["left", "left"]'}),
    "interval_m is 0;": ({"distance_m": pa.array([0.0] * 3)}, {"interval_m": "0"}),
    "point 1: distance_m is 0.6, but": ({"distance_m": pa.array([0.0, 0.6, 1.0])}, {}),
    "point 2: distance_m is nan": ({"distance_m": pa.array([0.0, 0.5, None])}, {}),
    "column left_elevation_m holds string": ({"left_elevation_m": pa.array(["a"] * 3)}, {}),
    "column left_valid holds int64": ({"left_valid": pa.array([1, 0, 1])}, {}),
    "infinite elevation": ({"left_elevation_m": pa.array([0.0, np.inf, 0.0])}, {}),
    "no points": ({name: values[:0] for name, values in GOOD.items()}, {}),
}


@pytest.mark.parametrize("message", BAD)
def test_one_clear_line_for_what_is_wrong(tmp_path, message):
    columns, metadata = BAD[message]
    metadata = {key: value for key, value in {**METADATA, **metadata}.items() if value is not None}
    path = made(tmp_path / "a.parquet", {**GOOD, **columns}.items(), metadata)
    with pytest.raises(InputError, match=message) as caught:
        ParquetProfile().read(path)
    assert str(caught.value).startswith(f"{path}: ")
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("twice", ["left_elevation_m", "left_sigma_m"])
def test_a_column_that_is_there_twice_is_refused(tmp_path, twice):
    columns = [*GOOD.items(), (twice, GOOD["distance_m"]), (twice, GOOD["distance_m"])]
    with pytest.raises(InputError, match=rf"column {twice}: [23] of it among"):
        ParquetProfile().read(made(tmp_path / "a.parquet", columns, METADATA))


def test_settings_that_json_cannot_hold_are_named(tmp_path):
    tracks = (ProfileTrack.of("left", [0.0]),)
    for value in (np.inf, object()):
        profile = Profile(0.5, tracks, settings={"cutoff": value})
        with pytest.raises(InputError, match="settings is not to be written as JSON"):
            ParquetProfile().write(profile, tmp_path / "a.parquet")


@pytest.mark.slow
@settings(deadline=None, max_examples=200)
@given(place=st.integers(0, 3000), junk=st.binary(max_size=8), cut=st.integers(0, 60))
def test_damage_anywhere_is_a_profile_or_one_clear_line(tmp_path_factory, place, junk, cut):
    path = tmp_path_factory.getbasetemp() / "damaged.parquet"
    raw = made(path, GOOD.items(), METADATA).read_bytes()
    path.write_bytes(raw[:place] + junk + raw[place + cut :])
    refusals = []
    try:
        assert ParquetProfile().read(path).tracks[0].elevation.size >= 1
    except InputError as error:
        refusals.append(str(error))
    assert all("\n" not in line for line in refusals)


def test_a_row_group_with_a_column_of_fewer_values_is_refused(tmp_path, monkeypatch):
    """Before such a group pyarrow ends without a word: half of the road would be lost."""
    path = tmp_path / "a.parquet"
    monkeypatch.setattr(parquet_profile, "ROWS", 10)
    ParquetProfile().write(Profile(0.025, (ProfileTrack.of("left", np.arange(20.0)),)), path)
    footer = bytearray(path.read_bytes())
    # Fields 4 and 5 of a column: its compression, and its ten values, which become minus three.
    counts = [m.end() - 2 for m in re.finditer(rb"\x15.\x16\x14\x16", footer, re.DOTALL)]
    assert len(counts) == 6
    footer[counts[3]] = 5
    path.write_bytes(footer)
    with pytest.raises(InputError, match=r"a\.parquet: the footer counts 20 rows, its columns ho"):
        ParquetProfile().read(path)
