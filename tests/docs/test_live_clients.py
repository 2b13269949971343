"""The clients of `floatref live` in four languages: what they print is the profile of the run."""

import importlib.util
import json
import shutil
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest

from floatref import read_profile
from floatref.live.as_live import run_as_live

pytestmark = [pytest.mark.slow, pytest.mark.posix]
ROOT = Path(__file__).parents[2]
CLIENTS = ROOT / "docs" / "examples" / "live"
WAIT_S = 300.0


def load(*parts):
    path = ROOT.joinpath("tests", "sdk", "live", *parts)
    spec = importlib.util.spec_from_file_location(f"of_{path.parent.name}", path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


RUNS, SESSION = load("conftest.py"), load("session", "conftest.py")


def in_python(_):
    return [sys.executable, str(CLIENTS / "client.py")]


def in_c(folder):
    program = folder / "client"
    words = ["-std=c99", "-Wall", "-Wextra", "-Werror", "-pedantic", "-o", str(program)]
    subprocess.run([require("cc"), *words, str(CLIENTS / "client.c")], check=True)
    return [str(program)]


def in_c_sharp(folder):
    program = folder / "Client.exe"
    words = ["-warnaserror", f"-out:{program}", str(CLIENTS / "Client.cs")]
    subprocess.run([require("mcs"), *words], check=True)
    return [require("mono"), str(program)]


def in_bash(_):
    return [require("bash"), str(CLIENTS / "client.sh")]


def require(program):
    found = shutil.which(program)
    if found is None:
        pytest.skip(f"{program} is not installed here")
    return found


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    """Return a run as a table, and its profile."""
    recording = RUNS.make_drive([(20.0, 150.0)])
    path = tmp_path_factory.mktemp("table") / "run.csv"
    columns = [
        recording.channel(name, "left").values
        for name in ("vertical_specific_force", "height", "distance")
    ]
    rows = zip(*(column.tolist() for column in columns), strict=True)
    path.write_text("".join(f"{a!r},{b!r},{c!r}\n" for a, b, c in rows), encoding="utf-8")
    return path, run_as_live(recording, "temporal-matched-hpf").profile


def serve(path, *words):
    command = [sys.executable, "-m", "floatref", "live", "-o", str(path), "--listen", "0", *words]
    pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE}
    process = subprocess.Popen(command, text=True, **pipes)
    return process, process.stdout.readline().rpartition(":")[2].strip()


@pytest.mark.parametrize("make", [in_python, in_c, in_c_sharp, in_bash])
def test_it_prints_the_final_points(run, tmp_path, make):
    table, expected = run
    client = make(tmp_path)
    process, port = serve(tmp_path / "run")
    with process:
        printed = talk(client, port, table)
        assert process.wait(WAIT_S) == 0
    RUNS.assert_same(read_profile(tmp_path / "run"), expected)
    RUNS.assert_same(SESSION.profile_of(printed), expected)


@pytest.mark.parametrize("make", [in_python, in_c, in_c_sharp, in_bash])
def test_the_same_call_completes_a_run_that_was_killed(run, tmp_path, make):
    table, expected = run
    client, path = make(tmp_path), tmp_path / "run"
    process, port = serve(path, "--save-every", "0")
    words = [*client, port, str(table), "200"]
    pipes = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
    with process, subprocess.Popen(words, **pipes) as first:
        while not (path / "live.json").exists() and process.poll() is None:
            time.sleep(0.01)
        process.kill()
        first.wait(WAIT_S)
    process, port = serve(path, "--resume")
    with process:
        printed = talk(client, port, table)
        assert process.wait(WAIT_S) == 0
    RUNS.assert_same(read_profile(path), expected)
    if printed:
        found = SESSION.profile_of(printed)["left"].elevation
        np.testing.assert_array_equal(found, expected["left"].elevation[-found.size :])


def talk(client, port, table):
    """Run the client, and return the answers that it prints."""
    words = [*client, port, str(table), "200"]
    ended = subprocess.run(words, capture_output=True, text=True, timeout=WAIT_S, check=False)
    assert (ended.returncode, ended.stderr) == (0, "")
    return [json.loads(line) for line in ended.stdout.splitlines()]
