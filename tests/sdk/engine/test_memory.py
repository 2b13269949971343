"""A long run takes no more memory than its profile and a little room to work in."""

import json
import subprocess
import sys

import numpy as np
import pytest

pytestmark = [pytest.mark.slow, pytest.mark.posix]

RATE, SPEED, SECONDS, INTERVAL_M = 16_000, 50 / 3.6, 250, 0.0005
POINT_BYTES = 9
ROOM = 40e6
"""Far less than the samples on disk, and less than the profile."""

IN_A_FRESH_PROCESS = """
import sys, resource
from pathlib import Path
import floatref
from floatref.intake import tape

tape.IN_MEMORY = 1 << 20

def peak():
    # The other count begins with the memory of the process that started this one.
    status = Path("/proc/self/status")
    if not status.exists():
        return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    line = next(x for x in status.read_text().splitlines() if x.startswith("VmHWM"))
    return 1024 * int(line.split()[1])

def process(folder):
    profile = floatref.process(floatref.read_recording(Path(folder)), sys.argv[1])
    floatref.write_profile(profile, Path(folder) / sys.argv[1])
    return profile

process(sys.argv[2])
before = peak()
points = process(sys.argv[3]).tracks[0].elevation.size
print(peak() - before, points)
"""


def write_drive(folder, seconds):
    folder.mkdir()
    times = np.arange(seconds * RATE) / RATE
    channels = []
    for name, unit, samples in (
        ("vertical_specific_force", "m/s^2", 9.80665 + 0.1 * np.sin(7.0 * times)),
        ("height", "m", 0.3 + 0.001 * np.sin(9.0 * times)),
        ("distance", "m", 0.0003 * np.floor(SPEED * times / 0.0003)),
    ):
        samples.astype("<f8").tofile(folder / f"{name}.f64")
        clock = {"rate_hz": RATE, "start_s": 0}
        channels.append({"name": name, "unit": unit, "file": f"{name}.f64", **clock})
    document = {"format": "floatref-recording/1", "channels": channels}
    document["setup"] = {"profile_interval_m": INTERVAL_M}
    (folder / "recording.json").write_text(json.dumps(document))
    return 8 * times.size * len(channels)


@pytest.fixture(scope="module")
def drives(tmp_path_factory):
    folder = tmp_path_factory.mktemp("drives")
    write_drive(folder / "short", 10)
    assert write_drive(folder / "long", SECONDS) > 2 * ROOM
    yield folder / "short", folder / "long"
    for samples in folder.glob("*/*.f64"):
        samples.unlink()


@pytest.mark.parametrize(
    "pipeline", ["temporal-basic", "spatial-basic", "temporal-adaptive-hpf-spatial-backward"]
)
def test_a_long_drive_takes_its_profile_and_some_room(drives, pipeline):
    command = [sys.executable, "-c", IN_A_FRESH_PROCESS, pipeline, *map(str, drives)]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    grown, points = map(int, done.stdout.split())
    assert points == pytest.approx(SPEED * SECONDS / INTERVAL_M, rel=1e-4)
    assert POINT_BYTES * points > ROOM
    assert grown - POINT_BYTES * points < ROOM
