"""Profiles that were made elsewhere: which is whose follows from the recording's content."""

import json
import shutil
from dataclasses import replace

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref.files import read_profile, write_profile, write_recording
from floatref.values.profile import Profile, ProfileTrack
from floatref.values.recording import Channel
from floatref_conformance.devices import recorded as module
from floatref_conformance.devices.interface import Description
from floatref_conformance.errors import DeviceError, DeviceSkipped
from floatref_conformance.judge.exercise import describe, exercise

NUMBERS = (1, 2, 3)


def raised(recording, by):
    """The recording with every height greater by ``by`` mm: another one of the same size."""
    channels = tuple(
        Channel.of(c.id.name, c.values + by / 1000, c.clock, c.id.track)
        if c.id.name == "height"
        else c
        for c in recording.channels
    )
    return replace(recording, channels=channels)


def profile_of(sound, by):
    tracks = tuple(ProfileTrack.of(t.name, t.elevation + by) for t in read_profile(sound).tracks)
    return Profile(read_profile(sound).interval_m, tracks)


@pytest.fixture
def folder(recording, sound, tmp_path):
    """Three recordings and, in the same folders, what was made of them."""
    into = tmp_path / "device-a"
    into.mkdir()
    for by in NUMBERS:
        write_recording(raised(recording, by), into / f"case{by}")
        write_profile(profile_of(sound, by), tmp_path / f"made{by}")
        for made in (tmp_path / f"made{by}").iterdir():
            shutil.copy(made, into / f"case{by}")
    return into


def height(profile, sound):
    return (profile.track("left").elevation - read_profile(sound).track("left").elevation).mean()


@settings(
    deadline=None,
    max_examples=6,
    suppress_health_check=[HealthCheck.function_scoped_fixture],
)
@given(names=st.permutations(["a", "b", "c"]), by=st.sampled_from(NUMBERS))
def test_each_recording_gets_its_profile_whatever_the_folders_are_called(
    folder, recording, sound, names, by
):
    for old, new in zip(sorted(folder.iterdir()), names, strict=True):
        old.rename(folder / f"{new}-")
    for old in sorted(folder.iterdir()):
        old.rename(folder / old.name.rstrip("-"))
    device = module.make(str(folder))
    delivered = exercise(device, describe(device), raised(recording, by))
    assert height(delivered, sound) == pytest.approx(by)


def test_only_the_profile_is_delivered(folder, tmp_path):
    module.make(str(folder)).run(folder / "case1" / "recording.json", tmp_path / "out")
    delivered = {path.name for path in (tmp_path / "out").iterdir()}
    assert delivered == {path.name for path in (tmp_path / "made1").iterdir()}


def test_a_recording_that_is_not_there_is_skipped(folder, recording):
    device = module.make(str(folder))
    with pytest.raises(DeviceSkipped, match=f"{folder}: no such recording in it"):
        exercise(device, describe(device), raised(recording, 4))


def test_a_changed_sample_makes_another_recording(folder, recording):
    samples = folder / "case2" / "left.height.f64"
    assert samples.exists()
    content = bytearray(samples.read_bytes())
    content[0] ^= 1
    samples.write_bytes(content)
    device = module.make(str(folder))
    with pytest.raises(DeviceSkipped, match="no such recording in it"):
        exercise(device, describe(device), raised(recording, 2))


def test_a_recording_without_a_profile_is_skipped_and_its_folder_named(folder, recording):
    (folder / "case2" / "profile.json").unlink()
    device = module.make(str(folder))
    with pytest.raises(DeviceSkipped, match=r"case2: no profile\.json in it"):
        exercise(device, describe(device), raised(recording, 2))
    exercise(device, describe(device), raised(recording, 3))


def test_a_broken_recording_beside_the_others_is_no_ones(folder, recording):
    (folder / "case0").mkdir()
    (folder / "case0" / "recording.json").write_text("{")
    shutil.copytree(folder / "case2", folder / "case1a")
    document = folder / "case1a" / "recording.json"
    document.write_text(document.read_text().replace("channels", "channelz"))
    device = module.make(str(folder))
    exercise(device, describe(device), raised(recording, 2))


@pytest.mark.posix
def test_a_link_in_place_of_an_elevation_is_a_fault(folder, recording):
    elevation = folder / "case1" / "left.f64"
    elevation.rename(folder / "left.f64")
    elevation.symlink_to(folder / "left.f64")
    device = module.make(str(folder))
    with pytest.raises(DeviceError, match=r"left\.f64, which is a symbolic link"):
        exercise(device, describe(device), raised(recording, 1))


def test_it_describes_itself_by_its_folder_or_by_its_file(folder):
    device = module.make(str(folder))
    assert describe(device) == Description("device-a", "unknown", "temporal", ())
    said = {"version": "7", "architecture": "spatial", "capabilities": ["imu"]}
    (folder / "device.json").write_text(json.dumps(said))
    described = describe(module.make(str(folder)))
    assert described == Description("device-a", "7", "spatial", ("imu",))


def test_no_search_is_made_with_it(folder):
    assert module.make(str(folder)).searchable is False


def test_a_relative_folder_is_that_of_the_caller(folder, monkeypatch):
    monkeypatch.chdir(folder.parent)
    assert module.make(folder.name).folder == folder


@pytest.mark.parametrize(
    ("text", "words"),
    [("{", "device.json: not JSON"), ("[]", "device.json: not a JSON object")],
)
def test_an_unusable_description_is_wrong_usage(folder, text, words):
    (folder / "device.json").write_text(text)
    with pytest.raises(InputError, match=words):
        module.make(str(folder))


def test_a_folder_without_recordings_is_wrong_usage(tmp_path):
    with pytest.raises(InputError, match=r"device files:.*: no <case>/recording\.json in it"):
        module.make(str(tmp_path))
    with pytest.raises(InputError, match=r"device files:.*nowhere: no such folder"):
        module.make(str(tmp_path / "nowhere"))
