"""`floatref roughness`: its JSON is what the measures give, its marks, its tables, its refusals."""

import re
from pathlib import Path

import numpy as np
import pytest

from floatref.files import write_profile
from floatref.measures import (
    Waveband,
    bumps_and_dips,
    half_car_roughness_index,
    hpms_sections,
    iri,
    join_profile_indices,
    mean_path,
    ride_number,
    ride_profile_index,
    waveband_energy,
)
from floatref.values.profile import Profile, ProfileTrack

INTERVAL, START = 0.1, 50.0


def rough_road(seed: int) -> np.ndarray:
    z = np.cumsum(np.random.default_rng(seed).normal(0.0, 4e-4, 4000))
    z[1500:1512] += 0.012
    return z


def write(folder: Path, *tracks: ProfileTrack) -> Path:
    write_profile(Profile(INTERVAL, tracks, start_m=START), folder / "road")
    return folder / "road"


@pytest.fixture
def two(tmp_path: Path) -> Path:
    valid = np.arange(4000) // 60 != 25
    left = ProfileTrack.of("left", rough_road(1), valid)
    return write(tmp_path, left, ProfileTrack.of("right", rough_road(2)))


@pytest.fixture
def one(tmp_path: Path) -> Path:
    return write(tmp_path, ProfileTrack.of("main", rough_road(1)))


def test_indices_of_the_lane_are_those_of_the_measures(two: Path, reported) -> None:
    left, right = rough_road(1), rough_road(2)
    found = reported("roughness", two)
    lane = found["lane"]
    values = [iri(z, INTERVAL) for z in (left, right)]
    assert [track["iri_m_per_km"] for track in found["tracks"]] == values
    assert lane["mean_roughness_index_m_per_km"] == pytest.approx(sum(values) / 2)
    half_car = half_car_roughness_index(left, right, INTERVAL)
    assert lane["half_car_roughness_index_m_per_km"] == half_car
    indices = [ride_profile_index(z, INTERVAL) for z in (left, right)]
    assert lane["ride_number"] == ride_number(join_profile_indices(*indices))
    assert [track["ride_number"] for track in found["tracks"]] == list(map(ride_number, indices))


def test_what_rests_on_invalid_points_is_marked_everywhere(two: Path, reported) -> None:
    found = reported("roughness", two)
    left, right = found["tracks"]
    share = 1.0 - 60 / 4000
    assert (left["valid_share"], right["valid_share"]) == (share, 1.0)
    assert found["lane"]["valid_share"] == share
    assert [band["valid_share"] for band in left["wavebands"]] == [share] * 3
    assert left["localized_roughness"][0]["valid_share"] < 1.0
    assert all(area["valid_share"] == 1.0 for area in right["localized_roughness"])
    assert [section["valid_share"] < 1.0 for section in found["sections"]] == [True, False, False]


def test_places_and_sections_lie_on_the_axis_of_the_profile(two: Path, reported) -> None:
    paths = [rough_road(1), rough_road(2)]
    found = reported("roughness", two, "--section", 100, "--deviation", 0.005)
    mean = mean_path(*paths, INTERVAL)
    places = bumps_and_dips(mean, INTERVAL, 0.005, start_m=START)
    assert [p["peak_at_m"] for p in found["lane"]["bumps_and_dips"]] == [
        place.peak_at_m for place in places
    ]
    sections = hpms_sections(paths, INTERVAL, start_m=START, section_m=100.0)
    for shown, section in zip(found["sections"], sections, strict=True):
        assert shown["mean_m_per_km"] == section.mean_m_per_km
        assert shown["rating"] == section.rating
        assert list(shown["iri_m_per_km"]) == ["left", "right"]
        assert shown["start_m"] == section.start_m
    assert sum(found["section_length_shares"].values()) == pytest.approx(1.0)


def test_wavebands_are_those_asked_for(one: Path, reported) -> None:
    (track,) = reported("roughness", one, "--band", 30, 10, "--band", 10, 3)["tracks"]
    for shown, band in zip(track["wavebands"], [(30.0, 10.0), (10.0, 3.0)], strict=True):
        energy = waveband_energy(rough_road(1), INTERVAL, Waveband(*band))
        assert (shown["long_m"], shown["short_m"]) == band
        assert shown["rms_elevation_m"] == energy.rms_elevation_m
        assert shown["rms_slope"] == energy.rms_slope


def test_one_wheel_path_has_no_figures_of_two(one: Path, reported, ran) -> None:
    lane = reported("roughness", one)["lane"]
    assert lane["tracks"] == ["main"]
    for name in ("mean_roughness_index_m_per_km", "half_car_roughness_index_m_per_km"):
        assert lane[name] is None
    assert lane["ride_number"] is None
    assert "MRI" not in ran("roughness", one).stdout


def test_tables_are_plain_and_show_every_part(two: Path, ran) -> None:
    text = ran("roughness", two).stdout
    assert "\x1b" not in text
    for title in ("Roughness", "Localized roughness", "Bumps and dips of left and right"):
        assert f"{title}\n" in text
    for title in ("Wavebands", "Sections", "Rated length *", "Settings"):
        assert f"\n{title}\n" in text
    assert "mean (MRI)" in text
    assert re.search(r"^ left \* +\S+ +\S+ +\S+ +\S+ +98\.5$", text, re.MULTILINE)


def test_nothing_above_the_limits_is_one_line(two: Path, ran) -> None:
    text = ran("roughness", two, "--threshold", 1000, "--deviation", 1).stdout
    assert "Localized roughness: 0 areas" in text
    assert "Bumps and dips of left and right: 0 areas" in text


def test_the_lane_of_many_wheel_paths_is_chosen(tmp_path: Path, reported, refused) -> None:
    tracks = (ProfileTrack.of(name, rough_road(k)) for k, name in enumerate(("a", "b", "c")))
    many = write(tmp_path, *tracks)
    assert "the profile a, b, c; give --tracks" in refused("roughness", many)
    assert "track d: missing" in refused("roughness", many, "--tracks", "a", "d")
    assert "two different wheel paths" in refused("roughness", many, "--tracks", "a", "a")
    found = reported("roughness", many, "--tracks", "c", "a")
    assert found["lane"]["tracks"] == ["c", "a"]


@pytest.mark.parametrize(
    ("arguments", "text"),
    [
        (["--threshold", "0"], "threshold_m_per_km is 0.0"),
        (["--deviation", "nan"], "deviation_m is nan"),
        (["--section", "-5"], "section_m is -5.0"),
        (["--section", "0.01"], "segment is 0.01 m, less than the interval"),
        (["--band", "3", "10"], "its longest wavelength in m, then its shortest"),
        (["--band", "0.15", "0.1"], "holds no wavelengths of 0.15 m"),
    ],
)
def test_an_impossible_option_is_exit_2(one: Path, arguments: list[str], text: str, refused):
    assert text in refused("roughness", one, *arguments)


def test_a_short_profile_is_one_line_with_file_and_track(tmp_path: Path, refused) -> None:
    short = write(tmp_path, ProfileTrack.of("left", np.zeros(20)))
    assert f"{short}: track left: 1.9 m of profile" in refused("roughness", short)
