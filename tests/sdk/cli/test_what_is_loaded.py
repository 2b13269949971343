"""A command loads what it needs, and no library that it could do without.

Each takes a tenth of a second to a whole one to load, on which no test can rely; so the modules
are counted that a command has loaded when it ends.
"""

import json
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from floatref import Profile, ProfileTrack, write_profile, write_recording
from floatref.cli.warm.made_up_run import made_up_recording

ADAPTERS = {"asammdf", "can", "cantools", "h5py", "mcap", "nptdms", "pyarrow", "pynmea2"}
NEVER = {
    *ADAPTERS,
    *("dask", "distributed", "hypothesis", "jinja2", "matplotlib", "pandas", "xarray"),
    *("scipy.interpolate", "scipy.optimize", "scipy.signal", "scipy.stats"),
}
"""Of no use to a command that processes a recording directory, or prints figures of a profile."""
COMPUTING = {"numba", "scipy"}
PRINTING = {"rich"}
READING = {"jsonschema"}
COMMANDS = {
    "--help": NEVER | COMPUTING | PRINTING | READING | {"numpy", "pluggy"},
    "--version": NEVER | COMPUTING | PRINTING | READING | {"numpy", "pluggy"},
    "adapters --json": NEVER | COMPUTING | PRINTING | READING,
    "pipelines --json": NEVER | COMPUTING | PRINTING | READING,
    "convert profile --out converted.csv": NEVER | COMPUTING,
    "iri profile --json": NEVER | PRINTING | {"scipy.sparse"},
    "process run --out made --pipeline temporal-adaptive-hpf --json": NEVER | PRINTING,
    "process run --out other --pipeline road-prior-smoother": NEVER,
}
LIST_THEM = """
import json, sys
sys.argv[0] = "floatref"
try:
    from floatref.cli.program.starting import start
    start()
finally:
    print("\\n" + json.dumps(sorted(sys.modules)), file=sys.stderr)
"""


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    made = tmp_path_factory.mktemp("loaded")
    z = np.cumsum(np.random.default_rng(1).normal(0.0, 4e-4, 4000))
    track = ProfileTrack.of("main", z, sigma=np.full(z.size, 1e-4))
    write_profile(Profile(0.05, (track,)), made / "profile")
    write_recording(made_up_recording("road-prior-smoother"), made / "run")
    return made


@pytest.mark.parametrize(
    "command",
    [pytest.param(c, marks=pytest.mark.slow if "run" in c else ()) for c in COMMANDS],
)
def test_a_command_loads_no_library_without_need(folder: Path, command: str) -> None:
    words = [sys.executable, "-c", LIST_THEM, *command.split()]
    done = subprocess.run(words, cwd=folder, capture_output=True, text=True, check=False)
    *lines, modules = done.stderr.splitlines()
    assert done.returncode == 0, lines
    loaded = set(json.loads(modules))
    assert "floatref.cli.main" in loaded
    assert not loaded & COMMANDS[command]
