"""A stub that behaves as podman does: it records its words, and runs a program of this machine.

A container is a process in a session of its own, with the variables of `--env` alone. It does not
end with its client, and paths in it are those of its volumes.
"""

import json
import os
import sys
from pathlib import Path

import pytest
from tests.conformance.devices.conftest import PRELUDE

DIGEST = "5e" * 32
IMAGE = "registry.example/vendor/firmware:7"
PODMAN = """\
import json, os, signal, subprocess, sys
from pathlib import Path
from threading import Thread
HERE = Path(__file__).resolve().parent
words = sys.argv[1:]
with open(HERE / "calls", "a") as calls:
    calls.write(json.dumps({"words": words, "names": sorted(os.environ)}) + "\\n")

def value(option):
    return [words[k + 1] for k, word in enumerate(words) if word == option]

def run():
    name, volumes = value("--name")[0], [v.split(":")[:2] for v in value("--volume")]
    given = {key: os.environ[key] for key in value("--env") if key in os.environ}
    program = [sys.executable, str(HERE / "device.py"), str(HERE.parent / "sound")]
    device = subprocess.Popen(program, stdin=-1, env=given, start_new_session=True)
    (HERE / "running" / name).write_text(str(device.pid))
    Thread(target=feed, args=(device.stdin, volumes), daemon=True).start()
    code = device.wait()
    (HERE / "running" / name).unlink(missing_ok=True)
    os._exit(code)

def feed(stdin, volumes):
    for line in sys.stdin:
        with open(HERE / "lines", "a") as lines:
            lines.write(line)
        for here, there in volumes:
            line = line.replace(there, here)
        stdin.write(line.encode())
        stdin.flush()
    stdin.close()

def end(name):
    held = HERE / "running" / name
    if held.exists():
        try:
            os.killpg(int(held.read_text()), signal.SIGKILL)
        except ProcessLookupError:
            pass
        held.unlink()

if words[0] == "run":
    run()
elif words[0] in ("kill", "rm"):
    end(words[-1])
elif words[0] == "ps":
    print("\\n".join(os.listdir(HERE / "running")))
elif words[-1] == "IMAGE":
    print("DIGEST")
else:
    sys.exit("Error: " + words[-1] + ": image not known")
"""


class Stub:
    """The folder of the stub: what it was asked, and which containers there are."""

    def __init__(self, folder):
        self.folder = folder

    @property
    def calls(self):
        path = self.folder / "calls"
        return [json.loads(line) for line in path.read_text().splitlines()] if path.exists() else []

    @property
    def runs(self):
        return [call["words"] for call in self.calls if call["words"][0] == "run"]

    @property
    def running(self):
        return {path.name: path.read_text() for path in (self.folder / "running").iterdir()}


@pytest.fixture
def podman(sound, tmp_path, monkeypatch):
    """Return a function that puts the stub on the path, with the program that images run."""

    def install(body):
        folder = tmp_path / "podman"
        (folder / "running").mkdir(parents=True)
        (folder / "device.py").write_text(PRELUDE + body, encoding="utf-8")
        program = folder / "podman"
        text = PODMAN.replace("IMAGE", IMAGE).replace("DIGEST", DIGEST)
        program.write_text(f"#!{sys.executable}\n{text}", encoding="utf-8")
        program.chmod(0o755)
        monkeypatch.setenv("PATH", f"{folder}{os.pathsep}{os.environ['PATH']}")
        monkeypatch.setenv("TMPDIR", str(tmp_path / "temporary"))
        (tmp_path / "temporary").mkdir()
        monkeypatch.setattr("tempfile.tempdir", str(tmp_path / "temporary"))
        return Stub(folder)

    return install


@pytest.fixture
def temporary(tmp_path):
    """Return a function that lists what is left in the folder for temporary files."""
    return lambda: [path.name for path in Path(tmp_path / "temporary").iterdir()]
