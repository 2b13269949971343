"""`floatref convert` of recordings: to files for other programs and back, and what is refused."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pyarrow as arrow
import pyarrow.parquet as parquet
import pytest
from asammdf import MDF, Signal

from floatref import InputError, process
from floatref.files import (
    read_profile,
    read_recording,
    write_profile,
    write_profile_csv,
    write_recording,
)
from floatref.values.clock import StampedClock, UniformClock
from floatref.values.profile import Profile, ProfileTrack
from floatref.values.recording import Channel, Recording, Setup
from floatref_adapters.formats.arrow.parquet_profile import ParquetProfile
from floatref_adapters.formats.erd.erd_profile import Erd
from floatref_adapters.formats.mdf4.mdf_writing import Mf4Recording
from floatref_adapters.formats.viewer_text.text_profile import ViewerText


def drive() -> Recording:
    """Twenty metres at 5 m/s with a drop-out of the laser, and fixes of a receiver."""
    count = 4000
    clock, fixes = UniformClock.of(1000.0), StampedClock.of(np.arange(40) * 0.1)
    height = 0.3 + 1e-4 * np.random.default_rng(2).normal(size=count)
    height[500:520] = np.nan
    force = 9.80665 + 0.1 * np.random.default_rng(3).normal(size=count)
    channels = (
        Channel.of("vertical_specific_force", force, clock, "left"),
        Channel.of("height", height, clock, "left"),
        Channel.of("distance", np.arange(count) * 0.005, clock),
        Channel.of("gnss_latitude", np.full(40, 0.8), fixes),
    )
    return Recording(channels, Setup(profile_interval_m=0.05), "maker", "model")


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    place = tmp_path_factory.mktemp("recordings")
    write_recording(drive(), place / "run")
    track = ProfileTrack.of("left", [0.0, 0.1, 0.2])
    write_profile(Profile(0.05, (track,)), place / "road")
    write_profile_csv(Profile(0.05, (track,)), place / "road.csv")
    ParquetProfile().write(Profile(0.05, (track,)), place / "road.parquet")
    ViewerText().write(Profile(0.05, (track,)), place / "road.txt")
    Erd().write(Profile(0.05, (track,)), place / "road.erd")
    Mf4Recording().write(drive(), place / "ours.mf4")
    with MDF() as theirs:
        theirs.append(Signal(np.zeros(9), np.arange(9.0), "V", "AI7"))
        theirs.save(place / "theirs.mf4")
    return place


def content(place: Path) -> dict[str, bytes]:
    return {path.name: path.read_bytes() for path in place.iterdir()}


def test_through_mcap_a_directory_comes_back_byte_for_byte(folder: Path, tmp_path: Path, ran):
    ran("convert", folder / "run", "--out", tmp_path / "run.mcap")
    ran("convert", tmp_path / "run.mcap", "--out", tmp_path / "back")
    assert content(tmp_path / "back") == content(folder / "run")


def test_an_mcap_file_is_processed_as_the_recording_is(folder: Path, tmp_path: Path, ran, reported):
    ran("convert", folder / "run", "--out", tmp_path / "run.mcap")
    options = ("--pipeline", "temporal-basic", "--out")
    one = reported("process", folder / "run", *options, tmp_path / "one")
    other = reported("process", tmp_path / "run.mcap", *options, tmp_path / "other")
    assert one["tracks"] == other["tracks"]
    assert read_profile(tmp_path / "one").tracks[0].elevation.tobytes() == (
        read_profile(tmp_path / "other").tracks[0].elevation.tobytes()
    )


def test_a_table_names_channels_units_samples_and_times(folder: Path, tmp_path: Path, ran):
    told = ran("convert", folder / "run", "--out", tmp_path / "run.mf4").output
    assert (tmp_path / "run.mf4").read_bytes()[:8] == b"MDF     "
    assert "left.vertical_specific_force" in told
    assert "m/s^2" in told


def test_a_native_file_with_its_map_becomes_a_directory(folder: Path, tmp_path: Path, ran):
    ran("convert", folder / "run", "--out", tmp_path / "run.mf4")
    drafted = ran("channels", tmp_path / "run.mf4", "--draft-map").output
    (tmp_path / "map.toml").write_text(drafted, encoding="utf-8")
    options = ("--map", tmp_path / "map.toml")
    ran("convert", tmp_path / "run.mf4", "--out", tmp_path / "again", *options)
    found, expected = read_recording(tmp_path / "again"), drive()
    for channel in expected.channels:
        np.testing.assert_array_equal(found.channel(*channel.id).values, channel.values)


def test_a_native_file_with_our_names_becomes_a_directory(folder: Path, tmp_path: Path, ran):
    ran("convert", folder / "ours.mf4", "--out", tmp_path / "again")
    found, expected = read_recording(tmp_path / "again"), drive()
    assert {channel.id for channel in found.channels} == {c.id for c in expected.channels}
    for channel in expected.channels:
        np.testing.assert_array_equal(found.channel(*channel.id).values, channel.values)


def test_a_setup_that_the_file_does_not_hold_is_said_in_one_line(folder, tmp_path, ran):
    """MDF 4 has no place for it; MCAP and a directory have; there may be none to lose."""
    write_recording(replace(drive(), setup=Setup()), tmp_path / "bare")
    errors = {
        (source, out): ran("convert", source, "--out", tmp_path / out).stderr.splitlines()
        for source in (folder / "run", tmp_path / "bare")
        for out in (f"{source.name}.mf4", f"{source.name}.mcap", f"{source.name}-copy")
    }
    (line,) = errors.pop((folder / "run", "run.mf4"))
    assert line.startswith(f"Warning: {tmp_path / 'run.mf4'}: the setup")
    assert "[setup] of a channel map" in line
    assert not any(errors.values())


@pytest.mark.parametrize(
    "name", ["road", "road.csv", "road/profile.json", "road.parquet", "road.txt", "road.erd"]
)
def test_a_profile_where_a_recording_is_read_is_called_one(folder: Path, name: str, refused):
    path, out = folder / name, folder / "o"
    commands = (
        ("process", path, "--out", out),
        ("pipelines", path),
        ("channels", path),
        ("view", folder / "road", "--recording", path, "--out", f"{out}.html"),
    )
    for command in commands:
        assert f"{path}: is a profile, no recording; give the recording" in refused(*command)
    with pytest.raises(InputError, match="is a profile, no recording"):
        process(path)


def test_a_recording_in_parquet_is_looked_at_and_converted_as_one(folder, tmp_path, ran, refused):
    """Both are Parquet: the footer says which it is."""
    path, rows = tmp_path / "run.parquet", 500
    table = {"time_s": np.arange(rows) / 100.0, "height": np.full(rows, 0.3)}
    parquet.write_table(arrow.table(table), path)
    assert "is a recording for adapter parquet, no profile" in refused("iri", path)
    ran("plot", path, "--out", tmp_path / "run.png")
    ran("convert", path, "--out", tmp_path / "again")
    found = read_recording(tmp_path / "again").channel("height")
    np.testing.assert_array_equal(found.values, table["height"])


def test_a_parquet_file_with_columns_of_a_profile_is_told_what_it_lacks(tmp_path, refused):
    path = tmp_path / "theirs.parquet"
    parquet.write_table(arrow.table({"distance_m": [0.0], "left_elevation_m": [0.1]}), path)
    assert "is a profile, no recording" in refused("process", path, "--out", tmp_path / "o")
    assert "metadata format is missing" in refused("iri", path)


def test_any_other_json_file_is_called_no_profile(tmp_path: Path, refused):
    (tmp_path / "settings.json").write_text("{}")
    line = refused("process", tmp_path / "settings.json", "--out", tmp_path / "o")
    assert "no adapter recognises it" in line


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["run", "--out", "o.erd"], "run: a recording, and .erd holds profiles; make one of it"),
        (["run", "--out", "o", "--format", "csv"], "a recording, and csv holds profiles"),
        (["run", "--out", "o.xyz"], "o.xyz: suffix .xyz is no format; a recording is written as"),
        (["run", "--out", "o.mcp"], "did you mean .mcap?"),
        (["run", "--out", "o.ppf"], "run: a recording, and .ppf holds profiles"),
        (["ours.mf4", "--out", "o.xyz"], "o.xyz: suffix .xyz is no format; a recording is"),
        (["ours.mf4", "--out", "o.erd"], "ours.mf4: is a recording for adapter mdf4, no profile"),
        (["theirs.mf4", "--out", "o"], "theirs.mf4: no channel of it has a name of floatref's"),
        (["road", "--out", "o.mcap"], "road: is a profile, and .mcap holds recordings; write .csv"),
        (["road.csv", "--out", "o.mf4"], "road.csv: is a profile, and .mf4 holds recordings"),
        (["road", "--out", "o", "--format", "recording"], "and format recording holds recordings"),
        (["gone", "--out", "o.mcap"], "gone: not found"),
        (["run", "--out", "run.mcap"], "exists"),
        (["run", "--out", "run/o.mcap"], "lies in, the source itself"),
        (["text.csv", "--out", "o.mf4"], "text.csv"),
        (["text.csv", "--out", "o"], "text.csv: no channel of it has a name of floatref's"),
        (["text.csv", "--out", "o"], "; or, as a profile: columns are"),
        (["text.csv", "--out", "o.erd"], "text.csv: columns are"),
        (["damaged.mcap", "--out", "o.mf4"], "damaged.mcap: cannot be read"),
        (["road", "--out", "o.csv", "--map", "m.toml"], "--adapter and --map read a recording"),
    ],
)
def test_what_cannot_be_done_is_one_line_and_leaves_nothing(
    folder: Path, monkeypatch: pytest.MonkeyPatch, arguments: list[str], message: str, refused
) -> None:
    monkeypatch.chdir(folder)
    Path("run.mcap").write_bytes(b"there")
    Path("damaged.mcap").write_bytes(b"\x89MCAP0\r\n and no more")
    Path("text.csv").write_text("a,b\n1,2\n")
    before = {path: path.stat().st_mtime_ns for path in folder.rglob("*")}
    assert message in refused("convert", *arguments)
    assert {path: path.stat().st_mtime_ns for path in folder.rglob("*")} == before
