"""The directory at every moment: before each operation on a file it can be read and resumed.

A program that is killed leaves what is there between two operations on files. Law: the profile
there is the beginning of that of the whole run, and the run resumes to the same profile.
"""

import shutil
import sys
from contextlib import contextmanager

import numpy as np
import pytest

from floatref import InputError, read_profile
from floatref.files.growing_profile import GrowingProfile, append_durably
from floatref.live.as_live import run_as_live
from floatref.live.session.run_directory import RunDirectory, is_complete
from floatref.values.profile import ProfileTrack

LEGS = [(20.0, 260.0)]
CHANGES = ("open", "os.rename", "os.remove")
WATCHED = {"folder": None, "copies": None, "count": 0}


def hook(event, arguments):
    """Copy the folder before anything in it changes."""
    folder = WATCHED["folder"]
    if folder is None or event not in CHANGES or not str(arguments[0]).startswith(str(folder)):
        return
    if event == "open" and not (arguments[2] & 0o3):
        return
    WATCHED["folder"] = None
    shutil.copytree(folder, WATCHED["copies"] / str(WATCHED["count"]))
    WATCHED["count"] += 1
    WATCHED["folder"] = folder


@contextmanager
def copies_of(folder, copies):
    """Keep a copy of ``folder`` in ``copies`` before each change, while it exists."""
    if not WATCHED.get("hooked"):
        WATCHED["hooked"] = True
        # It cannot be removed, so it looks at nothing once the test is over.
        sys.addaudithook(hook)
    WATCHED.update(folder=folder, copies=copies, count=0)
    try:
        yield
    finally:
        WATCHED["folder"] = None


@pytest.fixture(scope="module")
def made(drive, live, tmp_path_factory):
    """Return the messages of a run, its profile, and its directory at every moment."""
    recording = drive(LEGS)
    messages = live.messages_of(recording, step_s=20.0)
    base = tmp_path_factory.mktemp("moments")
    copies = base / "copies"
    copies.mkdir()
    half = len(messages) // 2
    path = base / "run"
    live.serve(path, messages[:1])
    with copies_of(path, copies):
        # Saved behind every message, a window that is ready is not joined to the next one.
        live.serve(path, messages[:half], resume=True, save_s=0.0)
        live.serve(path, messages, resume=True, save_s=0.0)
    return messages, run_as_live(recording, live.PIPELINE).profile, sorted(copies.iterdir())


def check_prefix(path, expected):
    if not (path / "profile.json").exists():
        return 0
    track = read_profile(path)["left"]
    count = track.elevation.size
    np.testing.assert_array_equal(track.elevation, expected["left"].elevation[:count])
    np.testing.assert_array_equal(track.valid, expected["left"].valid[:count])
    return count


@pytest.mark.slow
def test_it_can_be_read_at_every_moment(made):
    _, expected, moments = made
    assert len(moments) > 30
    counts = [check_prefix(each, expected) for each in sorted(moments, key=lambda p: int(p.name))]
    assert counts == sorted(counts)
    assert len(set(counts)) >= 4


def resume_at(moment, made, live, same, tmp_path):
    messages, expected, _ = made
    path = tmp_path / "run"
    shutil.copytree(moment, path)
    _, error = live.serve(path, messages, resume=True)
    assert error is None
    same(read_profile(path), expected)
    assert not list(path.glob("live*"))


@pytest.mark.slow
def test_it_resumes_at_three_moments(made, live, same, tmp_path):
    rng = np.random.default_rng()
    for number, moment in enumerate(rng.choice(made[2], 3, replace=False)):
        resume_at(moment, made, live, same, tmp_path / str(number))


@pytest.mark.slow
def test_it_resumes_at_every_moment(made, live, same, tmp_path):
    for number, moment in enumerate(made[2]):
        resume_at(moment, made, live, same, tmp_path / str(number))


def test_a_directory_that_is_no_run_is_named(tmp_path):
    with pytest.raises(InputError, match=r"holds no live\.json, so no live run to resume"):
        RunDirectory.reopen(tmp_path)
    for content in ("{}", '{"format": "floatref-live-run/1"}', "[]"):
        (tmp_path / "live.json").write_text(content, encoding="utf-8")
        with pytest.raises(InputError, match=r"live\.json: is (no run of format|damaged)"):
            RunDirectory.reopen(tmp_path)


def test_a_lost_end_of_a_file_is_named(tmp_path):
    path = tmp_path / "left.f64"
    assert append_durably(path, 0, b"12345678") == 8
    assert append_durably(path, 4, b"xy") == 6
    assert path.read_bytes() == b"1234xy"
    with pytest.raises(InputError, match=r"left\.f64: 6 bytes, but 8 were written"):
        append_durably(path, 8, b"z")


def test_a_sigma_that_comes_later_is_unknown_before(tmp_path):
    profile = GrowingProfile(tmp_path, 0.5, ["left"])
    profile.append(3, [ProfileTrack.of("left", [1.0, 2.0])])
    profile.append(5, [ProfileTrack.of("left", [3.0], sigma=[0.1])])
    profile.append(6, [ProfileTrack.of("left", [np.nan])])
    profile.publish({}, growing=True)
    (tmp_path / "left.f64").write_bytes((tmp_path / "left.f64").read_bytes() + b"half")
    found = read_profile(tmp_path)
    assert (found.start_m, found.interval_m) == (1.5, 0.5)
    np.testing.assert_array_equal(found["left"].elevation, [1.0, 2.0, 3.0, np.nan])
    np.testing.assert_array_equal(found["left"].sigma, [np.nan, np.nan, 0.1, np.nan])
    np.testing.assert_array_equal(found["left"].valid, [True, True, True, False])
    with pytest.raises(InputError, match="points from 8 on do not follow those up to 7"):
        profile.append(8, [ProfileTrack.of("left", [1.0])])
    assert [t.elevation.tolist() for t in profile.read(4, 6)] == [[2.0, 3.0]]


@pytest.mark.parametrize("provenance", ["null", "[]", '["live"]', '"live"', "1", '{"live": []}'])
def test_a_document_that_a_stream_has_not_written_is_not_complete(tmp_path, provenance) -> None:
    (tmp_path / "profile.json").write_text(f'{{"provenance": {provenance}}}', encoding="utf-8")
    assert not is_complete(tmp_path)
