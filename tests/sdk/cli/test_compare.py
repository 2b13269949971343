"""`floatref compare`: its JSON, grids that differ, its drawing and its refusals."""

from pathlib import Path

import numpy as np
import pytest

from floatref.files import write_profile
from floatref.values.profile import Profile, ProfileTrack

INTERVAL = 0.05


def road(seed: int = 1, count: int = 4000) -> np.ndarray:
    return np.cumsum(np.random.default_rng(seed).normal(0.0, 4e-4, count))


def written(path: Path, start: float = 0.0, interval: float = INTERVAL, **z: np.ndarray) -> Path:
    """Write a profile with one track for each keyword and return its directory."""
    tracks = tuple(ProfileTrack.of(name, values) for name, values in z.items())
    write_profile(Profile(interval, tracks, start_m=start), path)
    return path


def test_a_profile_agrees_with_itself(tmp_path: Path, reported) -> None:
    same = written(tmp_path / "a", left=road(1), right=road(2))
    found = reported("compare", same, same)
    assert [track["name"] for track in found["tracks"]] == ["left", "right"]
    for track in found["tracks"]:
        assert track["cross_correlation"] == pytest.approx(1.0, abs=1e-9)
        assert track["offset_m"] == 0.0
        assert track["iri_m_per_km"] == track["iri_reference_m_per_km"]
        assert set(track["wavebands"]) == {"long", "medium", "short"}
    assert found["settings"]["moving_average_samples"] == 5
    assert found["settings"]["max_offset_m"] == 1.0


def test_offset_is_positive_where_the_profile_lies_farther_along(tmp_path: Path, reported) -> None:
    z = road(3)
    reference = written(tmp_path / "r", main=z[12:])
    late = written(tmp_path / "p", main=1.1 * z[:-12])
    (track,) = reported("compare", reference, late)["tracks"]
    assert track["offset_m"] == pytest.approx(0.6)
    assert track["cross_correlation"] == pytest.approx(1 / 1.1, abs=0.02)
    assert track["correlation"] * track["amplitude_factor"] == pytest.approx(
        track["cross_correlation"]
    )
    (narrow,) = reported("compare", reference, late, "--max-offset", 0.5)["tracks"]
    assert abs(narrow["offset_m"]) <= 0.5
    assert narrow["cross_correlation"] < track["cross_correlation"]


def test_other_interval_and_start_are_taken_to_the_points_of_the_reference(
    tmp_path: Path, reported
) -> None:
    fine = road(4)
    reference = written(tmp_path / "r", start=100.0, interval=0.1, main=fine[::2])
    shifted = written(tmp_path / "p", start=120.0, interval=0.05, main=fine[400:3600])
    found = reported("compare", reference, shifted)
    (track,) = found["tracks"]
    assert track["cross_correlation"] == pytest.approx(1.0, abs=1e-6)
    assert track["offset_m"] == 0.0
    assert track["iri_m_per_km"] == pytest.approx(track["iri_reference_m_per_km"], rel=1e-6)
    assert found["settings"]["interval_m"] == 0.1
    assert found["settings"]["start_m"] == pytest.approx(120.0)
    assert found["settings"]["length_m"] == pytest.approx(159.9)


def test_tracks_are_matched_by_name(tmp_path: Path, invoke, reported) -> None:
    reference = written(tmp_path / "r", left=road(1), right=road(2))
    swapped = written(tmp_path / "p", right=road(2), left=road(1), middle=road(3))
    found = reported("compare", reference, swapped)
    assert all(track["cross_correlation"] > 0.999 for track in found["tracks"])
    assert found["not_compared"] == ["middle"]
    assert "Not in the reference: middle" in invoke("compare", reference, swapped).stdout


def test_missing_track_is_exit_2(tmp_path: Path, refused) -> None:
    reference = written(tmp_path / "r", left=road(1), right=road(2))
    one = written(tmp_path / "p", left=road(1))
    assert "track right of the reference is missing in the profile" in refused(
        "compare", reference, one
    )


