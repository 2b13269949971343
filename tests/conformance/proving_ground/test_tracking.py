"""A vehicle that leaves its wheel paths: repeat passes of one road, print's agreement."""

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from floatref.errors import InputError
from floatref.measures import iri
from floatref_conformance.proving_ground.roads.files import FILE_ROAD
from floatref_conformance.proving_ground.roads.strips import along_line
from floatref_conformance.proving_ground.roads.wander import Line
from floatref_conformance.proving_ground.scenario import Scenario
from floatref_conformance.proving_ground.scenario_file import read_scenario
from floatref_conformance.proving_ground.staging import road_of

STRAY = Scenario(seed=3, road_seed=8, wander_m=0.1, wander_within_m=0.02, length_m=100.0)
PROFILE = "distance_m,left_elevation_m\n" + "".join(
    f"{k / 10},{np.sin(k / 30) / 100:.9f}\n" for k in range(1000)
)


def test_passes_of_one_road_differ_by_their_line_alone() -> None:
    straight = road_of(replace(STRAY, wander_m=0.0, wander_within_m=0.0), 100.0)
    again, other = road_of(STRAY, 100.0), road_of(replace(STRAY, seed=4), 100.0)
    for track in ("left", "right"):
        paths = [road.elevation[track] for road in (straight, again, other)]
        assert np.array_equal(paths[1], road_of(STRAY, 100.0).elevation[track])
        assert 0 < np.abs(paths[1] - paths[0]).max() < 0.02
        assert 0 < np.abs(paths[2] - paths[1]).max() < 0.02
        same = along_line(straight, Line(4, 0.1, 0.02), 8)
        assert np.array_equal(paths[2], same.elevation[track])


def test_the_road_is_scaled_by_its_wheel_paths_and_not_by_the_line() -> None:
    found = [
        np.mean([iri(z[9200:24000], road.spacing_m) for z in road.elevation.values()])
        for road in (road_of(replace(STRAY, seed=seed), 100.0) for seed in (3, 4))
    ]
    assert found[0] != pytest.approx(1.8, rel=1e-6)
    assert found == pytest.approx([1.8, 1.8], rel=0.15)


@pytest.mark.parametrize("road", ["flat", "sines"])
def test_roads_alike_sideways_are_the_same_on_every_line(road: str) -> None:
    stray = replace(STRAY, road=road)
    straight = road_of(replace(stray, wander_m=0.0, wander_within_m=0.0), 60.0)
    assert np.array_equal(road_of(stray, 60.0).elevation["left"], straight.elevation["left"])


def test_the_bump_is_as_wide_as_the_road() -> None:
    with_it = road_of(replace(STRAY, bump_mm=20.0, bump_at_m=70.0), 100.0)
    without = road_of(STRAY, 100.0)
    added = with_it.elevation["left"] - without.elevation["left"]
    assert added.max() == pytest.approx(0.02, abs=1e-9)
    assert np.count_nonzero(added > 1e-9) == pytest.approx(3.0 / 0.005, abs=3)


def test_a_measured_surface_is_sampled_along_the_line(tmp_path: Path) -> None:
    pycrg = pytest.importorskip(
        "pycrg", reason="pycrg writes the surfaces; it comes with floatref[conformance]"
    )
    v = np.linspace(-1.5, 1.5, 31)
    pycrg.write(
        tmp_path / "a.crg", 0.01 * np.sin(np.arange(400) / 9)[:, None] + 0.1 * v**2, 0.05, v
    )
    stray = replace(STRAY, road=f"{FILE_ROAD}{tmp_path / 'a.crg'}", iri_m_per_km=0.0)
    road = road_of(stray, 60.0)
    x = road.distance_m
    shift = Line(3, 0.1, 0.02).at(x)
    full = x > 30
    difference = road.elevation["left"] - road.elevation["right"]
    expected = 0.1 * ((0.86 + shift) ** 2 - (-0.86 + shift) ** 2)
    assert difference[full] == pytest.approx(expected[full], abs=3e-4)
    straight = replace(stray, wander_m=0.0, wander_within_m=0.0)
    factors = [
        np.ptp(road_of(replace(s, iri_m_per_km=1.0), 60.0).elevation["left"])
        / np.ptp(road_of(s, 60.0).elevation["left"])
        for s in (straight, stray)
    ]
    assert factors[1] == pytest.approx(factors[0])


def test_a_road_of_a_file_is_found_from_the_scenario_file_and_left_as_measured(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    folder = tmp_path / "deep"
    folder.mkdir()
    (folder / "road.csv").write_text(PROFILE)
    (folder / "a.json").write_text(json.dumps({"road": "measured:road.csv"}))
    monkeypatch.chdir(tmp_path)
    scenario = read_scenario(Path("deep/a.json"))
    assert scenario.iri_m_per_km == 0.0
    road = road_of(scenario, 100.0)
    x = np.arange(30.0, 110.0, 0.5)
    measured = np.sin((x - 26) / 3) / 100
    line = np.polyval(np.polyfit(x, measured - road.at("left", x), 1), x)
    assert road.at("left", x) == pytest.approx(measured - line, abs=1e-5)
    scaled = replace(scenario, iri_m_per_km=2.5)
    path = road_of(scaled, 200.0).elevation["left"][9200:-4001]
    assert iri(path, 0.005) == pytest.approx(2.5, rel=1e-3)


def test_the_hash_follows_the_content_of_the_file(tmp_path: Path) -> None:
    path = tmp_path / "road.csv"
    scenario = Scenario(road=f"{FILE_ROAD}{path}")
    with pytest.raises(InputError, match=r"road\.csv: No such file"):
        _ = scenario.hash
    path.write_text(PROFILE)
    first = scenario.hash
    assert first == Scenario(road=f"{FILE_ROAD}{path}").hash
    path.write_text(PROFILE.replace("0.1,", "0.1,1"))
    assert scenario.hash != first


def test_a_road_without_a_file_is_refused() -> None:
    with pytest.raises(InputError, match="give a file"):
        Scenario(road="measured:")
    with pytest.raises(InputError, match="did you mean measured"):
        Scenario(road="measuredd")
