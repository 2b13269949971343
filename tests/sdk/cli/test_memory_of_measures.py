"""The commands that measure a stored profile take room for a few columns of it, not for many.

Law: a point more of the road takes at most three columns of 8 bytes and a flag, however many wheel
paths there are. An hour, 14 million points at 5.08 mm, then takes 354 MB, and fits into 600 MB with
Python, the compiled loops and what is worked on in pieces. What these take is the memory of a
shorter road, which is taken off. The peak of memory is counted, so no speed decides.
`compare` takes less: what it filters, it filters in pieces.
"""

import json
import os
import subprocess
import sys

import numpy as np
import pytest

pytestmark = [pytest.mark.slow, pytest.mark.posix]

INTERVAL_M = 0.005
SHORT, LONG = 600_000, 3_000_000
BYTES_PER_POINT = 3 * 8 + 1
RETURNED = os.environ | {"MALLOC_MMAP_THRESHOLD_": "1000000"}
"""The columns of an hour are returned to the system when they are freed; so are these, by this."""
STARTS_M = {"run": 0.0, "again": 0.0, "between": 0.3 * INTERVAL_M, "apart": 65.0013}
COMMANDS = {
    "iri": ("iri", "{run}"),
    "iri by segment": ("iri", "{run}", "--segment", "100"),
    "roughness": ("roughness", "{run}"),
    "straightedge": ("straightedge", "{run}", "--bump", "1"),
    "compare": ("compare", "{again}", "{run}"),
    "compare between points": ("compare", "{again}", "{between}"),
    "compare 65 m apart": ("compare", "{again}", "{apart}"),
}
RUN = """
import resource, sys
from pathlib import Path
from click.testing import CliRunner
from floatref.cli.main import main

def peak():
    # The other count begins with the memory of the process that started this one.
    status = Path("/proc/self/status")
    if not status.exists():
        return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    line = next(x for x in status.read_text().splitlines() if x.startswith("VmHWM"))
    return 1024 * int(line.split()[1])

def call(words):
    done = CliRunner().invoke(main, [*words, "--json"])
    assert done.exit_code == 0, done.output
    # A place that is not sure would end the search early.
    assert "apart" not in words[-1] or '"placement_m": 65.' in done.output, done.output

short, long = sys.argv[1].split("|"), sys.argv[2].split("|")
call(short)
before = peak()
call(long)
print(peak() - before)
"""


def write(folder, count, start_m=0.0):
    """Write a road of two wheel paths with 1-σ, and a stop whose points are not valid.

    It is rough enough to be recognised wherever it lies.
    """
    folder.mkdir()
    places = INTERVAL_M * np.arange(count)
    valid = np.ones(count, np.uint8)
    valid[count // 2 : count // 2 + 2000] = 0
    tracks = []
    for name, waves in (("left", (7.0, 2.3)), ("right", (5.0, 1.9))):
        z = np.cumsum(np.random.default_rng(len(tracks)).normal(0.0, 1e-4, count))
        z += sum(0.002 * np.sin(2.0 * np.pi * places / wave) for wave in waves)
        z.tofile(folder / f"{name}.f64")
        np.full(count, 1e-4).tofile(folder / f"{name}.s.f64")
        valid.tofile(folder / f"{name}.u8")
        files = {"elevation": f"{name}.f64", "sigma": f"{name}.s.f64", "valid": f"{name}.u8"}
        tracks.append({"name": name} | {f"{key}_file": file for key, file in files.items()})
    document = {"format": "floatref-profile/1", "interval_m": INTERVAL_M, "start_m": start_m}
    (folder / "profile.json").write_text(json.dumps(document | {"tracks": tracks}))


@pytest.fixture(scope="module")
def roads(tmp_path_factory):
    """Folders of a short and a long road: measured, measured again, and between its points."""
    made = {}
    for size, count in (("short", SHORT), ("long", LONG)):
        folder = tmp_path_factory.mktemp(size)
        for name, start_m in STARTS_M.items():
            write(folder / name, count, start_m)
        made[size] = {name: str(folder / name) for name in STARTS_M}
    yield made
    for folder in made["long"].values():
        subprocess.run(["rm", "-r", folder], check=True)


@pytest.mark.parametrize("name", COMMANDS)
def test_a_long_road_takes_three_columns_and_flags(roads, name):
    words = ["|".join(w.format(**roads[size]) for w in COMMANDS[name]) for size in roads]
    command = [sys.executable, "-c", RUN, *words]
    done = subprocess.run(command, capture_output=True, text=True, check=True, env=RETURNED)
    assert int(done.stdout) < BYTES_PER_POINT * (LONG - SHORT)
