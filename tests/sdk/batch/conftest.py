"""A short recording as a directory and as native files, and the jobs of a batch over them."""

from pathlib import Path

import numpy as np
import pytest

from floatref.batch import Job
from floatref.files import write_recording
from floatref.values.clock import UniformClock
from floatref.values.recording import Channel, Recording, Setup
from floatref_adapters.testing import WRITERS

MAP = """
format = "floatref-map/1"
[setup]
profile_interval_m = 0.05
[[files]]
name = "laser"
path = "laser.csv"
"""


def _entry(channel: Channel, file: str = "") -> str:
    lines = [f'native = "{channel.id}"', f'channel = "{channel.id.name}"']
    lines += [f'unit = "{channel.unit}"']
    lines += [f'track = "{channel.id.track}"'] if channel.id.track else []
    lines += ['file = "laser"'] if file else []
    return "\n".join(["[[channels]]", *lines, ""])


@pytest.fixture(scope="session")
def recording() -> Recording:
    """8 s at 20 m/s, two wheel paths, with fixes of a receiver ten times a second."""
    clock, times = UniformClock.of(1000.0), np.arange(8000) / 1000.0
    channels = [Channel.of("distance", 20.0 * times, clock)]
    for track, phase in (("left", 0.0), ("right", 1.0)):
        wave = np.sin(15.0 * times + phase)
        channels.append(Channel.of("height", 0.3 + 0.005 * wave, clock, track))
        force = 9.80665 + 1e-3 * wave
        channels.append(Channel.of("vertical_specific_force", force, clock, track))
    fixes = UniformClock.of(10.0)
    channels.append(Channel.of("gnss_latitude", 0.8 + 2.0 * np.arange(80) / 6.4e6, fixes))
    channels.append(Channel.of("gnss_longitude", np.full(80, 0.2), fixes))
    return Recording(tuple(channels), Setup(profile_interval_m=0.05))


@pytest.fixture(scope="session")
def _written(recording: Recording, tmp_path_factory: pytest.TempPathFactory) -> dict[str, bytes]:
    """The files of a directory `run`, of a native `run.csv`, and of a run in two files and map."""
    folder = tmp_path_factory.mktemp("written")
    write_recording(recording, folder / "run")
    WRITERS[".csv"](recording, folder / "run.csv", None)
    lasers = tuple(c for c in recording.channels if c.id.name == "height")
    others = tuple(c for c in recording.channels if c not in lasers)
    (folder / "mapped").mkdir()
    WRITERS[".csv"](Recording(others), folder / "mapped" / "run.csv", None)
    WRITERS[".csv"](Recording(lasers), folder / "mapped" / "laser.csv", None)
    entries = [_entry(c) for c in others] + [_entry(c, "laser") for c in lasers]
    clock = '[[clocks]]\nfile = "laser"\nalign = "offset"\n'
    (folder / "mapped" / "map.toml").write_text("\n".join([MAP, *entries, clock]))
    files = (path for path in folder.rglob("*") if path.is_file())
    return {path.relative_to(folder).as_posix(): path.read_bytes() for path in files}


@pytest.fixture
def folder(_written: dict[str, bytes], tmp_path: Path) -> Path:
    """A folder with all these files, to be spoilt."""
    for name, content in _written.items():
        path = tmp_path / name
        path.parent.mkdir(exist_ok=True)
        path.write_bytes(content)
    return tmp_path


@pytest.fixture
def jobs(folder: Path) -> dict[str, Job]:
    """A job for each kind of source: a directory, a native file, and one that has a map."""
    out, mapped = folder / "out", folder / "mapped"
    return {
        "directory": Job(folder / "run", "a/run", out),
        "native": Job(folder / "run.csv", "a/run.csv", out),
        "mapped": Job(mapped / "run.csv", "b/run.csv", out, channel_map=mapped / "map.toml"),
    }
