"""What a device may deliver, and what happens to the judge that reads it."""

import json
import os
import shutil
import socket
import tempfile

import numpy as np
import pytest

from floatref.files import read_profile
from floatref_conformance.devices import delivered
from floatref_conformance.devices.delivered import take
from floatref_conformance.devices.interface import Description
from floatref_conformance.errors import DeviceError, DeviceHung, DeviceSkipped
from floatref_conformance.judge.exercise import close, exercise

pytestmark = pytest.mark.posix

NOMINAL = Description("in test", "1", "temporal", ())


class Delivering:
    """Delivers a sound profile that ``spoil`` has changed."""

    def __init__(self, sound, spoil):
        self.sound, self.spoil = sound, spoil

    def run(self, recording, profile):
        shutil.copytree(self.sound, profile)
        self.spoil(profile)


def link_directory(profile):
    profile.rename(profile.with_name("elsewhere"))
    profile.symlink_to(profile.with_name("elsewhere"))


def link_to_nothing(profile):
    shutil.rmtree(profile)
    profile.symlink_to("nowhere")


def link_elevation(profile):
    (profile / "left.f64").rename(profile.with_name("left.f64"))
    (profile / "left.f64").symlink_to(profile.with_name("left.f64"))


def link_to_itself(profile):
    (profile / "left.f64").unlink()
    (profile / "left.f64").symlink_to("left.f64")


def link_beside(profile):
    (profile / "notes.txt").symlink_to("/etc/hostname")


def pipe(profile):
    (profile / "left.f64").unlink()
    os.mkfifo(profile / "left.f64")


def listening(profile):
    with socket.socket(socket.AF_UNIX) as one:
        here = os.open(".", os.O_RDONLY)
        os.chdir(profile)
        one.bind("a.sock")
        os.fchdir(here)
        os.close(here)


def folder_for_elevation(profile):
    (profile / "left.f64").unlink()
    (profile / "left.f64").mkdir()


def a_file(profile):
    shutil.rmtree(profile)
    profile.write_text("distance_m,left_elevation_m\n")


def elsewhere(profile):
    profile.rename(profile.with_name("profil"))


def huge(profile):
    with (profile / "more.f64").open("wb") as stream:
        stream.truncate(3 << 30)


def many(profile):
    for number in range(1001):
        (profile / f"{number}").touch()


def outside(profile):
    document = json.loads((profile / "profile.json").read_text())
    document["tracks"][0]["elevation_file"] = "../recording/left.height.f64"
    (profile / "profile.json").write_text(json.dumps(document))


def long_document(profile):
    with (profile / "profile.json").open("a") as stream:
        stream.write(" " * (17 << 20))


def one_track(profile):
    document = json.loads((profile / "profile.json").read_text())
    document["tracks"].pop()
    (profile / "profile.json").write_text(json.dumps(document))


def shortened(profile):
    os.truncate(profile / "left.f64", 800)


def half_a_sample(profile):
    os.truncate(profile / "left.f64", 801)


def all_shortened(profile):
    for name in ("left", "right"):
        os.truncate(profile / f"{name}.f64", 800)
        os.truncate(profile / f"{name}.valid.u8", 100)


def strange_name(profile):
    (profile / "a\nb\x1b[31m").symlink_to("/")


