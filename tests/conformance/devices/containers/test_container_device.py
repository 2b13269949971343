"""Devices in containers, by a stub in place of podman: options, environment, faults and ends."""

import os
import signal
import subprocess
import sys
import time

import pytest
from click.testing import CliRunner
from tests.conformance.devices.containers.conftest import DIGEST, IMAGE

from floatref_conformance.cli.main import main
from floatref_conformance.devices.containers.container_device import make
from floatref_conformance.devices.interface import Description
from floatref_conformance.errors import DeviceError, DeviceHung
from floatref_conformance.judge.exercise import close, describe, exercise
from floatref_conformance.submission.origins import hash_device

pytestmark = pytest.mark.posix
SOUND = "start()\nwhile True: sound(ask())"
FIRST = "first = not os.path.exists('/TMP/seen')\nopen('/TMP/seen', 'w')\nstart()\nc = ask()\n"
JUDGE = """
import sys, time
from floatref_conformance.devices.containers.container_device import make
device = make(sys.argv[1])
print(device.describe()["name"], flush=True)
time.sleep(600)
"""


def test_a_sound_image_is_started_once_runs_and_is_removed(podman, recording, temporary):
    stub = podman(SOUND)
    device = make(IMAGE)
    description = describe(device)
    assert description == Description("written", "1", "temporal", ())
    for _ in range(2):
        profile = exercise(device, description, recording)
        assert {track.name for track in profile.tracks} == {"left", "right"}
    assert len(stub.running) == 1
    assert close(device) == close(device) == ""
    assert (stub.running, temporary()) == ({}, [])
    assert len(stub.runs) == 1
    lines = (stub.folder / "lines").read_text()
    assert '"recording": "/floatref/recordings/1/recording.json"' in lines
    assert str(stub.folder.parent) not in lines


@pytest.mark.slow
def test_it_has_no_network_no_rights_and_the_variables_that_were_asked_for(podman, monkeypatch):
    monkeypatch.setenv("LICENCE", "secret")
    monkeypatch.setenv("TOKEN", "secret too")
    stub = podman("SAID['version'] = ' '.join(sorted(os.environ))\n" + SOUND)
    device = make(IMAGE)
    device.variables = ("LICENCE",)
    seen = set(describe(device).version.split()) - {"LC_CTYPE"}
    close(device)
    assert seen == {"LICENCE"}
    (words,) = stub.runs
    assert words[-3:] == ["--env", "LICENCE", DIGEST]
    text = " ".join(words)
    for part in (
        "--network none",
        "--cap-drop ALL",
        "--read-only",
        "--rm",
        "--pull never",
        "--pids-limit 512",
    ):
        assert part in text
    assert "secret" not in text
    assert ":/floatref/recordings:ro,Z" in text
    assert not any("TOKEN" in call["names"] for call in stub.calls)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("fault", "error", "reason"),
    [
        ("os._exit(7)", DeviceError, "exited with status 7"),
        ("hang()", DeviceHung, "no answer within 0.5 s"),
        ("os.symlink('/etc', c['profile']); tell(c, ok=True)", DeviceError, "a symbolic link"),
    ],
)
def test_after_a_fault_no_container_is_left_and_a_new_one_is_started(
    podman, recording, temporary, tmp_path, fault, error, reason
):
    first = FIRST.replace("/TMP", str(tmp_path))
    stub = podman(f"{first}if first:\n    {fault}\nelse: sound(c)\nwhile True: sound(ask())")
    device = make(IMAGE)
    description = describe(device)
    device.timeout_s = 0.5 if error is DeviceHung else None
    with pytest.raises(error, match=reason):
        exercise(device, description, recording)
    device.timeout_s = None
    if "symlink" not in fault:
        assert (stub.running, temporary()) == ({}, [])
        exercise(device, description, recording)
        assert len(stub.runs) == 2
    assert close(device) == ""
    assert (stub.running, temporary()) == ({}, [])


@pytest.mark.slow
def test_a_judge_that_is_killed_leaves_no_container(podman, tmp_path):
    stub = podman("start()\nhang()")
    words = [sys.executable, "-c", JUDGE, IMAGE]
    judge = subprocess.Popen(words, stdout=subprocess.PIPE, cwd=tmp_path)
    assert judge.stdout.readline().strip() == b"written"
    ((_, pid),) = stub.running.items()
    judge.send_signal(signal.SIGKILL)
    judge.wait()
    judge.stdout.close()
    limit = time.monotonic() + 300.0
    while (stub.running or _is_alive(int(pid))) and time.monotonic() < limit:
        time.sleep(0.05)
    assert stub.running == {}
    assert not _is_alive(int(pid))
    # Whoever removes it looks once more before it ends.
    while len([c for c in stub.calls if c["words"][0] == "rm"]) < 2 and time.monotonic() < limit:
        time.sleep(0.05)


def _is_alive(pid):
    try:
        with open(f"/proc/{pid}/stat") as stat:
            return stat.read().rpartition(")")[2].split()[0] != "Z"
    except OSError:
        return False


@pytest.mark.slow
def test_what_a_judge_left_that_was_killed_with_all_is_removed(podman):
    stub = podman(SOUND)
    name = "from floatref.files.owners import own_name; print(own_name('floatref-'))"
    ended = subprocess.run([sys.executable, "-c", name], capture_output=True, text=True)
    (stub.folder / "running" / ended.stdout.strip()).write_text("999999999")
    (stub.folder / "running" / "floatref-of-another").write_text("999999999")
    make(IMAGE)
    assert list(stub.running) == ["floatref-of-another"]


def test_its_hash_is_that_of_the_image(podman):
    podman(SOUND)
    assert hash_device(make(IMAGE), f"container:{IMAGE}") == {IMAGE: DIGEST}


@pytest.mark.slow
def test_the_judge_runs_it_and_does_not_say_that_it_could_read_the_truth(podman, temporary):
    stub = podman("start()\nwhile True:\n    c = ask()\n    tell(c, skipped='no time')")
    words = ["run", "--device", f"container:{IMAGE}", "--check", "quiescent"]
    ended = CliRunner().invoke(main, words)
    assert ended.exit_code == 4, ended.output
    assert "the truth is in" not in ended.stderr
    assert (stub.running, temporary()) == ({}, [])
    assert os.getcwd() not in " ".join(stub.runs[0])
