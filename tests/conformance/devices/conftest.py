"""Programs written for one test, a recording for them, and that none of them is left."""

import sys

import numpy as np
import pytest
from tests.conformance.hostile_programs import INTERVAL_M, no_process_is_left, recording

from floatref.files import write_profile, write_recording
from floatref.values.profile import Profile, ProfileTrack
from floatref_conformance.devices.executable import ExecDevice

__all__ = ["no_process_is_left", "recording"]

PRELUDE = """\
import json, os, shutil, signal, subprocess, sys, time
SAID = {"name": "written", "version": "1", "architecture": "temporal", "capabilities": []}

def ask():
    line = sys.stdin.readline()
    return json.loads(line) if line else sys.exit(0)

def tell(command, **said):
    print(json.dumps({"seq": command["seq"], **said}), flush=True)

def start():
    tell(ask(), version=1, device=SAID)

def sound(command):
    if command["cmd"] == "stop":
        sys.exit(0)
    shutil.copytree(sys.argv[1], command["profile"])
    tell(command, ok=True)

def hang():
    while True:
        time.sleep(3600)

def escape(then):
    if os.fork() == 0:
        os.setsid()
        if os.fork() == 0:
            signal.signal(signal.SIGTERM, signal.SIG_IGN)
            signal.signal(signal.SIGHUP, signal.SIG_IGN)
            then()
            os._exit(0)
        os._exit(0)
    os.wait()

"""


@pytest.fixture
def recorded(recording, tmp_path):
    """The recording.json of the recording."""
    write_recording(recording, tmp_path / "recorded")
    return tmp_path / "recorded" / "recording.json"


@pytest.fixture
def sound(recording, tmp_path):
    """A profile directory that can be made of the recording."""
    distance = recording.channel("distance").values
    elevation = np.sin(np.arange(int(distance[-1] / INTERVAL_M) + 1) * INTERVAL_M)
    tracks = tuple(ProfileTrack.of(name, elevation) for name in ("left", "right"))
    write_profile(Profile(INTERVAL_M, tracks), tmp_path / "sound")
    return tmp_path / "sound"


@pytest.fixture
def written(sound, tmp_path):
    """Return a function that writes a program and returns how it is started."""

    def write(body):
        number = len(list(tmp_path.glob("program*.py")))
        program = tmp_path / f"program{number}.py"
        program.write_text(PRELUDE + body, encoding="utf-8")
        return (sys.executable, str(program), str(sound))

    return write


@pytest.fixture
def device(written, tmp_path):
    """Return a function that makes the device of a program; all are closed at the end."""
    made = []

    def make(body, **settings):
        made.append(ExecDevice(written(body), tmp_path, **settings))
        return made[-1]

    yield make
    for one in made:
        if one._session is not None:
            one._session._child.kill()
