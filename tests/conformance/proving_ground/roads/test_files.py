"""Roads of the user's files: their elevation at their points, and one line for what is no road."""

from pathlib import Path

import numpy as np
import pytest

from floatref.engine import formats
from floatref.errors import InputError
from floatref.files import write_profile, write_profile_csv
from floatref.values.arrays import FloatArray
from floatref.values.profile import Profile, ProfileTrack
from floatref_conformance.proving_ground.roads.files import digest_files, file_of, road_from
from floatref_conformance.proving_ground.roads.road import FULL_FROM_M, Road

BOTH = ("left", "right")
INTERVAL_M = 0.1


def waves(seed: int, points: int = 900) -> FloatArray:
    x, rng = INTERVAL_M * np.arange(points), np.random.default_rng(seed)
    return 0.002 * np.sin(x + rng.uniform(0, 6)) + 0.01 * np.sin(x / 9 + rng.uniform(0, 6))


def profile(**tracks: FloatArray) -> Profile:
    return Profile(INTERVAL_M, tuple(ProfileTrack.of(name, z) for name, z in tracks.items()))


def in_file(road: Road, track: str, points: int) -> FloatArray:
    """Return the road at the points of its file."""
    return road.at(track, FULL_FROM_M + INTERVAL_M * np.arange(points))


@pytest.mark.parametrize("suffix", ["", ".csv", ".erd"])
def test_each_wheel_path_has_the_elevation_of_its_track_less_one_line(
    tmp_path: Path, suffix: str
) -> None:
    z = {"left": waves(1), "right": waves(2)}
    path = tmp_path / f"road{suffix}"
    if suffix == ".csv":
        write_profile_csv(profile(**z), path)
    elif suffix == ".erd":
        formats.write_as(formats.format_of(path), profile(**z), path)
    else:
        write_profile(profile(**z), path)
    road = road_from(path, 100.0, BOTH)
    removed = {name: z[name] - in_file(road, name, 900) for name in BOTH}
    assert removed["left"] == pytest.approx(removed["right"], abs=2e-6)
    assert np.abs(np.diff(removed["left"], 2)).max() < 2e-6


def test_the_only_track_serves_both_wheel_paths(tmp_path: Path) -> None:
    path = tmp_path / "road.csv"
    write_profile_csv(profile(centre=waves(3)), path)
    road = road_from(path, 300.0, BOTH)
    assert np.array_equal(road.elevation["left"], road.elevation["right"])
    assert road.end_m >= 320.0


def test_a_hole_a_missing_track_and_too_few_points_are_named(tmp_path: Path) -> None:
    path = tmp_path / "road.csv"
    z = waves(4)
    z[123] = np.nan
    for tracks, message in (
        ({"left": waves(1), "right": z}, "track right: elevation is missing at 12.3 m"),
        ({"left": waves(1), "middle": waves(2)}, "track right: missing; .* left, middle"),
        ({"left": waves(1, 3)}, "four or more points"),
    ):
        write_profile_csv(profile(**tracks), path, overwrite=True)
        with pytest.raises(InputError, match=f"road.csv: .*{message}") as caught:
            road_from(path, 100.0, BOTH)
        assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "expected distance_m"),
        ("distance_m,left_elevation_m\n0,0\n", "one point only"),
        ("distance_m,left_elevation_m\n0,0\n0.1,1\n0.1,1\n0.2,1\n", "does not increase"),
        ("distance_m,left_elevation_m\n0,0\n-0.1,1\n-0.2,1\n-0.3,1\n", "does not increase"),
    ],
)
def test_a_file_that_is_no_profile_is_named_in_one_line(
    tmp_path: Path, text: str, message: str
) -> None:
    path = tmp_path / "road.csv"
    path.write_text(text)
    with pytest.raises(InputError, match=f"road.csv: .*{message}"):
        road_from(path, 100.0, BOTH)


def test_a_missing_file_is_named(tmp_path: Path) -> None:
    for name in ("gone.csv", "gone.crg"):
        with pytest.raises(InputError, match=f"{name}: No such file"):
            road_from(tmp_path / name, 100.0, BOTH)


def test_the_file_of_a_road_is_what_follows_the_colon() -> None:
    assert file_of("measured:a/b.csv") == Path("a/b.csv")
    assert file_of("measured") is None
    assert file_of("iso-C") is None
    with pytest.raises(InputError, match="give a file"):
        file_of("measured:")


def test_the_digest_of_a_profile_directory_covers_its_elevations(tmp_path: Path) -> None:
    path = tmp_path / "road"
    write_profile(profile(left=waves(1)), path)
    first = digest_files(path)
    assert first == digest_files(path / "profile.json")
    write_profile(profile(left=waves(2)), path, overwrite=True)
    assert digest_files(path) != first
