"""`floatref process` as a user calls it."""

import json
import re

import numpy as np
import pytest

from floatref.cli import process as process_module
from floatref.errors import InputError
from floatref.files import read_profile, write_recording
from floatref.values.clock import UniformClock
from floatref.values.recording import Channel, Recording, Setup

G = 9.80665


@pytest.fixture
def folder(tmp_path):
    """A recording directory of two wheel paths at 20 m/s, one with a short laser drop-out."""
    clock = UniformClock.of(1000.0)
    times = np.arange(10_000) / 1000.0
    channels = [Channel.of("distance", 20.0 * times, clock)]
    for track, phase in (("left", 0.0), ("right", 1.0)):
        height = 0.3 + 0.005 * np.sin(15.0 * times + phase)
        if track == "right":
            height[4000:4050] = np.nan
        channels.append(Channel.of("height", height, clock, track))
        force = G + 1e-3 * np.sin(15.0 * times + phase)
        channels.append(Channel.of("vertical_specific_force", force, clock, track))
    write_recording(Recording(tuple(channels), Setup(profile_interval_m=0.05)), tmp_path / "run")
    return tmp_path


@pytest.mark.slow
def test_a_profile_directory_with_provenance(folder, ran):
    result = ran("process", folder / "run", "--out", folder / "profile")
    profile = read_profile(folder / "profile")
    assert profile.pipeline == "road-prior-smoother"
    reason = profile.provenance["chosen"]["reason"]
    assert f"Pipeline road-prior-smoother, since {reason}" in result.output
    assert [track.name for track in profile.tracks] == ["left", "right"]
    assert profile.provenance["adapter"] == "recording"
    assert set(profile.provenance["sha256"]) == {p.name for p in (folder / "run").iterdir()}
    assert re.search(r"cutoff_wavelength_m +105\.91\n", result.output)
    assert "Warning: " in result.stderr


def test_json_holds_what_the_contract_says(folder, invoke):
    result = invoke(
        *("process", folder / "run" / "recording.json", "--out", folder / "p.csv", "--json"),
        *("--pipeline", "temporal-basic"),
    )
    report = json.loads(result.stdout)
    fields = ["pipeline", "reason", "profile", "interval_m", "length_m", "tracks", "warnings"]
    assert list(report) == fields
    assert report["reason"] is None
    assert [list(track) for track in report["tracks"]] == [
        ["name", "iri_m_per_km", "iri_of_valid_m_per_km", "counted_share", "invalid_m"]
    ] * 2
    assert report["tracks"][0]["invalid_m"] == pytest.approx(105.91, abs=0.1)
    assert report["tracks"][1]["invalid_m"] == pytest.approx(106.91, abs=0.2)
    assert "right.height: 50 of 10000 samples missing" in report["warnings"][0]
    assert read_profile(folder / "p.csv").tracks[0].elevation.size == 4000


def test_settings_and_pipeline_from_outside(folder, ran):
    (folder / "mine.json").write_text('{"interval_m": 0.1}')
    ran(
        *("process", folder / "run", "--out", folder / "profile", "--pipeline", "spatial-basic"),
        *("--settings", folder / "mine.json"),
    )
    profile = read_profile(folder / "profile")
    assert (profile.interval_m, profile.pipeline) == (0.1, "spatial-basic")


@pytest.mark.slow
def test_a_drawing_beside_it(folder, ran):
    plot = folder / "profile.png"
    ran("process", folder / "run", "--out", folder / "profile", "--plot", plot)
    assert plot.read_bytes().startswith(b"\x89PNG")


def test_an_existing_target_needs_overwrite(folder, ran, refused):
    (folder / "p.csv").write_text("mine")
    refused("process", folder / "run", "--out", folder / "p.csv")
    assert (folder / "p.csv").read_text() == "mine"
    ran("process", folder / "run", "--out", folder / "p.csv", "--overwrite")
    assert (folder / "p.csv").read_text() != "mine"


