"""A line laser on the ground: the tyres keep their road, laser and truth have the bridged one."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from floatref.errors import InputError
from floatref_conformance.proving_ground.roads.bridging import bridge
from floatref_conformance.proving_ground.roads.files import FILE_ROAD
from floatref_conformance.proving_ground.roads.shaping import scale_factor
from floatref_conformance.proving_ground.roads.strips import strip_around
from floatref_conformance.proving_ground.roads.wander import Line
from floatref_conformance.proving_ground.scenario import Scenario
from floatref_conformance.proving_ground.simulate import simulate
from floatref_conformance.proving_ground.staging import ground_of, road_of
from floatref_conformance.proving_ground.tracking import Ground

POINT = Scenario(seed=3, road_seed=8, length_m=60.0, rate_hz=2000.0, sensors=0.0, laser_ahead_m=0.0)
WIDE = replace(POINT, laser_line_mm=100.0)


def same(ground: Ground) -> bool:
    return all(
        np.array_equal(z, ground.read.elevation[name])
        for name, z in ground.rolled.elevation.items()
    )


@pytest.mark.slow
@pytest.mark.parametrize("wander", [{}, {"wander_m": 0.1, "wander_within_m": 0.02}])
def test_the_tyres_keep_their_road_and_the_line_lies_about_it(wander: dict[str, float]) -> None:
    point, wide = (replace(s, **wander) for s in (POINT, WIDE))
    ground = ground_of(wide, 60.0)
    for track, z in road_of(point, 60.0).elevation.items():
        assert ground.rolled.elevation[track] == pytest.approx(z, abs=1e-12)
    base = road_of(POINT, 60.0)
    y = Line(3, wide.wander_m, wide.wander_within_m).at(base.distance_m)
    strip = strip_around(base, "left", 8, float(y.min()) - 0.07, float(y.max()) + 0.07)
    found = ground.read.elevation["left"]
    assert found == pytest.approx(bridge(strip, y, 0.1), abs=1e-12)
    difference = found - ground.rolled.elevation["left"]
    assert 1e-4 < np.abs(difference).max() < 2e-3


def test_a_point_reads_what_the_tyres_roll_on() -> None:
    assert same(ground_of(POINT, 60.0))
    assert same(ground_of(replace(POINT, wander_m=0.1), 60.0))


@pytest.mark.parametrize("road", ["flat", "sines"])
def test_a_road_alike_sideways_is_read_as_by_a_point(road: str) -> None:
    assert same(ground_of(replace(WIDE, road=road), 60.0))


@pytest.mark.slow
def test_what_is_as_wide_as_the_road_is_read_whole() -> None:
    features = {"bump_mm": 20.0, "bump_at_m": 40.0, "joint_mm": 3.0, "crown_mm": 50.0}
    features |= {"crown_at_m": 45.0, "patch_mm": 10.0, "patches_per_km": 100.0}
    plain, shaped = (ground_of(s, 60.0) for s in (WIDE, replace(WIDE, **features)))
    added = [shaped[k].elevation["right"] - plain[k].elevation["right"] for k in range(len(plain))]
    assert np.ptp(added[0]) > 0.05
    assert added[0] == pytest.approx(added[1], abs=1e-12)


@pytest.mark.slow
def test_ideal_sensors_read_the_bridged_height_and_it_is_the_truth() -> None:
    point, wide = simulate(POINT), simulate(WIDE)
    seen, other = (s.motion.tracks["left"] for s in (wide, point))
    assert np.array_equal(seen.vertical, other.vertical)
    ahead = wide.recording.setup.tracks["left"].reference_point_m[0]
    read = ground_of(WIDE, 60.0).read.at("left", wide.motion.distance + ahead)
    upright = np.cos(wide.motion.pitch) * np.cos(wide.motion.roll)
    fallen = seen.height_m - wide.recording.channel("height", "left").values * upright
    assert fallen == pytest.approx(seen.road_m, abs=1e-12)
    assert fallen == pytest.approx(read, abs=3e-4)
    truth = wide.truth.track("left")
    assert truth.elevation == pytest.approx(
        np.interp(wide.truth.distance_m, wide.motion.distance, seen.road_m), abs=2e-4
    )
    assert np.abs(truth.elevation - point.truth.track("left").elevation).max() > 1e-4


def test_a_given_road_is_read_across_too() -> None:
    road = road_of(POINT, 60.0)
    given, own = simulate(WIDE, road=road), simulate(WIDE)
    for track, found in given.motion.tracks.items():
        assert np.array_equal(found.range_m, own.motion.tracks[track].range_m)


@pytest.mark.slow
def test_a_measured_surface_is_read_as_it_is_measured(tmp_path: Path) -> None:
    """A crack of 3 mm beside the line's middle does not count: its mean is 0.3 mm."""
    pycrg = pytest.importorskip(
        "pycrg", reason="pycrg writes the surfaces; it comes with floatref[conformance]"
    )
    v = np.round(np.arange(-150, 151) * 0.01, 2)
    z = 0.01 * np.sin(np.arange(800) / 9)[:, None] + 0.005 * v
    z[:, np.isclose(v, 0.87)] -= 0.003
    pycrg.write(tmp_path / "a.crg", z, 0.05, v)
    scenario = replace(WIDE, road=f"{FILE_ROAD}{tmp_path / 'a.crg'}", iri_m_per_km=0.0)
    ground = ground_of(scenario, 60.0)
    full = slice(round(50 / 0.005), None)
    for track in ("left", "right"):
        rolled, read = (road.elevation[track][full] for road in ground)
        assert read == pytest.approx(rolled, abs=1e-4)
    assert not same(ground)


