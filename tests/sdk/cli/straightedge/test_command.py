"""`floatref straightedge`: its JSON is what the measures give, its marks, its refusals."""

from pathlib import Path

import numpy as np
import pytest

from floatref.files import write_profile
from floatref.measures import (
    Profilograph,
    TraceRules,
    must_grind,
    profile_indices,
    profilograph_trace,
    rolling_straightedge,
    valid_frames,
)
from floatref.values.profile import Profile, ProfileTrack

INTERVAL, START = 0.1, 50.0


def rough_road() -> np.ndarray:
    z = np.cumsum(np.random.default_rng(1).normal(0.0, 5e-4, 4000))
    z[1500:1512] += 0.02
    return z


def write(folder: Path, *tracks: ProfileTrack) -> Path:
    write_profile(Profile(INTERVAL, tracks, start_m=START), folder / "road")
    return folder / "road"


@pytest.fixture
def road(tmp_path: Path) -> Path:
    valid = np.arange(4000) // 60 != 25
    return write(tmp_path, ProfileTrack.of("main", rough_road(), valid))


def test_the_straightedge_is_that_of_the_measure(road: Path, reported) -> None:
    report = reported("straightedge", road, "--length", 4.8, "--tolerance", 0.005)
    (track,) = report["tracks"]
    expected = rolling_straightedge(rough_road(), INTERVAL, 4.8, 0.005, START)
    found = track["straightedge"]
    assert found["largest_m"] == expected.largest_m
    assert found["defective_share"] == expected.defective_share
    assert [area["start_m"] for area in found["areas"]] == [a.start_m for a in expected.areas]
    assert report["settings"]["straightedge_m"] == pytest.approx(4.8)


def test_the_profilograph_is_that_of_the_measure(road: Path, reported) -> None:
    options = ("--wheels", "-4,-3,3,4", "--low-pass", 0.8, "--blanking-band", 0, "--segment", 100)
    report = reported("straightedge", road, *options, "--bump", 0.01)
    found = report["tracks"][0]["profilograph"]
    machine = Profilograph((-4.0, -3.0, 3.0, 4.0), 0.8)
    rules = TraceRules(blanking_band_m=0.0, segment_m=100.0, bump_height_m=0.01)
    trace = profilograph_trace(rough_road(), INTERVAL, machine)
    sound = valid_frames(rough_road(), INTERVAL, machine)
    segments = profile_indices(trace, sound, INTERVAL, rules, START)
    assert [s["profile_index_m_per_km"] for s in found["segments"]] == [
        s.profile_index_m_per_km for s in segments
    ]
    bumps = must_grind(trace, sound, INTERVAL, rules, START)
    assert [b["peak_at_m"] for b in found["must_grind"]] == [b.peak_at_m for b in bumps]
    whole = sum(s.profile_index_m_per_km * s.measured_m for s in segments)
    assert found["profile_index_m_per_km"] * found["measured_m"] == pytest.approx(whole)
    assert report["settings"]["wheels_m"] == pytest.approx([-4.0, -3.0, 3.0, 4.0])


def test_what_rests_on_invalid_points_is_marked(road: Path, reported, ran) -> None:
    (track,) = reported("straightedge", road)["tracks"]
    assert track["valid_share"] == 1.0 - 60 / 4000
    assert track["straightedge"]["valid_share"] < track["valid_share"]
    assert track["profilograph"]["valid_share"] < track["straightedge"]["valid_share"]
    assert min(area["valid_share"] for area in track["straightedge"]["areas"]) < 1.0
    assert min(area["valid_share"] for area in track["profilograph"]["must_grind"]) < 1.0
    text = ran("straightedge", road).stdout
    for title in ("Straightedge", "Beyond the tolerance", "Profilograph", "Must be ground"):
        assert f"{title}\n" in text


def test_a_flat_road_has_no_areas(tmp_path: Path, ran) -> None:
    flat = write(tmp_path, ProfileTrack.of("main", np.zeros(2000)))
    text = ran("straightedge", flat).stdout
    assert "Beyond the tolerance: 0 areas" in text
    assert "Must be ground: 0 areas" in text


def test_a_profile_between_both_lengths_has_a_straightedge_alone(tmp_path: Path, reported) -> None:
    short = write(tmp_path, ProfileTrack.of("main", np.zeros(50)))
    (track,) = reported("straightedge", short)["tracks"]
    assert track["straightedge"]["largest_m"] == 0.0
    assert track["profilograph"]["profile_index_m_per_km"] is None
    assert track["profilograph"]["measured_m"] == 0.0


@pytest.mark.parametrize(
    ("arguments", "text"),
    [
        (["--length", "0"], "length of the straightedge is 0.0 m"),
        (["--length", "900"], "track main: the straightedge of 900 m has no place on the measured"),
        (["--tolerance", "-1"], "a deviation of -1.0 m is no limit"),
        (["--wheels", "1,b"], "--wheels 1,b: not a list of numbers"),
        (["--wheels", "1,2"], "no wheel on one side"),
        (["--low-pass", "nan"], "low-pass is nan m"),
        (["--blanking-band", "-1"], "blanking_band_m is -1.0"),
        (["--bump", "0"], "bump_height_m is 0.0"),
        (["--segment", "0.01"], "segment is 0.01 m, less than the interval"),
    ],
)
def test_an_impossible_option_is_exit_2(road: Path, arguments: list[str], text: str, refused):
    assert text in refused("straightedge", road, *arguments)