@pytest.mark.parametrize(
    ("args", "message"),
    [
        (["missing", "--out", "o"], "missing: not found"),
        (["run", "--out", "o", "--adapter", "mdf5"], "adapter mdf5: unknown; did you mean mdf4?"),
        (["run", "--out", "o", "--pipeline", "x"], "pipeline x: unknown; there are"),
        (["run", "--out", "o.xls"], "suffix .xls is no format"),
        (["run", "--out", "o", "--settings", "no.json"], "no.json"),
        (["run", "--out", "o", "--settings", "list.json"], "expected one JSON object"),
        (["run", "--out", "nowhere/o"], "its folder does not exist"),
        (["run", "--out", "o", "--plot", "o.txt"], "not the name of a drawing"),
        (["unknown.bin", "--out", "o"], "no adapter recognises it"),
        (["run"], "Missing option '-o' / '--out'"),
        (["run", "--out", "o", "--colour"], "No such option"),
        (["run", "--out", "o", "--format", "xls"], "'xls' is not one of"),
    ],
)
def test_what_cannot_be_done_is_one_line_and_leaves_nothing(
    folder, monkeypatch, args, message, refused
):
    monkeypatch.chdir(folder)
    (folder / "list.json").write_text("[1]")
    (folder / "unknown.bin").write_bytes(b"\0")
    before = sorted(folder.iterdir())
    assert message in refused("process", *args)
    assert sorted(folder.iterdir()) == before


def test_the_settings_of_a_profile_can_be_given_again(folder, invoke, ran):
    invoke("process", folder / "run", "--out", folder / "one")
    document = json.loads((folder / "one" / "profile.json").read_text())
    (folder / "again.json").write_text(json.dumps(document["settings"]))
    ran(*("process", folder / "run", "--out", folder / "two", "--settings", folder / "again.json"))
    assert (folder / "one" / "left.f64").read_bytes() == (folder / "two" / "left.f64").read_bytes()


@pytest.mark.parametrize(
    "settings", ['{"interval_m": 3.0, "cutoff_wavelength_m": 1000.0}', '{"interval_m": 10}']
)
def test_a_profile_without_an_iri_is_written_with_a_warning(folder, settings, ran):
    (folder / "coarse.json").write_text(settings)
    result = ran(
        *("process", folder / "run", "--out", folder / "coarse", "--json"),
        *("--settings", folder / "coarse.json"),
    )
    report = json.loads(result.stdout)
    assert report["tracks"][0]["iri_m_per_km"] is None
    assert report["tracks"][0]["counted_share"] is None
    assert any("track left: no IRI: " in line for line in report["warnings"])
    assert (folder / "coarse").is_dir()


@pytest.mark.parametrize("out", ["run", "run/recording.json", "run/height.csv"])
def test_the_source_is_never_written_over(folder, out, refused):
    before = {p.name: p.read_bytes() for p in (folder / "run").iterdir()}
    refused("process", folder / "run", "--out", folder / out, "--overwrite")
    assert {p.name: p.read_bytes() for p in (folder / "run").iterdir()} == before


def test_profile_and_drawing_need_names_of_their_own(folder, refused):
    same = folder / "o.png"
    assert "choose another for the drawing" in refused(
        *("process", folder / "run", "--out", same, "--format", "csv", "--plot", same)
    )
    assert not same.exists()


@pytest.mark.slow
def test_a_drawing_is_not_left_behind_when_the_profile_fails(folder, monkeypatch, refused):
    def full(*args):
        raise InputError("disk full")

    monkeypatch.setattr(process_module, "write_as", full)
    refused(*("process", folder / "run", "--out", folder / "o", "--plot", folder / "o.png"))
    assert not (folder / "o.png").exists()


def test_listings(folder, invoke, reported):
    assert "recording" in invoke("adapters").output
    assert reported("adapters")["adapters"][0]["name"] == "recording"
