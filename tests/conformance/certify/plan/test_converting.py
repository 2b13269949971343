"""Sources of every kind as profiles in memory, by the floatref command, and what cannot be one."""

import json
import os
import tempfile
import threading
import time
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from floatref.files import fingerprint_native, write_profile, write_profile_csv, write_recording
from floatref.values.clock import UniformClock
from floatref.values.profile import Profile, ProfileTrack
from floatref.values.recording import Channel, Recording, Setup
from floatref_adapters.formats.erd.erd_profile import Erd
from floatref_adapters.formats.mdf4.mdf_writing import Mf4Recording
from floatref_conformance.certify.plan import commands as commands_module
from floatref_conformance.certify.plan.commands import Answer, Commands, Stopped
from floatref_conformance.certify.plan.converting import Converted, convert_all
from floatref_conformance.certify.plan.plan_document import Processing

SOURCES = {
    "profiles": ("made", "made.csv", "made.erd"),
    "recordings": ("run", "run.mf4"),
    "neither": ("damaged.erd", "noise.bin", "table.csv", "hollow", "gone.erd"),
}


@pytest.fixture(scope="module")
def folder(reference: Profile, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The same profile as directory, CSV and ERD; a recording; and files that are neither."""
    place = tmp_path_factory.mktemp("sources")
    write_profile(reference, place / "made")
    write_profile_csv(reference, place / "made.csv")
    Erd().write(reference, place / "made.erd")
    write_recording(recording(), place / "run")
    Mf4Recording().write(recording(), place / "run.mf4")
    (place / "damaged.erd").write_text("ERDFILEV2.00\n 1, 3,\n")
    (place / "noise.bin").write_bytes(bytes(range(256)))
    (place / "table.csv").write_text("time,height\n0,1\n")
    (place / "hollow").mkdir()
    (place / "mine.json").write_text('{"interval_m": 0.1}')
    return place


@pytest.fixture(scope="module")
def found(folder: Path) -> Mapping[str, Converted]:
    """What became of every source, by name, all read together."""
    paths = [folder / name for names in SOURCES.values() for name in names]
    processing = Processing("spatial-basic", folder / "mine.json")
    made = convert_all(paths, processing, lambda path: None)
    return {path.name: one for path, one in made.items()}


def only(path: Path) -> Converted:
    return convert_all([path], Processing(), lambda path: None)[path]


def recording() -> Recording:
    """Return 100 m at 20 m/s over a wave of 4 mm."""
    clock = UniformClock.of(1000.0)
    times = np.arange(5000) / 1000.0
    samples = {
        "height": 0.3 + 0.004 * np.sin(12.0 * times),
        "vertical_specific_force": 9.80665 + 1e-3 * np.sin(12.0 * times),
    }
    channels = [Channel.of(name, values, clock, "left") for name, values in samples.items()]
    shared = Channel.of("distance", 20.0 * times, clock)
    return Recording((shared, *channels), Setup(profile_interval_m=0.05))


@pytest.mark.slow
@pytest.mark.parametrize("name", SOURCES["profiles"])
def test_a_profile_of_any_format_is_the_profile(
    found: Mapping[str, Converted], folder: Path, reference: Profile, name: str
) -> None:
    one = found[name]
    assert (one.error, one.notes) == ("", ())
    assert one.profile is not None
    for track in reference.tracks:
        half_digit = 0.6e-7 if name == "made.erd" else 0.0
        ours = one.profile.track(track.name)
        assert np.allclose(ours.elevation, track.elevation, rtol=0.0, atol=half_digit)
        assert np.array_equal(ours.valid, track.valid)
    assert one.profile.provenance["sha256"] == fingerprint_native(folder / name)


def test_a_profile_keeps_flags_and_sigma_and_does_not_hang_on_its_files(
    reference: Profile, tmp_path: Path
) -> None:
    flags = np.arange(reference.tracks[0].elevation.size) % 3 > 0
    tracks = (ProfileTrack.of(t.name, t.elevation, flags, 0.1 + flags) for t in reference.tracks)
    write_profile(replace(reference, tracks=tuple(tracks)), tmp_path / "copy")
    one = only(tmp_path / "copy")
    assert one.profile is not None
    for track in one.profile.tracks:
        assert np.array_equal(track.valid, flags)
        assert track.sigma is not None
        assert np.array_equal(track.sigma, 0.1 + flags)
    for file in (tmp_path / "copy").glob("*.f64"):
        file.write_bytes(b"\0" * file.stat().st_size)
    assert one.profile.track("left").elevation.any()


@pytest.mark.slow
@pytest.mark.parametrize(("name", "adapter"), [("run", "recording"), ("run.mf4", "mdf4")])
def test_a_recording_is_processed_as_it_was_asked_for(
    found: Mapping[str, Converted], name: str, adapter: str
) -> None:
    one = found[name]
    assert one.error == ""
    assert one.profile is not None
    assert one.profile.pipeline == "spatial-basic"
    assert one.profile.interval_m == 0.1
    assert one.profile.provenance["adapter"] == adapter
    assert one.notes[0] == "processed by spatial-basic"


def test_warnings_of_processing_are_told(
    reference: Profile, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def warned(self: Commands, *words: str) -> Answer:
        write_profile(reference, Path(words[words.index("--out") + 1]))
        return Answer(json.dumps({"pipeline": "any", "warnings": ["half of it", "is missing"]}))

    monkeypatch.setattr(Commands, "run", warned)
    (tmp_path / "drive").mkdir()
    assert only(tmp_path / "drive").notes == ("processed by any", "half of it", "is missing")


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "said"),
    [
        ("damaged.erd", "damaged.erd: no line END after the header"),
        ("noise.bin", "no profile ("),
        ("noise.bin", "no recording (no adapter recognises it"),
        ("table.csv", "no profile (columns are"),
        ("hollow", ""),
        ("gone.erd", "No such file"),
    ],
)
def test_what_is_no_source_is_one_line_and_the_rest_goes_on(
    found: Mapping[str, Converted], folder: Path, name: str, said: str
) -> None:
    one = found[name]
    assert one.profile is None
    assert said in one.error
    assert one.error.startswith(f"{folder / name}: ")
    assert one.error.count(str(folder / name)) == 1
    assert "\n" not in one.error


def test_a_profile_directory_that_is_damaged_is_not_processed(tmp_path: Path) -> None:
    (tmp_path / "bad").mkdir()
    (tmp_path / "bad" / "profile.json").write_text("{")
    one = only(tmp_path / "bad")
    assert "not JSON" in one.error
    assert "recording" not in one.error


def test_every_source_is_told_once(folder: Path) -> None:
    paths = [folder / "made", folder / "made.csv", folder / "made", folder / "gone.erd"]
    warnings: list[Path] = []
    convert_all(paths, Processing(), warnings.append)
    assert sorted(warnings) == sorted(set(paths))


@pytest.mark.posix
@pytest.mark.parametrize("error", [KeyboardInterrupt, ZeroDivisionError])
def test_nothing_is_left_when_it_is_interrupted(
    folder: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, error: type[BaseException]
) -> None:
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    monkeypatch.setattr(commands_module, "COMMAND", ("sh", "-c", "exec sleep 600"))

    def interrupted(path: Path) -> None:
        assert any(tmp_path.iterdir())
        raise error

    with pytest.raises(error):
        convert_all([folder / "made", folder / "noise.bin"], Processing(), interrupted)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.posix
def test_on_leaving_what_runs_is_ended_and_nothing_starts(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    pipe = tmp_path / "never"
    os.mkfifo(pipe)
    monkeypatch.setattr(commands_module, "COMMAND", ("cat",))
    errors: list[str] = []
    with Commands() as commands:
        waiting = threading.Thread(target=lambda: errors.append(commands.run(str(pipe)).error))
        waiting.start()
        while not commands._running:
            time.sleep(0.01)
    waiting.join(timeout=600)
    assert errors == ["floatref was ended by signal 9 (out of memory?)"]
    with pytest.raises(Stopped):
        commands.run("iri")
