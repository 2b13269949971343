"""`process` of a path is that of the recording there, with its source in the record."""

import numpy as np
import pytest

from floatref import FloatrefWarning, InputError, process, read_recording, write_recording
from floatref.values.profile import Profile
from floatref.values.recording import Recording


@pytest.fixture
def recording(steady) -> Recording:
    """Return 4 s at 20 m/s."""
    return steady()


def assert_same(one: Profile, other: Profile) -> None:
    for track in one.tracks:
        np.testing.assert_array_equal(track.elevation, other[track.name].elevation)
        np.testing.assert_array_equal(track.valid, other[track.name].valid)
    assert one.settings == other.settings


@pytest.mark.parametrize("kind", [str, lambda path: path], ids=["text", "path"])
def test_a_path_gives_what_its_recording_gives(tmp_path, recording, kind) -> None:
    write_recording(recording, tmp_path / "run")
    settings = {"slow_mps": 3.0}
    found = process(kind(tmp_path / "run"), "temporal-mean-removal", settings)
    expected = process(read_recording(tmp_path / "run"), "temporal-mean-removal", settings)
    assert_same(found, expected)
    assert found.pipeline == "temporal-mean-removal"
    assert found.settings["slow_mps"] == 3.0
    added = found.provenance.keys() - expected.provenance.keys()
    assert added == {"source", "adapter", "sha256"}
    assert found.provenance["source"] == "run"


def test_a_path_as_live_gives_what_its_recording_gives_as_live(tmp_path, recording) -> None:
    write_recording(recording, tmp_path / "run")
    found = process(tmp_path / "run", "temporal-basic", as_live=True)
    expected = process(recording, "temporal-basic", as_live=True)
    assert_same(found, expected)
    assert found.provenance["source"] == "run"
    assert len(found.provenance["live"]["windows"]) == 1


CSV = """time [s],dist [m],hgt [mm],acc [m/s^2]
"""
MAP = """format = "floatref-map/1"
[[channels]]
native = "dist"
channel = "distance"
[[channels]]
native = "hgt"
channel = "height"
[[channels]]
native = "acc"
channel = "vertical_specific_force"
[setup]
profile_interval_m = 0.05
"""


@pytest.fixture
def native(tmp_path, recording):
    """Return the path of the recording as CSV, with names that need a map, and its map."""
    columns = [
        recording.channels[0].times_s,
        recording.channel("distance").values,
        1000.0 * recording.channel("height").values,
        recording.channel("vertical_specific_force").values,
    ]
    rows = [",".join(f"{value:.9f}" for value in row) for row in zip(*columns, strict=True)]
    (tmp_path / "run.csv").write_text(CSV + "\n".join(rows) + "\n")
    (tmp_path / "map.toml").write_text(MAP)
    return tmp_path / "run.csv", tmp_path / "map.toml"


def test_a_native_file_is_read_by_its_map(native, recording) -> None:
    source, chart = native
    for given in (source, str(source)):
        found = process(given, channel_map=str(chart), adapter="csv")
        expected = process(recording)
        np.testing.assert_allclose(
            found["main"].elevation, expected["main"].elevation, rtol=0.0, atol=1e-5
        )
        assert found.provenance["map"] == "map.toml"


@pytest.mark.parametrize(
    ("given", "text"),
    [
        ({"recording": "nothing.mf4"}, "nothing.mf4: not found"),
        ({"pipeline": "temporal-basik"}, "pipeline temporal-basik: unknown"),
        ({"channel_map": "map.toml"}, "channel_map map.toml: the recording is already read"),
        ({"adapter": "mdf4"}, "adapter mdf4: the recording is already read; give its path"),
    ],
)
def test_what_cannot_be_used_is_refused(recording, given, text) -> None:
    with pytest.raises(InputError, match=text):
        process(**({"recording": recording} | given))


def test_a_warning_is_about_the_line_that_called(tmp_path, steady) -> None:
    # The laser reads one height for a second: stuck.
    height = steady().channel("height").values.copy()
    height[1000:2500] = height[1000]
    recording = steady(height=height)
    write_recording(recording, tmp_path / "run")
    for given in (recording, tmp_path / "run"):
        with pytest.warns(FloatrefWarning) as found:
            process(given)
        assert {line.filename for line in found} == {__file__}