def test_profiles_apart_are_exit_2(tmp_path: Path, refused) -> None:
    here = written(tmp_path / "r", main=road(1))
    there = written(tmp_path / "p", start=5000.0, main=road(2))
    assert "do not overlap" in refused("compare", here, there)
    same = written(tmp_path / "s", start=5000.0, main=road(1))
    assert "do not overlap" in refused("compare", here, same, "--no-placement")


@pytest.mark.parametrize("start", [65.0, -65.0, 5000.0])
def test_a_run_that_lies_elsewhere_is_placed(tmp_path: Path, start: float, reported, ran) -> None:
    reference = written(tmp_path / "r", main=road(1))
    moved = written(tmp_path / "p", start=start, main=road(1))
    found = reported("compare", reference, moved)
    assert found["placement_m"] == pytest.approx(start, abs=INTERVAL)
    (track,) = found["tracks"]
    assert track["cross_correlation"] == pytest.approx(1.0, abs=1e-3)
    assert abs(track["offset_m"]) <= INTERVAL
    assert (
        f"PROFILE lies {abs(found['placement_m']):.2f} m "
        in ran("compare", reference, moved).stdout
    )


def test_without_placement_a_run_is_compared_as_it_lies(tmp_path: Path, reported, ran) -> None:
    reference = written(tmp_path / "r", main=road(1))
    moved = written(tmp_path / "p", start=65.0, main=road(1))
    found = reported("compare", reference, moved, "--no-placement")
    assert found["placement_m"] is None
    assert found["settings"]["start_m"] == pytest.approx(65.0)
    assert found["tracks"][0]["cross_correlation"] < 0.5
    assert "PROFILE lies" not in ran("compare", reference, moved, "--no-placement").stdout


def test_a_place_that_is_not_sure_is_reported(tmp_path: Path, reported, ran) -> None:
    reference = written(tmp_path / "r", main=road(1))
    other = written(tmp_path / "p", main=road(2))
    found = reported("compare", reference, other)
    assert found["placement_m"] is None
    assert found["placement_note"] in ran("compare", reference, other).stdout
    as_it_lies = reported("compare", reference, other, "--no-placement")
    assert found["tracks"] == as_it_lies["tracks"]


@pytest.mark.parametrize("offset", ["-1", "nan", "inf", "150", "1e308"])
def test_impossible_offset_is_exit_2(tmp_path: Path, offset: str, refused) -> None:
    same = written(tmp_path / "a", main=road(1))
    assert "offset" in refused("compare", same, same, "--max-offset", offset)


@pytest.mark.slow
def test_drawing_is_written(tmp_path: Path, ran) -> None:
    same = written(tmp_path / "a", main=road(1))
    ran("compare", same, same, "--plot", tmp_path / "c.png")
    assert (tmp_path / "c.png").read_bytes().startswith(b"\x89PNG")


def test_unwritable_drawing_is_exit_2_and_prints_no_result(tmp_path: Path, refused) -> None:
    same = written(tmp_path / "a", main=road(1))
    assert "c.png" in refused("compare", same, same, "--plot", tmp_path / "nowhere/c.png")


def test_table_is_plain_when_piped_and_prints_the_settings(tmp_path: Path, invoke) -> None:
    reference = written(tmp_path / "r", left=road(1))
    scaled = written(tmp_path / "p", left=1.02 * road(1))
    text = invoke("compare", reference, scaled).stdout
    assert "\x1b" not in text
    for part in ("0.9804", "+2.00 %", "long", "medium", "short", "max_offset_m", "interval_m"):
        assert part in text


def test_reference_without_roughness_has_no_difference_in_per_cent(
    tmp_path: Path, invoke, reported, ran
) -> None:
    flat = written(tmp_path / "r", main=np.zeros(4000))
    rough = written(tmp_path / "p", main=road(1))
    (track,) = reported("compare", flat, rough)["tracks"]
    assert track["cross_correlation"] == 0.0
    ran("compare", flat, rough)