@pytest.mark.slow
@pytest.mark.parametrize(
    ("spoil", "words"),
    [
        (link_directory, "a symbolic link in place of a profile directory"),
        (link_to_nothing, "a symbolic link in place of a profile directory"),
        (link_elevation, "delivered left.f64, which is a symbolic link"),
        (link_to_itself, "delivered left.f64, which is a symbolic link"),
        (link_beside, "delivered notes.txt, which is a symbolic link"),
        (strange_name, r"delivered a b \[31m, which is a symbolic link"),
        (pipe, "delivered left.f64, which is not a plain file"),
        (listening, "delivered a.sock, which is not a plain file"),
        (folder_for_elevation, "unusable profile: track left: …/profile/left.f64: No such file"),
        (a_file, "delivered no profile directory"),
        (elsewhere, "delivered no profile directory"),
        (shutil.rmtree, "delivered no profile directory"),
        (huge, "delivered more than 256 MiB"),
        (many, "delivered more than 1000 files"),
        (outside, "unusable profile: …/profile/profile.json: .*recording/left.height.f64"),
        (long_document, "unusable profile: …/profile/profile.json: larger than"),
        (one_track, "track right: not delivered"),
        (shortened, "unusable profile: .* points, but the elevation has 100"),
        (half_a_sample, "unusable profile: .*left.f64"),
        (all_shortened, "the recording goes from 0.000 m to"),
    ],
)
def test_what_cannot_be_judged_is_a_fault_that_says_why(recording, sound, spoil, words):
    with pytest.raises(DeviceError, match=words) as caught:
        exercise(Delivering(sound, spoil), NOMINAL, recording)
    assert str(caught.value).isprintable()
    assert tempfile.gettempdir() not in str(caught.value)


def test_a_folder_that_may_not_be_read_is_a_fault(tmp_path, monkeypatch):
    def denied(folder):
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr(os, "scandir", denied)
    with pytest.raises(DeviceError, match="cannot be read: Permission denied"):
        take(tmp_path, tmp_path / "copy")


def test_other_files_and_folders_beside_a_sound_profile_are_no_fault(recording, sound):
    def more(profile):
        (profile / "log.txt").write_text("all well")
        (profile / "cache").mkdir()

    taken = exercise(Delivering(sound, more), NOMINAL, recording)
    expected = read_profile(sound).track("left").elevation
    assert np.array_equal(taken.track("left").elevation, expected)


def test_a_profile_that_is_cut_while_it_is_read_harms_nobody(recording, sound, monkeypatch):
    folders = []
    monkeypatch.setattr(
        "floatref_conformance.judge.exercise.read_profile",
        lambda copy: [all_shortened(folders[0]), read_profile(copy)][1],
    )
    taken = exercise(Delivering(sound, folders.append), NOMINAL, recording)
    assert taken.track("left").elevation.size == read_profile(sound).track("left").elevation.size


def test_a_file_that_grows_while_it_is_read_is_read_no_further(sound, tmp_path, monkeypatch):
    monkeypatch.setattr(delivered, "MAX_BYTES", 10_000)
    growing, grown, opens = sound / "left.f64", tmp_path / "grown", os.open
    grown.write_bytes(bytes(100_000))
    (sound / "right.f64").unlink()
    os.truncate(growing, 8)
    monkeypatch.setattr(
        os, "open", lambda path, *rest: opens(grown if path == growing else path, *rest)
    )
    with pytest.raises(DeviceError, match="delivered more than"):
        take(sound, tmp_path / "copy")
    assert (tmp_path / "copy" / "left.f64").stat().st_size <= 10_001


def test_files_that_are_named_stay_behind(sound, tmp_path):
    take(sound, tmp_path / "copy", without={"right.f64"})
    assert {p.name for p in sound.iterdir()} - {p.name for p in (tmp_path / "copy").iterdir()} == {
        "right.f64"
    }


@pytest.mark.parametrize("kind", [DeviceError, DeviceHung, DeviceSkipped])
def test_what_a_device_says_of_its_own_fault_is_let_through(recording, sound, kind):
    def refuse(profile):
        raise kind(f"no room in {profile}")

    with pytest.raises(kind, match=r"^no room in …/profile$") as caught:
        exercise(Delivering(sound, refuse), NOMINAL, recording)
    assert type(caught.value) is kind


def test_closing_never_raises_and_tells_what_went_wrong():
    class Closing:
        def close(self):
            raise ValueError("stuck\nvalve")

    class Ended:
        def close(self):
            raise DeviceError("stop: exited with status 1")

    assert close(Closing()) == "raised ValueError: stuck valve"
    assert close(Ended()) == "stop: exited with status 1"
    assert close(object()) == ""
