"""The firmware in C: built once for every set of flags, and asked over its protocol."""

import json
import shutil
import subprocess
import sys
import warnings
from itertools import count
from pathlib import Path

import numpy as np
import pytest

import floatref
from floatref.files import read_profile, write_recording
from floatref_conformance.proving_ground import Scenario, simulate

SOURCE = Path(__file__).parents[3] / "docs" / "examples" / "firmware_c"
PIPELINE = "temporal-adaptive-hpf-spatial-backward"
COUNTED = """
#include <stdio.h>
#include <stdlib.h>
static inline void *counted_malloc(size_t n) { fputs("taken\\n", stderr); return malloc(n); }
static inline void *counted_calloc(size_t n, size_t m)
{ fputs("taken\\n", stderr); return calloc(n, m); }
#define malloc counted_malloc
#define calloc counted_calloc
"""


class Firmware:
    """A running device, asked one request at a time."""

    numbers = count(1)

    def __init__(self, program):
        self.process = subprocess.Popen(
            [str(program)], stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE
        )
        self.folder = program.parent

    def ask(self, request):
        line = request if isinstance(request, bytes) else json.dumps(request).encode()
        self.process.stdin.write(line + b"\n")
        self.process.stdin.flush()
        return json.loads(self.process.stdout.readline())

    def run(self, folder):
        """Return the answer to a run of the recording in ``folder``, and where its profile is."""
        number = next(self.numbers)
        profile = self.folder / f"out-{number}"
        paths = {"recording": str(folder / "recording.json"), "profile": str(profile)}
        answer = self.ask({"seq": number, "cmd": "run", **paths})
        assert answer.pop("seq") == number
        return answer, profile

    def profile_of(self, recording, folder):
        write_recording(recording, folder)
        answer, profile = self.run(folder)
        assert answer == {"ok": True}
        return read_profile(profile)

    def end(self):
        """Return the exit code, and what the device said on its stderr."""
        try:
            _, said = self.process.communicate(b'{"seq": 0, "cmd": "stop"}\n', timeout=600)
        finally:
            self.process.kill()
        return self.process.returncode, said.decode()


@pytest.fixture(scope="session")
def build(tmp_path_factory):
    """Return a function that makes one target with one set of flags, once."""
    made = {}

    def program(target="firmware", *flags):
        if (target, *flags) not in made:
            folder = tmp_path_factory.mktemp("firmware") / "source"
            shutil.copytree(SOURCE, folder)
            (folder / "counted.h").write_text(COUNTED, encoding="ascii")
            command = ["make", "-s", "-j2", target, f"PYTHON={sys.executable}", *flags]
            found = subprocess.run(command, cwd=folder, capture_output=True, text=True)
            assert (found.returncode, found.stderr) == (0, ""), found.stderr
            made[target, *flags] = folder / target
        return made[target, *flags]

    return program


@pytest.fixture(scope="session")
def start(build):
    """Return a function that starts a firmware, once; all have to end cleanly and say nothing."""
    started = {}

    def firmware(*flags):
        if flags not in started:
            started[flags] = Firmware(build("firmware", *flags))
        return started[flags]

    yield firmware
    assert [each.end() for each in started.values()] == [(0, "")] * len(started)


@pytest.fixture
def counted(build):
    """Return a maker of firmware that says on its stderr whenever it takes memory."""
    return lambda: Firmware(build("firmware", "CPPFLAGS=-include counted.h"))


@pytest.fixture(scope="session")
def simulated():
    """Return a maker of short recordings of nominal channels."""

    def make(**changes):
        nominal = {"imu": False, "gnss": False, "response": False}
        nominal |= {"rate_hz": 4000.0, "length_m": 300.0, "seed": 3}
        return simulate(Scenario(**{"laser_ahead_m": 0.0, **nominal, **changes})).recording

    return make


@pytest.fixture(scope="session")
def expected():
    """Return what the pipeline that the firmware stands for makes of a recording."""

    def profile_of(recording):
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", floatref.FloatrefWarning)
            return floatref.process(recording, PIPELINE)

    return profile_of


@pytest.fixture(scope="session")
def assert_same():
    """Return a function that fails unless two profiles agree within some metres."""

    def compared(found, wanted, within_m=1e-9):
        assert (found.start_m, found.interval_m) == (wanted.start_m, wanted.interval_m)
        assert [t.name for t in found.tracks] == [t.name for t in wanted.tracks]
        for mine, theirs in zip(found.tracks, wanted.tracks, strict=True):
            np.testing.assert_allclose(mine.elevation, theirs.elevation, rtol=0, atol=within_m)
            np.testing.assert_array_equal(mine.valid, theirs.valid)

    return compared