def test_a_measured_surface_is_read_about_the_line_at_its_scale(tmp_path: Path) -> None:
    """Of z = y³ the mean over the middle 70 mm is y³ + y·(35 mm)²."""
    pycrg = pytest.importorskip(
        "pycrg", reason="pycrg writes the surfaces; it comes with floatref[conformance]"
    )
    v = np.round(np.arange(-130, 131) * 0.01, 2)
    pycrg.write(tmp_path / "a.crg", 0.005 * np.sin(np.arange(800) / 9)[:, None] + v**3, 0.05, v)
    own = replace(WIDE, road=f"{FILE_ROAD}{tmp_path / 'a.crg'}", iri_m_per_km=0.0, wander_m=0.1)
    full = slice(round(50 / 0.005), None)
    ranges = []
    for factor in (1.0, 2.0):
        scenario = own
        if factor == 2.0:
            straight = road_of(replace(POINT, road=own.road, iri_m_per_km=0.0), 60.0)
            scenario = replace(own, iri_m_per_km=2.0 / scale_factor(straight, 1.0))
        ground = ground_of(scenario, 60.0)
        y = 0.86 + Line(3, 0.1, 0.0).offset_m
        rolled, read = (road.elevation["left"][full] for road in ground)
        assert read - rolled == pytest.approx(factor * y * 0.035**2, abs=factor * 6e-5)
        ranges.append(np.ptp(rolled))
    assert ranges[1] == pytest.approx(2 * ranges[0])


def test_a_surface_narrower_than_the_line_is_refused(tmp_path: Path) -> None:
    pycrg = pytest.importorskip(
        "pycrg", reason="pycrg writes the surfaces; it comes with floatref[conformance]"
    )
    v = np.round(np.arange(-90, 91) * 0.01, 2)
    pycrg.write(tmp_path / "a.crg", np.zeros((800, v.size)), 0.05, v)
    scenario = replace(POINT, road=f"{FILE_ROAD}{tmp_path / 'a.crg'}", iri_m_per_km=0.0)
    ground_of(scenario, 60.0)
    scenario = replace(scenario, laser_line_mm=100.0)
    with pytest.raises(InputError, match="lower wander_m, wander_within_m or laser_line_mm"):
        ground_of(scenario, 60.0)
