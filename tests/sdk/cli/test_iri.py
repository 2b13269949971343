"""`floatref iri`: its JSON, its tables, its units and its refusals."""

from importlib.resources import files
from pathlib import Path

import numpy as np
import pytest

from floatref.files import write_profile
from floatref.measures import iri
from floatref.values.profile import Profile, ProfileTrack

MEASURED_ROAD = files("floatref_conformance.proving_ground") / "data/sroubek/profile_1.txt"


def measured_road() -> np.ndarray:
    return np.loadtxt(MEASURED_ROAD)[:, 1]


@pytest.fixture
def one(tmp_path: Path) -> Path:
    track = ProfileTrack.of("main", measured_road())
    write_profile(Profile(0.25, (track,), start_m=478.0), tmp_path / "one")
    return tmp_path / "one"


@pytest.fixture
def two(tmp_path: Path) -> Path:
    z = measured_road()
    z[300:312] = np.nan
    mirrored = 2.0 * measured_road()[::-1]
    tracks = (ProfileTrack.of("left", z), ProfileTrack.of("right", mirrored))
    write_profile(Profile(0.25, tracks, start_m=478.0), tmp_path / "two")
    return tmp_path / "two"


def test_measured_road_as_a_profile_directory_has_its_value(one: Path, reported) -> None:
    found = reported("iri", one)
    (track,) = found["tracks"]
    assert track["name"] == "main"
    assert track["iri_m_per_km"] == pytest.approx(3.334, rel=1e-3)
    (segment,) = track["segments"]
    assert (segment["start_m"], segment["length_m"]) == (478.0, 544.0)
    assert segment["iri_m_per_km"] == track["iri_m_per_km"] == track["iri_of_valid_m_per_km"]
    assert track["counted_share"] == 1.0
    assert found["mean_roughness_index_m_per_km"] is None
    assert found["settings"]["moving_average_samples"] == 1
    assert found["settings"]["start_length_m"] == 11.0


def test_two_tracks_have_a_mean_and_invalid_lengths(two: Path, reported) -> None:
    found = reported("iri", two)
    left, right = found["tracks"]
    assert (left["name"], right["name"]) == ("left", "right")
    assert (left["invalid_m"], right["invalid_m"]) == (3.0, 0.0)
    mean = (left["iri_m_per_km"] + right["iri_m_per_km"]) / 2
    assert found["mean_roughness_index_m_per_km"] == pytest.approx(mean)
    assert right["iri_m_per_km"] == pytest.approx(iri(2 * measured_road()[::-1], 0.25))


def test_us_units_are_added_to_the_same_keys(two: Path, reported) -> None:
    si, us = (
        reported("iri", two, "--segment", 100),
        reported("iri", two, "--segment", 100, "--units", "us"),
    )
    for plain, both in zip(si["tracks"], us["tracks"], strict=True):
        pairs = zip([plain, *plain["segments"]], [both, *both["segments"]], strict=True)
        for before, after in pairs:
            assert after["iri_m_per_km"] == before["iri_m_per_km"]
            assert after["iri_in_per_mi"] == pytest.approx(63.36 * before["iri_m_per_km"])
    expected = 63.36 * si["mean_roughness_index_m_per_km"]
    assert us["mean_roughness_index_in_per_mi"] == pytest.approx(expected)


def test_segment_that_was_not_measured_is_null(tmp_path: Path, invoke, reported) -> None:
    z = measured_road()
    z[:500] = np.nan
    write_profile(Profile(0.25, (ProfileTrack.of("main", z),)), tmp_path / "late")
    (track,) = reported("iri", tmp_path / "late", "--segment", 100)["tracks"]
    assert track["segments"][0]["iri_m_per_km"] is None
    assert track["segments"][2]["iri_m_per_km"] > 0
    assert "–" in invoke("iri", tmp_path / "late", "--segment", 100).stdout


def test_table_is_plain_when_piped_and_prints_the_settings(two: Path, invoke) -> None:
    text = invoke("iri", two, "--segment", 200, "--units", "us").stdout
    assert "\x1b" not in text
    assert "IRI in/mi" in text
    assert "mean roughness index" in text
    lines = [line.split() for line in text.splitlines()]
    assert ["left", "*", "478.00", "200.00"] in [line[:4] for line in lines]
    assert ["left", "878.00", "144.00"] in [line[:3] for line in lines]
    assert "* not all points are valid" in text
    for line in ("interval_m              0.25", "start_length_m          11.0", "segment_m"):
        assert line in text


@pytest.mark.parametrize(
    ("arguments", "text"),
    [
        (["--segment", "-5"], "segment_m is -5.0"),
        (["--segment", "nan"], "segment_m is nan"),
        (["--segment", "0.1"], "segment is 0.1 m, less than the interval"),
        (["--units", "furlongs"], "furlongs"),
    ],
)
def test_impossible_option_is_exit_2(one: Path, arguments: list[str], text: str, refused) -> None:
    assert text in refused("iri", one, *arguments)


def test_unusable_profile_is_one_line_with_file_and_track(tmp_path: Path, refused) -> None:
    track = ProfileTrack.of("left", np.zeros(20))
    write_profile(Profile(0.25, (track,)), tmp_path / "short")
    assert f"{tmp_path / 'short'}: track left: 4.75 m of profile" in refused(
        "iri", tmp_path / "short"
    )
