"""The firmware in C takes whatever comes: an answer in a line, and no access beyond its memory."""

import json
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from floatref.files import read_profile, write_recording

pytestmark = pytest.mark.slow

SANITIZED = (
    "-std=c99 -g -O1 -Wall -Wextra -Wpedantic -Wconversion -Werror"
    " -fsanitize=address,undefined,float-cast-overflow -fno-sanitize-recover=all"
)


@pytest.fixture(scope="module")
def sanitized(start, simulated, tmp_path_factory):
    """Return a firmware that stops at any access outside its memory, and a short recording."""
    probe = tmp_path_factory.mktemp("probe") / "probe.c"
    probe.write_text("int main(void) { return 0; }\n", encoding="ascii")
    command = ["cc", *SANITIZED.split(), "-o", str(probe.with_suffix("")), str(probe)]
    able = subprocess.run(command, capture_output=True).returncode == 0
    folder = probe.parent / "run"
    write_recording(simulated(length_m=30.0), folder)
    return start(*([f"CFLAGS={SANITIZED}"] if able else [])), folder


def test_a_run_stays_within_its_memory(sanitized):
    firmware, folder = sanitized
    answer, profile = firmware.run(folder)
    assert answer["ok"] is True
    assert len(read_profile(profile).tracks) == 2


@settings(max_examples=150, deadline=None, suppress_health_check=list(HealthCheck))
@given(st.data())
def test_a_spoilt_recording_gets_an_answer(sanitized, tmp_path, data):
    firmware, folder = sanitized
    text = bytearray((folder / "recording.json").read_bytes())
    for _ in range(data.draw(st.integers(1, 3))):
        at = data.draw(st.integers(0, len(text) - 1))
        patch = data.draw(st.sampled_from([b"", b"{", b'"', b"\\", b"9", b"-", b"e", b"]", b"\0"]))
        text[at : at + data.draw(st.integers(0, 40))] = patch
    spoilt = tmp_path / "spoilt"
    shutil.copytree(folder, spoilt, dirs_exist_ok=True)
    (spoilt / "recording.json").write_bytes(text)
    answer, _ = firmware.run(spoilt)
    assert answer.get("ok") is True or answer["error"]


def cut(path):
    path.write_bytes(path.read_bytes()[:-3])


def infinite(path):
    x = np.fromfile(path)
    x[7] = np.inf
    x.tofile(path)


def mostly_missing(path):
    x = np.fromfile(path)
    x[: x.size // 2 + 1] = np.nan
    x.tofile(path)


def a_folder(path):
    path.unlink()
    path.mkdir()


def in_millimetres(path):
    (np.fromfile(path) * 1000).tofile(path)


def back(path):
    x = np.fromfile(path)
    x[500:] -= 1.5
    x.tofile(path)


SPOILT = {
    "whole number": ("left.height", cut),
    "infinite": ("right.height", infinite),
    "samples are missing": ("left.vertical_specific_force", mostly_missing),
    "holds no": ("left.height", a_folder),
    "beyond 100": ("left.height", in_millimetres),
    "cannot be opened": ("right.vertical_specific_force", Path.unlink),
    "sample 500 goes back": ("distance", back),
}


@pytest.mark.parametrize("reason", SPOILT)
def test_samples_that_cannot_be_used_are_refused_by_name(sanitized, reason, tmp_path):
    firmware, folder = sanitized
    shutil.copytree(folder, tmp_path / "run")
    channel, spoil = SPOILT[reason]
    spoil(tmp_path / "run" / f"{channel}.f64")
    answer, profile = firmware.run(tmp_path / "run")
    assert reason in answer["error"]
    assert channel in answer["error"]
    assert not profile.exists()


@pytest.mark.parametrize("name", ["distance", "height", "vertical_specific_force"])
def test_a_recording_without_a_channel_is_refused_by_its_name(sanitized, name, tmp_path):
    firmware, folder = sanitized
    shutil.copytree(folder, tmp_path / "run")
    document = json.loads((folder / "recording.json").read_text(encoding="utf-8"))
    document["channels"] = [c for c in document["channels"] if c["name"] != name]
    (tmp_path / "run" / "recording.json").write_text(json.dumps(document), encoding="utf-8")
    answer, _ = firmware.run(tmp_path / "run")
    assert f"channel {name}" in answer["error"]
    assert "missing" in answer["error"]


@pytest.mark.parametrize("scale", [1e-300, 1e-12, 1e-3, 1e3, 1e290])
@pytest.mark.parametrize("files", ["*", "distance*", "left.vertical*", "right.height*"])
def test_no_time_stamps_lead_beyond_its_memory(sanitized, scale, files, tmp_path):
    firmware, folder = sanitized
    shutil.copytree(folder, tmp_path / "run")
    document = json.loads((folder / "recording.json").read_text(encoding="utf-8"))
    for channel in document["channels"]:
        if Path(channel["file"]).match(files):
            samples = np.fromfile(folder / channel["file"]).size
            del channel["rate_hz"], channel["start_s"]
            channel["time_file"] = "time." + channel["file"]
            (np.arange(samples) / 4000 * scale).tofile(tmp_path / "run" / channel["time_file"])
    (tmp_path / "run" / "recording.json").write_text(json.dumps(document), encoding="utf-8")
    answer, _ = firmware.run(tmp_path / "run")
    assert answer.get("ok") is True or answer["error"]


@pytest.mark.parametrize(
    ("line", "reason"),
    [
        (b"", "not JSON"),
        (b'{"seq": 1, "cmd": "run"', "not JSON"),
        (b"[]", "not start, run or stop"),
        (b'{"seq": 1, "cmd": "dance"}', "not start, run or stop"),
        (b'{"seq": 1, "cmd": "start", "version": 2}', "version 1"),
        (b'{"seq": 1, "cmd": "run", "recording": 7}', "have to be paths"),
        (b'{"seq": 1, "cmd": "run", "recording": "a", "profile": "' + b"b" * 3000 + b'"}', "paths"),
        (b'{"a": "' + b"x" * (1 << 20) + b'"}', "longer than 1 MiB"),
        (b"[" * 100000, "not JSON"),
    ],
)
def test_a_line_that_is_no_request_is_answered_with_an_error(sanitized, line, reason):
    answer = sanitized[0].ask(line)
    assert reason in answer["error"]


def test_the_device_says_what_it_is(sanitized):
    answer = sanitized[0].ask({"seq": 12, "cmd": "start", "version": 1})
    assert (answer["seq"], answer["version"]) == (12, 1)
    device = answer["device"]
    assert (device["architecture"], device["capabilities"]) == ("temporal", [])


def test_the_least_device_leaves_everything_out(build):
    requests = '{"seq": 1, "cmd": "start", "version": 1}\n{"seq": 2, "cmd": "run", "recording": "a"'
    found = subprocess.run(
        [build("hello")], input=requests + ', "profile": "b"}\n', capture_output=True, text=True
    )
    _, answer = map(json.loads, found.stdout.splitlines())
    assert (found.returncode, answer) == (0, {"seq": 2, "skipped": "there is no pipeline yet"})
