"""`--gis` of `iri`, `roughness` and `batch`: segments on a map, with marks, and what is refused."""

import json
from pathlib import Path

import numpy as np
import pyogrio
import pytest

from floatref.files import read_recording, write_recording
from floatref.values.clock import UniformClock
from floatref.values.recording import Channel, Recording, Setup

ASKED = ("--pipeline", "temporal-basic", "--out")


def drive(located: bool = True) -> Recording:
    """160 m at 20 m/s over two wheel paths, eastward along the equator."""
    clock, times = UniformClock.of(1000.0), np.arange(8000) / 1000.0
    channels = [Channel.of("distance", 20.0 * times, clock)]
    for track, phase in (("left", 0.0), ("right", 1.0)):
        wave = np.sin(15.0 * times + phase)
        channels.append(Channel.of("height", 0.3 + 0.005 * wave, clock, track))
        force = 9.80665 + 1e-3 * wave
        channels.append(Channel.of("vertical_specific_force", force, clock, track))
    if located:
        fixes = UniformClock.of(10.0)
        channels.append(Channel.of("gnss_latitude", np.zeros(80), fixes))
        channels.append(Channel.of("gnss_longitude", 2.0 * np.arange(80) / 6.378137e6, fixes))
    return Recording(tuple(channels), Setup(profile_interval_m=0.05))


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory, ran) -> Path:
    place = tmp_path_factory.mktemp("places")
    write_recording(drive(), place / "run")
    write_recording(drive(located=False), place / "nowhere")
    ran("process", place / "run", *ASKED, place / "road")
    ran("process", place / "nowhere", *ASKED, place / "lost")
    return place


def features(path: Path) -> list[dict]:
    return json.loads(path.read_text())["features"]


def test_the_figures_on_the_map_are_those_of_the_command(folder: Path, tmp_path: Path, reported):
    layer = ("--gis", tmp_path / "x.geojson", "--recording", folder / "run")
    report = reported("iri", folder / "road", "--segment", "50", *layer)
    found = features(tmp_path / "x.geojson")
    printed = [(t["name"], s) for t in report["tracks"] for s in t["segments"]]
    assert len(found) == len(printed) == 8
    for feature, (track, segment) in zip(found, printed, strict=True):
        held = feature["properties"]
        assert (held["name"], held["track"]) == ("road", track)
        for key in ("start_m", "length_m", "iri_m_per_km", "iri_of_valid_m_per_km"):
            assert held[key] == segment[key]
        assert held["marked"] is (segment["counted_share"] < 1.0)
        east = [np.radians(place[0]) * 6.378137e6 for place in feature["geometry"]["coordinates"]]
        ends = segment["start_m"], segment["start_m"] + segment["length_m"]
        assert (east[0], east[-1]) == pytest.approx(ends, abs=0.6)
        assert {place[1] for place in feature["geometry"]["coordinates"]} == {0.0}


def test_roughness_has_the_measures_of_its_sections(folder: Path, tmp_path: Path, reported):
    layer = ("--gis", tmp_path / "x.gpkg", "--recording", folder / "run", "--threshold", "0.5")
    report = reported("roughness", folder / "road", "--section", "1000", *layer)
    meta, _, _, columns = pyogrio.raw.read(tmp_path / "x.gpkg")
    held = dict(zip(meta["fields"], columns, strict=True))
    assert held["ride_number"].tolist() == [t["ride_number"] for t in report["tracks"]]
    assert held["lane_ride_number"][0] == report["lane"]["ride_number"]
    for track, length in zip(report["tracks"], held["localized_roughness_m"], strict=True):
        areas = track["localized_roughness"]
        assert length == pytest.approx(sum(area["end_m"] - area["start_m"] for area in areas))
    assert held["hpms_rating"].tolist() == [report["sections"][0]["rating"]] * 2


@pytest.mark.slow
def test_a_batch_writes_both_formats_and_says_what_has_no_place(
    folder: Path, tmp_path: Path, invoke
):
    out = tmp_path / "net"
    layers = ("--gis", out / "x.geojson", "--gis", tmp_path / "x.gpkg")
    sources = folder / "run", folder / "nowhere"
    options = ("--segment", "50", "--measures", "--jobs", "1", *layers)
    result = invoke("batch", *sources, *ASKED, out, *options)
    assert result.exit_code == 0, result.output
    assert "8 segments; 8 without a place are left out" in result.stderr
    found = features(out / "x.geojson")
    assert {feature["properties"]["name"] for feature in found} == {"run"}
    assert {"ride_number", "hpms_rating", "counted_share"} <= set(found[0]["properties"])
    assert pyogrio.read_info(tmp_path / "x.gpkg")["features"] == 8
    assert "ride_number" in (out / "summary.csv").read_text().splitlines()[0]


def other_recording(folder: Path) -> Path:
    """Another run of the same road."""
    path = folder / "other"
    if not path.exists():
        read = read_recording(folder / "run")
        write_recording(Recording(read.channels[::-1], read.setup), path)
        (path / "distance.f64").write_bytes((1.01 * np.arange(8000.0) / 50.0).tobytes())
    return path


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("road", "--gis", "x.geojson"), "--gis needs the places of a recording; give --recording"),
        (("road", "--recording", "run"), "are for --gis FILE"),
        (("road", "--gis", "x.shp", "--recording", "run"), "suffix '.shp' is no format of a layer"),
        (("road", "--gis", "there.gpkg", "--recording", "run"), "there.gpkg: exists"),
        (("road", "--gis", "no/x.gpkg", "--recording", "run"), "no/x.gpkg: its folder does not"),
        (("lost", "--gis", "x.gpkg", "--recording", "nowhere"), "nowhere: no channels gnss_lat"),
        (("road", "--gis", "x.gpkg", "--recording", "other"), "other: its SHA-256 is not the one"),
        (("road", "--gis", "x.gpkg", "--recording", "gone"), "gone: not found"),
    ],
)
@pytest.mark.parametrize("command", ["iri", "roughness"])
def test_what_cannot_be_done_is_one_line_and_leaves_nothing(
    folder: Path, monkeypatch: pytest.MonkeyPatch, command, arguments, message, refused
) -> None:
    monkeypatch.chdir(folder)
    other_recording(folder)
    Path("there.gpkg").write_bytes(b"there")
    before = {path: path.stat().st_mtime_ns for path in folder.rglob("*")}
    assert message in refused(command, *arguments)
    assert {path: path.stat().st_mtime_ns for path in folder.rglob("*")} == before


def test_a_batch_refuses_a_layer_before_any_work(folder: Path, tmp_path: Path, refused):
    options = ("--gis", tmp_path / "x.shp")
    assert "suffix '.shp'" in refused("batch", folder / "run", "--out", tmp_path / "net", *options)
    assert list(tmp_path.iterdir()) == []
